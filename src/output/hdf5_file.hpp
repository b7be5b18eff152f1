// A thin layer over the HDF5 C API: handles that close themselves, and failures that become FileError.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cinch::h5 {

using Shape = std::vector<hsize_t>;

/// Owns one HDF5 identifier and closes it at the end of its life.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  void reset();
  void abandon() { id_ = -1; }  ///< never closes it

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// HDF5's name of a C++ number type, in memory and (little endian) in the file.
template <class T>
struct Number;

Handle text_type();  ///< texts of any length, UTF-8

/// An open HDF5 file. Names are absolute paths inside the file ("/cinch/energy"). File locking is off, so
/// that others can read what is still being written. Every failure throws FileError: file, name, HDF5's own
/// reason.
class File {
 public:
  /// Replaces an existing file. The first `user_block` bytes (0, or a power of 2 from 512 on) are left to
  /// others; only a file without such can grow for long and be read after a kill.
  static File create(const std::filesystem::path& path, hsize_t user_block = 0);
  static File open(const std::filesystem::path& path);  ///< for reading

  /// The file has been moved there by others.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }

  const std::filesystem::path& path() const { return path_; }
  hid_t id() const { return file_.get(); }
  void flush();

  void create_link(const std::string& existing, const std::string& name);  ///< a second name for one data set
  bool exists(const std::string& name) const;
  Shape shape(const std::string& name) const;

  template <class T>
  void write(const std::string& name, std::span<const T> values, const Shape& shape,
             std::string_view unit = {});
  template <class T>
  std::vector<T> read(const std::string& name) const;
  /// `count` rows of the first dimension from row `start` on.
  template <class T>
  void read_rows(const std::string& name, hsize_t start, hsize_t count, std::span<T> into) const;

  void write_text(const std::string& name, const std::string& text);
  std::string read_text(const std::string& name) const;
  void write_texts(const std::string& name, const std::vector<std::string>& texts);
  std::vector<std::string> read_texts(const std::string& name) const;

  void set_attribute(const std::string& object, const char* name, std::int64_t value);
  void set_attribute(const std::string& object, const char* name, double value);
  void set_attribute(const std::string& object, const char* name, std::string_view value);
  void set_attribute(const std::string& object, const char* name, std::span<const std::int64_t> values);
  void set_ascii_attribute(const std::string& object, const char* name,
                           std::string_view value);  ///< fixed length
  bool has_attribute(const std::string& object, const char* name) const;
  std::int64_t integer_attribute(const std::string& object, const char* name) const;
  double real_attribute(const std::string& object, const char* name) const;
  std::string text_attribute(const std::string& object, const char* name) const;

  /// Throws FileError: "PATH: cannot WHAT: reason". A file being written is abandoned: closing it would write
  /// what is only half there, and spoil what was complete. Nothing more can be written then.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  File(std::filesystem::path path, Handle file, bool writing)
      : path_(std::move(path)), file_(std::move(file)), writing_(writing) {}
  Handle open_dataset(const std::string& name) const;
  void write_raw(const std::string& name, hid_t memory, hid_t stored, const void* data, const Shape& shape,
                 std::string_view unit);
  void read_raw(const std::string& name, hid_t memory, hsize_t start, hsize_t count, std::size_t values,
                void* into) const;
  void write_attribute(const std::string& object, const char* name, hid_t stored, hid_t memory,
                       std::optional<hsize_t> length, const void* data);
  void read_attribute(const std::string& object, const char* name, hid_t memory, void* into) const;

  std::filesystem::path path_;
  mutable Handle file_;
  bool writing_;
};

/// How a series is laid out in the file.
struct SeriesLayout {
  Shape row;               ///< shape of one row; empty: a number
  hsize_t chunk_rows = 1;  ///< rows stored together
  bool compress = false;   ///< shuffle + deflate 1
  std::string unit;        ///< attribute `unit`, if not empty
};

/// A data set that grows along its first dimension. Small rows wait in memory until they are handed over, as
/// each call of HDF5 takes longer than to write them.
template <class T>
class Series {
 public:
  Series(File& file, std::string name, const SeriesLayout& layout);
  /// Appends whole rows; the number of values must be a multiple of a row's.
  void append(std::span<const T> values);
  void append(T value) { append(std::span<const T>(&value, 1)); }
  /// Writes the rows that wait.
  void hand_over();
  hsize_t rows() const { return rows_; }  ///< handed over
  std::size_t waiting_bytes() const { return waiting_.size() * sizeof(T); }

 private:
  void write(std::span<const T> values);

  File* file_;
  std::string name_;
  Shape row_;
  hsize_t rows_ = 0;
  std::vector<T> waiting_;
  Handle dataset_;
};

template <class... SeriesOfAnyType>
void hand_over(SeriesOfAnyType&... series) {
  (series.hand_over(), ...);
}

/// A number kept as an attribute of an object: raised when what it counts is complete on disk.
class Counter {
 public:
  Counter(File& file, const std::string& object, const char* name);  ///< starts at 0
  void set(std::int64_t value);

 private:
  File* file_;
  std::string what_;
  Handle object_, attribute_;
};

}  // namespace cinch::h5
