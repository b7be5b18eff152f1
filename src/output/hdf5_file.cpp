#include "output/hdf5_file.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>

#include "base/error.hpp"

namespace cinch::h5 {

template <>
struct Number<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t stored() { return H5T_IEEE_F64LE; }
};
template <>
struct Number<std::int64_t> {
  static hid_t memory() { return H5T_NATIVE_INT64; }
  static hid_t stored() { return H5T_STD_I64LE; }
};
template <>
struct Number<std::int32_t> {
  static hid_t memory() { return H5T_NATIVE_INT32; }
  static hid_t stored() { return H5T_STD_I32LE; }
};
template <>
struct Number<std::uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t stored() { return H5T_STD_U8LE; }
};

namespace {

// The index of a growing data set changes while its earlier rows are already promised to the reader. A kill
// can cut a write at a page boundary, so each node of an index (2 to 3 kB) lies inside one page.
constexpr hsize_t kAlignFrom = 2048, kPage = 4096;

constexpr std::size_t kSmallRows = 1 << 16;  // bytes

// Once a file was abandoned none is closed any more: opened again for reading in this process it would share
// the half-written state, and closing it would write that.
std::atomic<bool> some_file_was_abandoned = false;
herr_t close_file(hid_t file) { return some_file_was_abandoned ? 0 : H5Fclose(file); }

// HDF5 prints its error stack by default, once for each thread that uses it. At exit it would write files
// that were abandoned (and crash on them).
void silence() {
  static const bool no_exit_handler = H5dont_atexit() >= 0;
  static_cast<void>(no_exit_handler);
  thread_local const bool done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  static_cast<void>(done);
}

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc) *static_cast<std::string*>(text) = error->desc;
  return 1;  // the first one met is the innermost
}

// "unable to open file: name = 'x', errno = 2, error message = 'No such file or directory', ..." -> the
// message.
std::string innermost_reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &text);
  static constexpr std::string_view kMark = "error message = '";
  if (const auto at = text.find(kMark); at != std::string::npos) {
    text.erase(0, at + kMark.size());
    text.erase(std::min(text.find('\''), text.size()));
  }
  return text;
}

[[noreturn]] void throw_failure(const std::filesystem::path& path, const std::string& what,
                                const std::string& reason) {
  throw FileError(path.string() + ": cannot " + what + (reason.empty() ? "" : ": " + reason));
}

Handle file_access(bool grows) {
  silence();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), 0, 1);
  if (grows) H5Pset_alignment(access.get(), kAlignFrom, kPage);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return access;
}

hsize_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

Handle make_space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

// Property lists are kept in variables until a failure is reported: closing one clears HDF5's reason.
Handle parents() {
  Handle list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(list.get(), 1);
  return list;
}

// Texts are converted on their way, through a buffer that HDF5 clears each time: 1 MiB by default, which
// would be most of a short run's time.
Handle transfer() {
  Handle list(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_buffer(list.get(), 16 * 1024, nullptr, nullptr);
  return list;
}

}  // namespace

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
  }
  return *this;
}

void Handle::reset() {
  if (id_ >= 0) close_(id_);
  id_ = -1;
}

File File::create(const std::filesystem::path& path, hsize_t user_block) {
  const Handle access = file_access(user_block == 0);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation.get(), user_block);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), close_file);
  if (!file) throw_failure(path, "create the file", innermost_reason());
  return {path, std::move(file), true};
}

File File::open(const std::filesystem::path& path) {
  const Handle access = file_access(false);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), close_file);
  if (!file) throw_failure(path, "open it as an HDF5 file", innermost_reason());
  return {path, std::move(file), false};
}

void File::fail(const std::string& what) const {
  const std::string reason = innermost_reason();
  if (writing_) {
    some_file_was_abandoned = true;
    file_.abandon();
  }
  throw_failure(path_, what, reason);
}

void File::flush() {
  silence();
  if (H5Fflush(id(), H5F_SCOPE_GLOBAL) < 0) fail("write to the disk");
}

void File::create_link(const std::string& existing, const std::string& name) {
  silence();
  const Handle above = parents();
  if (H5Lcreate_hard(id(), existing.c_str(), id(), name.c_str(), above.get(), H5P_DEFAULT) < 0) {
    fail("create " + name);
  }
}

bool File::exists(const std::string& name) const {
  silence();
  // H5Lexists answers for the last link only: walk down.
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    if (H5Lexists(id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Handle File::open_dataset(const std::string& name) const {
  silence();
  Handle dataset(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset) fail("find " + name);
  return dataset;
}

Shape File::shape(const std::string& name) const {
  const Handle dataset = open_dataset(name);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  Shape shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank < 0 || H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) < 0) {
    fail("read the shape of " + name);
  }
  return shape;
}

void File::write_raw(const std::string& name, hid_t memory, hid_t stored, const void* data,
                     const Shape& shape, std::string_view unit) {
  silence();
  const Handle space = make_space(shape), above = parents(), way = transfer();
  const Handle dataset(
      H5Dcreate2(id(), name.c_str(), stored, space.get(), above.get(), H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!dataset) fail("create " + name);
  if (product(shape) > 0 && H5Dwrite(dataset.get(), memory, H5S_ALL, H5S_ALL, way.get(), data) < 0) {
    fail("write " + name);
  }
  if (!unit.empty()) set_attribute(name, "unit", unit);
}

void File::read_raw(const std::string& name, hid_t memory, hsize_t start, hsize_t count, std::size_t values,
                    void* into) const {
  const Handle dataset = open_dataset(name);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  Shape first = shape(name);
  if (first.empty()) fail("read " + name + " (a single value where rows were expected)");
  Shape extent = first;
  if (start + count > extent[0]) fail("read " + name + " (it is shorter than expected)");
  std::fill(first.begin(), first.end(), hsize_t{0});
  first[0] = start;
  extent[0] = count;
  if (product(extent) != values) fail("read " + name + " (unexpected shape)");
  if (values == 0) return;
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, first.data(), nullptr, extent.data(), nullptr);
  const Handle target = make_space(extent);
  if (H5Dread(dataset.get(), memory, target.get(), space.get(), H5P_DEFAULT, into) < 0) fail("read " + name);
}

template <class T>
void File::write(const std::string& name, std::span<const T> values, const Shape& shape,
                 std::string_view unit) {
  if (product(shape) != values.size()) fail("write " + name + " (shape and number of values differ)");
  write_raw(name, Number<T>::memory(), Number<T>::stored(), values.data(), shape, unit);
}

template <class T>
std::vector<T> File::read(const std::string& name) const {
  const Shape dims = shape(name);
  std::vector<T> values(product(dims));
  if (!dims.empty()) read_rows<T>(name, 0, dims[0], values);
  return values;
}

template <class T>
void File::read_rows(const std::string& name, hsize_t start, hsize_t count, std::span<T> into) const {
  read_raw(name, Number<T>::memory(), start, count, into.size(), into.data());
}

void File::write_text(const std::string& name, const std::string& text) {
  const char* pointer = text.c_str();
  write_raw(name, text_type().get(), text_type().get(), &pointer, {}, {});
}

void File::write_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  write_raw(name, text_type().get(), text_type().get(), pointers.data(), {pointers.size()}, {});
}

std::vector<std::string> File::read_texts(const std::string& name) const {
  const Handle dataset = open_dataset(name);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const Handle type = text_type(), way = transfer();
  std::vector<char*> pointers(product(shape(name)), nullptr);
  if (pointers.empty()) return {};
  if (H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, way.get(), pointers.data()) < 0) {
    fail("read " + name);
  }
  std::vector<std::string> texts;
  for (const char* pointer : pointers) texts.emplace_back(pointer ? pointer : "");
  H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, pointers.data());
  return texts;
}

std::string File::read_text(const std::string& name) const {
  const auto texts = read_texts(name);
  return texts.empty() ? std::string() : texts[0];
}

template <class T>
Series<T>::Series(File& file, std::string name, const SeriesLayout& layout)
    : file_(&file), name_(std::move(name)), row_(layout.row) {
  silence();
  Shape now{0}, most{H5S_UNLIMITED}, chunk{std::max<hsize_t>(layout.chunk_rows, 1)};
  for (const hsize_t extent : row_) {
    now.push_back(extent);
    most.push_back(extent);
    chunk.push_back(extent);
  }
  const Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), above = parents();
  H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  if (layout.compress) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), 1);
  } else {
    // rows go straight to their place: no chunk is filled or kept in memory, however large
    H5Pset_chunk_cache(access.get(), 0, 0, 0);
    H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  }
  dataset_ = Handle(H5Dcreate2(file.id(), name_.c_str(), Number<T>::stored(), space.get(), above.get(),
                               creation.get(), access.get()),
                    H5Dclose);
  if (!dataset_) file.fail("create " + name_);
  if (!layout.unit.empty()) file.set_attribute(name_, "unit", layout.unit);
}

// Large rows go straight to HDF5.
template <class T>
void Series<T>::append(std::span<const T> values) {
  if (values.size() % product(row_) != 0) file_->fail("append to " + name_ + " (not a whole number of rows)");
  if (values.size_bytes() < kSmallRows) {
    waiting_.insert(waiting_.end(), values.begin(), values.end());
  } else {
    hand_over();
    write(values);
  }
}

template <class T>
void Series<T>::hand_over() {
  write(waiting_);
  waiting_.clear();
}

template <class T>
void Series<T>::write(std::span<const T> values) {
  silence();
  if (values.empty()) return;
  Shape start(row_.size() + 1, 0), count{values.size() / product(row_)}, total{rows_ + count[0]};
  start[0] = rows_;
  count.insert(count.end(), row_.begin(), row_.end());
  total.insert(total.end(), row_.begin(), row_.end());
  if (H5Dset_extent(dataset_.get(), total.data()) < 0) file_->fail("extend " + name_);
  const Handle memory = make_space(count);
  const Handle space(H5Dget_space(dataset_.get()), H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  if (H5Dwrite(dataset_.get(), Number<T>::memory(), memory.get(), space.get(), H5P_DEFAULT, values.data()) <
      0) {
    file_->fail("write " + name_);
  }
  rows_ = total[0];
}

#define CINCH_H5_NUMBER(T)                                                                              \
  template void File::write<T>(const std::string&, std::span<const T>, const Shape&, std::string_view); \
  template std::vector<T> File::read<T>(const std::string&) const;                                      \
  template void File::read_rows<T>(const std::string&, hsize_t, hsize_t, std::span<T>) const;           \
  template class Series<T>;
CINCH_H5_NUMBER(double)
CINCH_H5_NUMBER(std::int64_t)
CINCH_H5_NUMBER(std::int32_t)
CINCH_H5_NUMBER(std::uint8_t)
#undef CINCH_H5_NUMBER

}  // namespace cinch::h5
