// Reads what a Recorder wrote, finished or not.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace cinch {

/// A result on disk as it was when opened: the frames that were complete then, even if the writer was killed
/// or is still at work. Every function throws FileError when the file cannot be read.
class Result {
 public:
  /// `path`: the run's directory or its .vtkhdf file. Throws FileError for anything that is not a Cinch
  /// result.
  explicit Result(const std::filesystem::path& path);
  Result(Result&&) noexcept;
  ~Result();

  const ResultModel& model() const;
  int frames() const;
  const std::vector<double>& frame_times() const;  ///< s
  const std::vector<std::int64_t>& frame_steps() const;
  Frame frame(int k) const;                ///< k = 0 .. frames() - 1; read from disk at each call
  std::vector<Energies> energies() const;  ///< J, one for each frame

  std::vector<double> probe_times() const;                     ///< s, one for each row of the probe table
  std::vector<double> probe_rows(std::size_t count) const;     ///< the first `count` rows, all columns
  std::vector<double> probe(const std::string& column) const;  ///< FileError names the columns there are
  bool has_probe(const std::string& column) const;

  /// Of the run that wrote it, the same beyond stops and restarts; empty where an earlier version wrote it.
  const std::string& run_id() const;
  /// The verdict; absent when the run was killed or is not over yet.
  const std::optional<Summary>& summary() const;
  const std::filesystem::path& path() const;  ///< of the .vtkhdf file

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cinch
