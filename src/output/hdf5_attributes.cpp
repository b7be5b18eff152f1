// Attributes of HDF5 objects: single values, short texts.
#include "output/hdf5_file.hpp"

namespace cinch::h5 {
void File::write_attribute(const std::string& object, const char* name, hid_t stored, hid_t memory,
                           std::optional<hsize_t> length, const void* data) {
  const std::string what = object + "@" + name;
  const Handle space(length ? H5Screate_simple(1, &*length, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate_by_name(id(), object.c_str(), name, stored, space.get(), H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), memory, data) < 0) fail("write " + what);
}

void File::read_attribute(const std::string& object, const char* name, hid_t memory, void* into) const {
  const Handle attribute(H5Aopen_by_name(id(), object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute || H5Aread(attribute.get(), memory, into) < 0) fail("read " + object + "@" + name);
}

void File::set_attribute(const std::string& object, const char* name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {}, &value);
}

void File::set_attribute(const std::string& object, const char* name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void File::set_attribute(const std::string& object, const char* name, std::span<const std::int64_t> values) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
}

void File::set_attribute(const std::string& object, const char* name, std::string_view value) {
  const Handle type = text_type();
  const std::string text(value);
  const char* pointer = text.c_str();
  write_attribute(object, name, type.get(), type.get(), {}, &pointer);
}

void File::set_ascii_attribute(const std::string& object, const char* name, std::string_view value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), value.size());
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  write_attribute(object, name, type.get(), type.get(), {}, value.data());
}

bool File::has_attribute(const std::string& object, const char* name) const {
  return H5Aexists_by_name(id(), object.c_str(), name, H5P_DEFAULT) > 0;
}

std::int64_t File::integer_attribute(const std::string& object, const char* name) const {
  std::int64_t value = 0;
  read_attribute(object, name, H5T_NATIVE_INT64, &value);
  return value;
}

double File::real_attribute(const std::string& object, const char* name) const {
  double value = 0;
  read_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::string File::text_attribute(const std::string& object, const char* name) const {
  const Handle type = text_type();
  char* pointer = nullptr;
  read_attribute(object, name, type.get(), &pointer);
  const std::string text = pointer ? pointer : "";
  H5free_memory(pointer);
  return text;
}

Counter::Counter(File& file, const std::string& object, const char* name)
    : file_(&file),
      what_(object + "@" + name),
      object_(H5Oopen(file.id(), object.c_str(), H5P_DEFAULT), H5Oclose) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  attribute_ =
      Handle(H5Acreate2(object_.get(), name, H5T_STD_I64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute_) file_->fail("create " + what_);
  set(0);
}

void Counter::set(std::int64_t value) {
  if (H5Awrite(attribute_.get(), H5T_NATIVE_INT64, &value) < 0) file_->fail("write " + what_);
}

}  // namespace cinch::h5
