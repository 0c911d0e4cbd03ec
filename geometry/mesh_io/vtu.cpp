// VTK XML unstructured grids: "VTK File Formats" (Kitware), XML formats.
#include "geometry/mesh_io/mesh_formats.h"
#include "geometry/mesh_io/vtk_cells.h"
#include "geometry/mesh_io/vtu_arrays.h"
#include "geometry/region_labels.h"

namespace omentum::geometry {
namespace {

pugi::xml_node child_of(const VtuArrays& arrays, pugi::xml_node parent, const char* name) {
  const pugi::xml_node child = parent.child(name);
  if (!child) arrays.fail("no <" + std::string(name) + "> in <" + parent.name() + ">", "one");
  return child;
}

pugi::xml_node named_array(const VtuArrays& arrays, pugi::xml_node parent, const char* name) {
  const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
  if (!array) arrays.fail("no array '" + std::string(name) + "' in <" + parent.name() + ">", "one");
  return array;
}

void read_points(const VtuArrays& arrays, pugi::xml_node piece, RawMesh& mesh) {
  const std::vector<double> xyz =
      arrays.reals(child_of(arrays, child_of(arrays, piece, "Points"), "DataArray"));
  if (xyz.size() % 3 != 0 || xyz.size() / 3 != piece.attribute("NumberOfPoints").as_ullong()) {
    arrays.fail(std::to_string(xyz.size()) + " coordinates", "three for each of NumberOfPoints");
  }
  for (std::size_t i = 0; i < xyz.size(); i += 3) mesh.positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
}

std::vector<std::int32_t> read_labels(const VtuArrays& arrays, pugi::xml_node piece,
                                      std::string& why_no_regions) {
  CellLabels labels;
  for (const pugi::xml_node array : piece.child("CellData").children("DataArray")) {
    const std::string name = array.attribute("Name").value();
    if (!is_label_name(name) || array.attribute("NumberOfComponents").as_int(1) != 1) continue;
    // the mesh can be read without them
    try {
      const std::vector<std::int64_t> values = arrays.integers(array);
      if (values.size() != piece.attribute("NumberOfCells").as_ullong())
        arrays.fail(std::to_string(values.size()) + " values of array '" + name + "'", "one for each cell");
      labels.add(name, values);
    } catch (const InputError& error) {
      labels.miss(error.what());
    }
  }
  return labels.take(why_no_regions);
}

VtkCells read_cells(const VtuArrays& arrays, pugi::xml_node piece, std::string& why_no_regions) {
  const pugi::xml_node node = child_of(arrays, piece, "Cells");
  VtkCells cells;
  cells.nodes = arrays.integers(named_array(arrays, node, "connectivity"));
  cells.types = arrays.integers(named_array(arrays, node, "types"));
  cells.start = {0};
  const std::vector<std::int64_t> ends = arrays.integers(named_array(arrays, node, "offsets"));
  cells.start.insert(cells.start.end(), ends.begin(), ends.end());
  const auto count = piece.attribute("NumberOfCells").as_ullong();
  if (cells.types.size() != count || ends.size() != count) {
    arrays.fail(std::to_string(cells.types.size()) + " types and " + std::to_string(ends.size()) + " offsets",
                "NumberOfCells of both");
  }
  cells.labels = read_labels(arrays, piece, why_no_regions);
  return cells;
}

}  // namespace

RawMesh read_vtu(const std::filesystem::path& file) {
  const VtuArrays arrays(file);
  RawMesh mesh;
  mesh.source = file.string();
  std::size_t first_cell = 0;  // of a piece: the numbers go on from one to the next
  for (const pugi::xml_node piece : child_of(arrays, arrays.root(), "UnstructuredGrid").children("Piece")) {
    const std::size_t first_node = mesh.positions.size();
    read_points(arrays, piece, mesh);
    const VtkCells cells = read_cells(arrays, piece, mesh.why_no_regions);
    append_tetrahedra(cells, first_node, first_cell, mesh);
    first_cell += cells.types.size();
  }
  return mesh;
}

}  // namespace omentum::geometry
