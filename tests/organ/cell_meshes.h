// Meshes of several kinds of cells, with numbers that are no positions, as the programs of other people write
// them.
#pragma once

#include "tests/support/meshes.h"

#include <sstream>
#include <string>
#include <vector>

namespace omentum::test {

struct CellType {
  int gmsh, vtk;
};
inline constexpr CellType kPointCell{15, 1}, kLineCell{1, 3}, kTriangleCell{2, 5}, kTetCell{4, 10},
    kHexCell{5, 12}, kPrismCell{6, 13}, kPyramidCell{7, 14};

struct Cell {
  CellType type;
  std::vector<int> nodes;  // positions
};

struct CellMesh {
  std::vector<geometry::Vec3> positions;  // in the file's unit
  std::vector<Cell> cells;
  // what the file calls its first node and cell, and the step between them; Gmsh alone takes any step
  int first_node = 1, node_step = 1, first_cell = 1;

  int node_number(std::size_t position) const { return first_node + node_step * static_cast<int>(position); }
};

inline CellMesh cells_of(const geometry::RawMesh& raw) {
  CellMesh mesh;
  mesh.positions = raw.positions;
  for (const auto& t : raw.tetrahedra) mesh.cells.push_back({kTetCell, {t.begin(), t.end()}});
  return mesh;
}

/// A box of 2 x 2 x 2 cubes of tetrahedra, 40 mm wide, under a capsule of eight prisms, 5 mm high, that share
/// its upper nodes; and a skin of two triangles, a line and a point, which fill nothing.
inline CellMesh box_under_capsule() {
  CellMesh mesh = cells_of(make_raw_box(2, 2, 2, {0.04, 0.04, 0.04}));
  const auto at = [](int i, int j, int k) { return i + 3 * (j + 3 * k); };
  for (int n = 0; n < 9; ++n) mesh.positions.push_back(mesh.positions[18 + n] + geometry::Vec3(0, 0, 0.005));
  mesh.cells.insert(mesh.cells.begin(), {kTriangleCell, {0, 1, 3}});
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int a = at(i, j, 2), b = a + 1, c = a + 3, d = a + 4;
      mesh.cells.push_back({kPrismCell, {a, b, d, a + 9, b + 9, d + 9}});
      mesh.cells.push_back({kPrismCell, {a, d, c, a + 9, d + 9, c + 9}});
    }
  }
  mesh.cells.push_back({kTriangleCell, {1, 4, 3}});
  mesh.cells.push_back({kLineCell, {0, 1}});
  mesh.cells.push_back({kPointCell, {0}});
  return mesh;
}

inline std::string joined(const CellMesh& mesh, const std::vector<int>& nodes, bool numbers) {
  std::string text;
  for (const int n : nodes)
    text += " " + std::to_string(numbers ? mesh.node_number(static_cast<std::size_t>(n)) : n);
  return text;
}

inline std::string place(const geometry::Vec3& p) {
  std::ostringstream out;
  out.precision(17);
  out << ' ' << p.transpose();
  return out.str();
}

inline std::string gmsh_nodes(const CellMesh& mesh) {
  std::string text = std::to_string(mesh.positions.size()) + "\n";
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    text += std::to_string(mesh.node_number(n)) + place(mesh.positions[n]) + "\n";
  return text;
}

inline std::string gmsh_1(const CellMesh& mesh) {
  std::string text =
      "$NOD\n" + gmsh_nodes(mesh) + "$ENDNOD\n$ELM\n" + std::to_string(mesh.cells.size()) + "\n";
  int number = mesh.first_cell;
  for (const Cell& cell : mesh.cells) {
    text += std::to_string(number++) + " " + std::to_string(cell.type.gmsh) + " 1 1 " +
            std::to_string(cell.nodes.size()) + joined(mesh, cell.nodes, true) + "\n";
  }
  return text + "$ENDELM\n";
}

/// `partition_tags`: four tags, as Gmsh writes for a partitioned mesh.
inline std::string gmsh_2(const CellMesh& mesh, bool partition_tags = false) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + gmsh_nodes(mesh) +
                     "$EndNodes\n$Elements\n" + std::to_string(mesh.cells.size()) + "\n";
  int number = mesh.first_cell;
  for (const Cell& cell : mesh.cells) {
    const int partition = number % 2 + 1;
    text += std::to_string(number++) + " " + std::to_string(cell.type.gmsh) +
            (partition_tags ? " 4 1 1 1 " + std::to_string(partition) : " 2 1 1") +
            joined(mesh, cell.nodes, true) + "\n";
  }
  return text + "$EndElements\n";
}

/// Version 4.1, each cell in a block of its own, the nodes in two.
inline std::string gmsh_4(const CellMesh& mesh) {
  const std::size_t count = mesh.positions.size(), half = count / 2;
  const auto words = [](auto... values) { return ((std::to_string(values) + " ") + ...) + "\n"; };
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n" +
                     words(2, count, mesh.node_number(0), mesh.node_number(count - 1));
  for (const bool second : {false, true}) {
    const std::size_t begin = second ? half : 0, end = second ? count : half;
    text += words(3, 1 + static_cast<int>(second), 0, end - begin);
    for (std::size_t n = begin; n < end; ++n) text += words(mesh.node_number(n));
    for (std::size_t n = begin; n < end; ++n) text += place(mesh.positions[n]) + "\n";
  }
  const int last = mesh.first_cell + static_cast<int>(mesh.cells.size()) - 1;
  text += "$EndNodes\n$Elements\n" + words(mesh.cells.size(), mesh.cells.size(), mesh.first_cell, last);
  int number = mesh.first_cell;
  for (const Cell& cell : mesh.cells)
    text += words(3, 1, cell.type.gmsh, 1) + std::to_string(number++) + joined(mesh, cell.nodes, true) + "\n";
  return text + "$EndElements\n";
}

inline std::string vtk_legacy(const CellMesh& mesh) {
  std::string text = "# vtk DataFile Version 3.0\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
                     std::to_string(mesh.positions.size()) + " double\n";
  for (const auto& p : mesh.positions) text += place(p) + "\n";
  std::size_t length = 0;
  for (const Cell& cell : mesh.cells) length += cell.nodes.size() + 1;
  text += "CELLS " + std::to_string(mesh.cells.size()) + " " + std::to_string(length) + "\n";
  for (const Cell& cell : mesh.cells)
    text += std::to_string(cell.nodes.size()) + joined(mesh, cell.nodes, false) + "\n";
  text += "CELL_TYPES " + std::to_string(mesh.cells.size()) + "\n";
  for (const Cell& cell : mesh.cells) text += std::to_string(cell.type.vtk) + "\n";
  return text;
}

inline std::string vtu_piece(const CellMesh& mesh) {
  const auto array = [](const std::string& attributes, const std::string& values) {
    return "<DataArray format=\"ascii\" " + attributes + ">" + values + "</DataArray>";
  };
  std::string points, nodes, ends, types;
  for (const auto& p : mesh.positions) points += place(p) + "\n";
  std::size_t end = 0;
  for (const Cell& cell : mesh.cells) {
    nodes += joined(mesh, cell.nodes, false);
    ends += " " + std::to_string(end += cell.nodes.size());
    types += " " + std::to_string(cell.type.vtk);
  }
  return "<Piece NumberOfPoints=\"" + std::to_string(mesh.positions.size()) + "\" NumberOfCells=\"" +
         std::to_string(mesh.cells.size()) + "\"><Points>" + array("type=\"Float64\"", points) +
         "</Points><Cells>" + array("type=\"Int64\" Name=\"connectivity\"", nodes) +
         array("type=\"Int64\" Name=\"offsets\"", ends) + array("type=\"UInt8\" Name=\"types\"", types) +
         "</Cells></Piece>";
}

inline std::string vtu(const std::vector<CellMesh>& pieces) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>";
  for (const CellMesh& piece : pieces) text += vtu_piece(piece);
  return text + "</UnstructuredGrid></VTKFile>\n";
}

inline std::string tetgen_nodes(const CellMesh& mesh) {
  std::string text = std::to_string(mesh.positions.size()) + " 3 0 0\n";
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    text += std::to_string(mesh.node_number(n)) + place(mesh.positions[n]) + "\n";
  return text;
}

inline std::string tetgen_elements(const CellMesh& mesh) {
  std::string text = std::to_string(mesh.cells.size()) + " 4 0\n";
  int number = mesh.first_cell;
  for (const Cell& cell : mesh.cells)
    text += std::to_string(number++) + joined(mesh, cell.nodes, true) + "\n";
  return text;
}

}  // namespace omentum::test
