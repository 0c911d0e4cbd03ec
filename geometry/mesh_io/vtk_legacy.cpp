// Legacy VTK: "VTK File Formats" (Kitware), simple legacy formats; the cell arrays of version 5 as well.
#include "geometry/mesh_io/file_cursor.h"
#include "geometry/mesh_io/mesh_formats.h"
#include "geometry/mesh_io/vtk_cells.h"
#include "geometry/region_labels.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace omentum::geometry {
namespace {

// Beyond, a double has no whole numbers of its own.
constexpr double kLargestLabel = 9007199254740992.0;

class VtkReader {
 public:
  explicit VtkReader(const std::filesystem::path& file) : in_(file) { mesh_.source = in_.name(); }

  RawMesh read();

 private:
  void read_header();
  void read_points();
  void read_cells();
  void read_cells_of_version_5(std::size_t offsets, std::size_t connectivity);
  void read_cell_types();
  // Of what belongs to cells, to points, or to the grid as a whole.
  enum class Owner { kGrid, kPoints, kCells };
  void read_data();
  void read_scalars(Owner owner, std::size_t tuples);
  void read_field(Owner owner);
  void read_array(Owner owner, const std::string& name, const std::string& type, std::size_t components,
                  std::size_t tuples);
  std::vector<std::int64_t> labels(const std::string& name, const std::string& type);
  void skip_metadata();
  std::size_t bytes_of(const std::string& type);
  std::int64_t integer_of(const std::string& type, const char* expected);
  double real_of(const std::string& type, const char* expected);
  std::vector<std::int64_t> integers(const std::string& type, std::size_t count, const char* expected);

  FileCursor in_;
  RawMesh mesh_;
  bool binary_ = false;
  double version_ = 0;
  VtkCells cells_;
  CellLabels labels_;
};

RawMesh VtkReader::read() {
  read_header();
  while (cells_.types.empty() && !in_.at_end()) {
    const std::string_view keyword = in_.word("a keyword");
    if (keyword == "POINTS") {
      read_points();
    } else if (keyword == "CELLS") {
      read_cells();
    } else if (keyword == "CELL_TYPES") {
      read_cell_types();
    } else if (keyword == "FIELD") {
      read_field(Owner::kGrid);
    } else if (keyword == "METADATA") {
      skip_metadata();
    } else {
      in_.fail(keyword, "POINTS, CELLS, CELL_TYPES, FIELD or METADATA");
    }
  }
  // whatever stands behind a mesh, the mesh is read
  try {
    read_data();
  } catch (const InputError& error) {
    labels_.miss(error.what());
  }
  cells_.labels = labels_.take(mesh_.why_no_regions);
  append_tetrahedra(cells_, 0, 0, mesh_);
  return std::move(mesh_);
}

void VtkReader::read_header() {
  constexpr std::string_view kMagic = "# vtk DataFile Version ";
  const std::string_view first = in_.rest_of_line();
  if (!first.starts_with(kMagic)) in_.fail("another first line", "'# vtk DataFile Version ...'");
  version_ = std::atof(std::string(first.substr(kMagic.size())).c_str());
  in_.rest_of_line();
  const std::string_view coding = in_.word("ASCII or BINARY");
  if (coding != "ASCII" && coding != "BINARY") in_.fail(coding, "ASCII or BINARY");
  binary_ = coding == "BINARY";
  if (in_.word("DATASET") != "DATASET") in_.fail("something else", "DATASET");
  const std::string_view kind = in_.word("UNSTRUCTURED_GRID");
  if (kind == "POLYDATA") in_.fail("POLYDATA (a surface)", "UNSTRUCTURED_GRID (a mesh of tetrahedra)");
  if (kind != "UNSTRUCTURED_GRID") in_.fail(kind, "UNSTRUCTURED_GRID");
}

double VtkReader::real_of(const std::string& type, const char* expected) {
  if (!binary_) return in_.real(expected);
  if (type == "float") return in_.binary<float>(expected, std::endian::big);
  if (type == "double") return in_.binary<double>(expected, std::endian::big);
  in_.fail("points of type " + type, "float or double");
}

std::int64_t VtkReader::integer_of(const std::string& type, const char* expected) {
  if (!binary_) return in_.integer(expected);
  constexpr auto kBig = std::endian::big;
  if (type == "int") return in_.binary<std::int32_t>(expected, kBig);
  if (type == "vtktypeint64" || type == "long") return in_.binary<std::int64_t>(expected, kBig);
  if (type == "short") return in_.binary<std::int16_t>(expected, kBig);
  if (type == "char") return in_.binary<std::int8_t>(expected, kBig);
  if (type == "unsigned_int") return in_.binary<std::uint32_t>(expected, kBig);
  if (type == "unsigned_short") return in_.binary<std::uint16_t>(expected, kBig);
  if (type == "unsigned_char") return in_.binary<std::uint8_t>(expected, kBig);
  in_.fail("integers of type " + type, "int, long or vtktypeint64");
}

std::vector<std::int64_t> VtkReader::integers(const std::string& type, std::size_t count,
                                              const char* expected) {
  std::vector<std::int64_t> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) values.push_back(integer_of(type, expected));
  return values;
}

void VtkReader::read_points() {
  const std::size_t count = in_.count("the number of points");
  const std::string type(in_.word("the points' type"));
  if (binary_) in_.rest_of_line();
  mesh_.positions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = real_of(type, "x of a point"), y = real_of(type, "y of a point"),
                 z = real_of(type, "z of a point");
    mesh_.positions.emplace_back(x, y, z);
  }
}

void VtkReader::read_cells() {
  const std::size_t first = in_.count("the number of cells");
  const std::size_t second = in_.count("the length of the cell list");
  if (version_ >= 5) return read_cells_of_version_5(first, second);
  if (binary_) in_.rest_of_line();
  const std::vector<std::int64_t> list = integers("int", second, "a number of the cell list");
  std::size_t at = 0;
  for (std::size_t c = 0; c < first; ++c) {
    if (at >= list.size() || list[at] < 0 || static_cast<std::size_t>(list[at]) >= list.size() - at) {
      in_.fail("cell " + std::to_string(c) + " beyond the end of the list", "cells that fill the list");
    }
    const auto length = static_cast<std::size_t>(list[at]);
    cells_.start.push_back(std::ssize(cells_.nodes));
    cells_.nodes.insert(cells_.nodes.end(), list.begin() + static_cast<std::ptrdiff_t>(at + 1),
                        list.begin() + static_cast<std::ptrdiff_t>(at + 1 + length));
    at += length + 1;
  }
  cells_.start.push_back(std::ssize(cells_.nodes));
}

void VtkReader::read_cells_of_version_5(std::size_t offsets, std::size_t connectivity) {
  const auto array = [&](const char* name, std::size_t count) {
    if (in_.word(name) != name) in_.fail("something else", name);
    const std::string type(in_.word("the type of an array"));
    if (binary_) in_.rest_of_line();
    return integers(type, count, "a number of the cell list");
  };
  cells_.start = array("OFFSETS", offsets);
  cells_.nodes = array("CONNECTIVITY", connectivity);
}

void VtkReader::read_cell_types() {
  const std::size_t count = in_.count("the number of cell types");
  if (count + 1 != cells_.start.size()) in_.fail(std::to_string(count) + " cell types", "one for each cell");
  if (binary_) in_.rest_of_line();
  cells_.types = integers("int", count, "a cell type");
}

// Arrays of `components` x `tuples` numbers.
void VtkReader::read_field(Owner owner) {
  in_.word("the name of a field");
  const std::size_t arrays = in_.count("the number of arrays");
  for (std::size_t a = 0; a < arrays; ++a) {
    const std::string name(in_.word("the name of an array"));
    const std::size_t components = in_.count("the number of components"),
                      tuples = in_.count("the number of tuples");
    const std::string type(in_.word("the type of an array"));
    if (binary_) in_.rest_of_line();
    read_array(owner, name, type, components, tuples);
  }
}

void VtkReader::read_scalars(Owner owner, std::size_t tuples) {
  const std::string name(in_.word("the name of an array"));
  std::istringstream rest{std::string(in_.rest_of_line())};
  std::string type;
  std::size_t components = 0;
  rest >> type;
  if (!(rest >> components)) components = 1;
  if (in_.word("LOOKUP_TABLE") != "LOOKUP_TABLE") in_.fail("something else", "LOOKUP_TABLE");
  in_.rest_of_line();
  read_array(owner, name, type, components, tuples);
}

void VtkReader::read_array(Owner owner, const std::string& name, const std::string& type,
                           std::size_t components, std::size_t tuples) {
  if (tuples != 0 && components > in_.remaining() / tuples)
    in_.fail("an array that is longer than the file", "components and tuples");
  if (owner == Owner::kCells && components == 1 && tuples == cells_.types.size() && is_label_name(name)) {
    labels_.add(name, labels(name, type));
  } else if (binary_) {
    in_.skip(components * tuples * bytes_of(type), "the values of an array");
  } else {
    for (std::size_t i = 0; i < components * tuples; ++i) in_.word("a value of an array");
  }
}

// Whole numbers of any type: some programs write all of their arrays as real numbers.
std::vector<std::int64_t> VtkReader::labels(const std::string& name, const std::string& type) {
  const std::size_t count = cells_.types.size();
  if (type != "float" && type != "double") return integers(type, count, "a label of a cell");
  std::vector<std::int64_t> values;
  for (std::size_t c = 0; c < count; ++c) {
    const double value = real_of(type, "a label of a cell");
    if (value != std::trunc(value) || std::abs(value) > kLargestLabel)
      in_.fail("the number " + std::to_string(value) + " in array '" + name + "'", "whole numbers");
    values.push_back(static_cast<std::int64_t>(value));
  }
  return values;
}

// Behind the mesh: of all data the labels of cells alone are looked at.
void VtkReader::read_data() {
  Owner owner = Owner::kGrid;
  std::size_t tuples = 0;
  while (!in_.at_end()) {
    const std::string_view keyword = in_.word("a keyword");
    if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
      owner = keyword == "CELL_DATA" ? Owner::kCells : Owner::kPoints;
      tuples = in_.count("the number of cells or points");
    } else if (keyword == "SCALARS") {
      read_scalars(owner, tuples);
    } else if (keyword == "VECTORS" || keyword == "NORMALS") {
      const std::string name(in_.word("the name of an array")), type(in_.word("the type of an array"));
      if (binary_) in_.rest_of_line();
      read_array(owner, name, type, 3, tuples);
    } else if (keyword == "FIELD") {
      read_field(owner);
    } else if (keyword == "METADATA") {
      skip_metadata();
    } else {
      in_.fail(keyword, "SCALARS, VECTORS, NORMALS, FIELD or METADATA");
    }
  }
}

std::size_t VtkReader::bytes_of(const std::string& type) {
  constexpr std::pair<const char*, std::size_t> kBytes[] = {
      {"char", 1},          {"unsigned_char", 1}, {"short", 2},         {"unsigned_short", 2},
      {"int", 4},           {"unsigned_int", 4},  {"float", 4},         {"long", 8},
      {"unsigned_long", 8}, {"vtktypeint64", 8},  {"vtktypeuint64", 8}, {"double", 8}};
  for (const auto& [name, bytes] : kBytes) {
    if (type == name) return bytes;
  }
  in_.fail("an array of type " + type, "an array of numbers");
}

// Lines up to an empty one.
void VtkReader::skip_metadata() {
  in_.rest_of_line();
  while (in_.remaining() > 0 && !in_.rest_of_line().empty()) continue;
}

}  // namespace

RawMesh read_vtk_legacy(const std::filesystem::path& file) {
  return VtkReader(file).read();
}

}  // namespace omentum::geometry
