// A checkpoint: what a run goes on from. An HDF5 file behind a block of text that tells whether the rest is
// whole:
//
//   cinch checkpoint 1
//   bytes  = of the HDF5 file behind the block
//   fnv1a  = 64-bit FNV-1a of them
//
// It is written beside its place and moved there when the disk has it: a kill at any moment, or a full disk,
// leaves the one before.
#pragma once
#include <filesystem>
#include <memory>

#include "base/archive.hpp"

namespace cinch {

class CheckpointWriter : public Archive {
 public:
  /// Begins PATH.tmp.
  explicit CheckpointWriter(std::filesystem::path path);
  ~CheckpointWriter() override;  ///< without commit(): as if nothing had been written
  /// Everything has been saved: puts it in place of what lies at PATH.
  void commit();

  bool restoring() const override { return false; }
  void values(const std::string& name, std::span<double> numbers) override;
  void values(const std::string& name, std::span<std::int64_t> numbers) override;
  void texts(const std::string& name, std::vector<std::string>& list) override;
  std::size_t length(const std::string&, std::size_t now) override { return now; }
  bool holds(const std::string&) const override { return true; }
  std::string place() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class CheckpointReader : public Archive {
 public:
  /// `path`: a checkpoint, or a folder with results that holds one. Throws FileError for what is none, is not
  /// whole, or is one of another format.
  explicit CheckpointReader(const std::filesystem::path& path);
  ~CheckpointReader() override;
  const std::filesystem::path& path() const;  ///< of the file

  bool restoring() const override { return true; }
  void values(const std::string& name, std::span<double> numbers) override;
  void values(const std::string& name, std::span<std::int64_t> numbers) override;
  void texts(const std::string& name, std::vector<std::string>& list) override;
  std::size_t length(const std::string& name, std::size_t now) override;
  bool holds(const std::string& name) const override;
  std::string place() const override;

 private:
  template <class Number>
  void read(const std::string& name, std::span<Number> numbers);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cinch
