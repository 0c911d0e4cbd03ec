#include "organ/hdf5_file.h"

#include "geometry/mesh_io/file_kind.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include <unistd.h>

namespace omentum::organ {

namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

// A cache line, so that a mapped dataset begins at one: every object, however small.
constexpr hsize_t kAlignment = 64;
constexpr hsize_t kAlignFrom = 1;

// Closes an HDF5 handle of any kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

template <class T>
hid_t type_of();
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

hid_t create_dataset(hid_t file, const std::string& name, hid_t type,
                     const std::vector<std::uint64_t>& shape) {
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Handle storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_layout(storage, H5D_CONTIGUOUS);
  H5Pset_alloc_time(storage, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(storage, H5D_FILL_TIME_NEVER);
  return H5Dcreate2(file, name.c_str(), type, space, links, storage, H5P_DEFAULT);
}

std::vector<std::uint64_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> dims(std::max(0, H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

std::uint64_t count_of(const std::vector<std::uint64_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

// A damaged shape must not ask for all memory.
bool fits_into(std::uint64_t bytes, const std::vector<std::uint64_t>& shape, std::uint64_t each) {
  std::uint64_t room = bytes / each;
  for (const std::uint64_t extent : shape) {
    if (extent == 0) return true;
    room /= extent;
  }
  return room > 0;
}

// Whether an attribute is one value of the given class.
bool is_single(hid_t attribute, hid_t type, H5T_class_t wanted) {
  const Handle space(H5Aget_space(attribute), H5Sclose);
  return H5Sget_simple_extent_npoints(space) == 1 && H5Tget_class(type) == wanted;
}

std::string words(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t extent : shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text;
}

// The system's, which HDF5 passes on in errno.
std::string reason() {
  return errno != 0 ? std::string(": ") + std::strerror(errno) : std::string(" (disk full?)");
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& file, Mode mode) : path_(file) {
  // HDF5 would clean up at exit, and crash where a full disk left a file half closed
  static const bool left_alone = H5dont_atexit() >= 0;
  static_cast<void>(left_alone);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  errno = 0;
  // what describes the data has checksums from this version of the format on: damage there is refused by
  // HDF5, whose older parts crash on it
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  if (mode == Mode::kCreate) {
    H5Pset_alignment(access, kAlignFrom, kAlignment);
    file_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (file_ < 0) fail("cannot be created");
    return;
  }
  if (!std::filesystem::exists(file)) fail("no such file");
  if (!std::filesystem::is_regular_file(file)) fail("is not a file; expected an organ file");
  if (::access(file.c_str(), mode == Mode::kRead ? R_OK : R_OK | W_OK) != 0)
    fail(std::string("cannot be opened: ") + std::strerror(errno));
  file_ = H5Fopen(file.c_str(), mode == Mode::kRead ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access);
  if (file_ >= 0) return;
  const std::string head = geometry::file_head(file);
  std::string kind = geometry::mesh_kind(head) ? "a mesh (organ_build makes an organ file of it)"
                                               : geometry::foreign_kind(file);
  if (head.starts_with("\x89HDF")) kind.clear();
  fail("is not a whole HDF5 file (" +
       (kind.empty() ? "damaged, truncated or of another kind" : "found " + kind) +
       "); expected an organ file");
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::fail(const std::string& what) const {
  throw geometry::InputError(path_.string() + ": " + what);
}

void Hdf5File::flush() {
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("cannot be written" + reason());
}

template <class T>
void Hdf5File::write(const std::string& dataset, std::span<const T> values,
                     const std::vector<std::uint64_t>& shape) {
  const Handle data(create_dataset(file_, dataset, type_of<T>(), shape), H5Dclose);
  if (!data.ok() ||
      (!values.empty() && H5Dwrite(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)) {
    fail("dataset '" + dataset + "' cannot be written" + reason());
  }
}

// Another layout than ours could hide more numbers than the file has bytes, or those of another file.
Extent Hdf5File::extent_of(const std::string& dataset, std::int64_t data, std::uint64_t count,
                           std::uint64_t each) const {
  const haddr_t offset = H5Dget_offset(data);
  const Handle made(H5Dget_create_plist(data), H5Pclose);
  if (H5Pget_layout(made) != H5D_CONTIGUOUS || H5Pget_external_count(made) != 0 ||
      (offset == HADDR_UNDEF && count > 0)) {
    fail("dataset '" + dataset + "' does not lie in the file in one piece");
  }
  const std::uint64_t size = std::filesystem::file_size(path_);
  if (count > 0 && (offset > size || count > (size - offset) / each)) {
    fail("is truncated: " + std::to_string(size) + " bytes do not hold " + std::to_string(count) +
         " numbers of '" + dataset + "' at " + std::to_string(offset));
  }
  return {count > 0 ? offset : 0, count * each};
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& dataset, std::uint64_t columns) const {
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.ok()) fail("has no dataset '" + dataset + "'; expected an organ file");
  const std::vector<std::uint64_t> shape = shape_of(data);
  if (shape.size() != (columns == 0 ? 1 : 2) || (columns != 0 && shape[1] != columns)) {
    fail("dataset '" + dataset + "' is " + words(shape) + "; expected " +
         (columns == 0 ? "a list" : "rows of " + std::to_string(columns)));
  }
  const Handle type(H5Dget_type(data), H5Tclose);
  if (H5Tequal(type, type_of<T>()) <= 0) fail("dataset '" + dataset + "' is of another number type");
  if (!fits_into(std::filesystem::file_size(path_), shape, sizeof(T)))
    fail("dataset '" + dataset + "' is damaged: " + words(shape) + " numbers are more than the file holds");
  extent_of(dataset, data, count_of(shape), sizeof(T));
  std::vector<T> values(count_of(shape));
  if (!values.empty() && H5Dread(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail("dataset '" + dataset + "' cannot be read");
  }
  return values;
}

template <class T>
Extent Hdf5File::reserve(const std::string& dataset, const std::vector<std::uint64_t>& shape) {
  const Handle data(create_dataset(file_, dataset, type_of<T>(), shape), H5Dclose);
  const haddr_t offset = data.ok() ? H5Dget_offset(data) : HADDR_UNDEF;
  if (offset == HADDR_UNDEF) fail("dataset '" + dataset + "' cannot be made" + reason());
  return {offset, count_of(shape) * sizeof(T)};
}

template <class T>
Extent Hdf5File::locate(const std::string& dataset, const std::vector<std::uint64_t>& shape) const {
  const Handle data(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.ok()) fail("has no dataset '" + dataset + "'; expected an organ file");
  if (shape_of(data) != shape) {
    fail("dataset '" + dataset + "' is " + words(shape_of(data)) + "; expected " + words(shape));
  }
  const Handle type(H5Dget_type(data), H5Tclose);
  if (H5Tequal(type, type_of<T>()) <= 0) fail("dataset '" + dataset + "' is of another number type");
  if (!fits_into(std::filesystem::file_size(path_), shape, sizeof(T)))
    fail("dataset '" + dataset + "' is damaged: " + words(shape) + " numbers are more than the file holds");
  return extent_of(dataset, data, count_of(shape), sizeof(T));
}

void Hdf5File::write_text(const std::string& attribute, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle data(H5Acreate2(file_, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!data.ok() || H5Awrite(data, type, value.c_str()) < 0) fail("'" + attribute + "' cannot be written");
}

void Hdf5File::write_number(const std::string& attribute, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle data(H5Acreate2(file_, attribute.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  if (!data.ok() || H5Awrite(data, H5T_NATIVE_DOUBLE, &value) < 0)
    fail("'" + attribute + "' cannot be written");
}

bool Hdf5File::has_attribute(const std::string& attribute) const {
  return H5Aexists(file_, attribute.c_str()) > 0;
}

bool Hdf5File::has_dataset(const std::string& dataset) const {
  return H5Lexists(file_, dataset.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::read_text(const std::string& attribute) const {
  const Handle data(H5Aopen(file_, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(data), H5Tclose);
  const std::size_t size = type.ok() ? H5Tget_size(type) : 0;
  std::string value(std::min(size, kLongestText), '\0');
  if (!data.ok() || !is_single(data, type, H5T_STRING) || H5Tis_variable_str(type) > 0 ||
      size > kLongestText || H5Aread(data, type, value.data()) < 0) {
    fail("has no text '" + attribute + "'; expected an organ file");
  }
  return value.substr(0, value.find('\0'));
}

double Hdf5File::read_number(const std::string& attribute) const {
  const Handle data(H5Aopen(file_, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(data), H5Tclose);
  double value = 0;
  if (!data.ok() || !is_single(data, type, H5T_FLOAT) || H5Aread(data, H5T_NATIVE_DOUBLE, &value) < 0) {
    fail("has no number '" + attribute + "'; expected an organ file");
  }
  return value;
}

std::int32_t Hdf5File::read_count(const std::string& attribute, std::int32_t low) const {
  constexpr auto kHigh = std::numeric_limits<std::int32_t>::max();
  const double value = read_number(attribute);
  if (!(value >= low && value <= kHigh) || value != std::floor(value)) {
    fail("'" + attribute + "' is " + std::to_string(value) + "; expected a whole number from " +
         std::to_string(low) + " to " + std::to_string(kHigh));
  }
  return static_cast<std::int32_t>(value);
}

template void Hdf5File::write(const std::string&, std::span<const double>, const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::int32_t>,
                              const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::int64_t>,
                              const std::vector<std::uint64_t>&);
template void Hdf5File::write(const std::string&, std::span<const std::uint8_t>,
                              const std::vector<std::uint64_t>&);
template std::vector<double> Hdf5File::read(const std::string&, std::uint64_t) const;
template std::vector<std::int32_t> Hdf5File::read(const std::string&, std::uint64_t) const;
template std::vector<std::int64_t> Hdf5File::read(const std::string&, std::uint64_t) const;
template std::vector<std::uint8_t> Hdf5File::read(const std::string&, std::uint64_t) const;
template Extent Hdf5File::reserve<float>(const std::string&, const std::vector<std::uint64_t>&);
template Extent Hdf5File::reserve<double>(const std::string&, const std::vector<std::uint64_t>&);
template Extent Hdf5File::locate<float>(const std::string&, const std::vector<std::uint64_t>&) const;
template Extent Hdf5File::locate<double>(const std::string&, const std::vector<std::uint64_t>&) const;

}  // namespace omentum::organ
