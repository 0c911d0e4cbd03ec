// HDF5 files without its C API's handles: opened, read and written, or an InputError that names what is
// wrong.
#pragma once

#include "geometry/tetra_mesh.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace omentum::organ {

/// Where a dataset's numbers lie in its file.
struct Extent {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// An open HDF5 file. Errors are geometry::InputError "FILE: ...". From the first one on, HDF5's own error
/// printing is off in this process. One thread of a process at a time.
class Hdf5File {
 public:
  enum class Mode { kRead, kUpdate, kCreate };

  static constexpr std::size_t kLongestText = 4096;

  /// A created file is empty; datasets in it are aligned to 64 bytes, so that they can be mapped.
  Hdf5File(const std::filesystem::path& file, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// T is float, double, std::int32_t, std::int64_t or std::uint8_t. Intermediate groups are made.
  template <class T>
  void write(const std::string& dataset, std::span<const T> values, const std::vector<std::uint64_t>& shape);
  /// Rows of `columns` numbers each; a list where `columns` is 0. Throws unless the dataset has that shape
  /// and type and lies in the file as it is, in one piece.
  template <class T>
  std::vector<T> read(const std::string& dataset, std::uint64_t columns) const;

  /// Makes room for a contiguous dataset of T that is filled past HDF5, and tells where.
  template <class T>
  Extent reserve(const std::string& dataset, const std::vector<std::uint64_t>& shape);
  /// Where an existing contiguous dataset of T lies. Throws unless its shape is `shape`, its type is T and
  /// all of it lies in the file.
  template <class T>
  Extent locate(const std::string& dataset, const std::vector<std::uint64_t>& shape) const;

  /// Attributes of the root group.
  void write_text(const std::string& attribute, const std::string& value);
  void write_number(const std::string& attribute, double value);
  /// At most kLongestText characters.
  std::string read_text(const std::string& attribute) const;
  double read_number(const std::string& attribute) const;
  /// A whole number from `low` to 2^31 - 1.
  std::int32_t read_count(const std::string& attribute, std::int32_t low) const;
  bool has_attribute(const std::string& attribute) const;
  /// Or a group of that name; its own group must be there.
  bool has_dataset(const std::string& dataset) const;

  void flush();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  Extent extent_of(const std::string& dataset, std::int64_t data, std::uint64_t count,
                   std::uint64_t each) const;

  std::filesystem::path path_;
  std::int64_t file_ = -1;  // hid_t
};

}  // namespace omentum::organ
