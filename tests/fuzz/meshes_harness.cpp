// A mesh file of any format: by its contents, as Gmsh, VTK or STL; as TetGen's pair where a form feed parts
// it.
#include "geometry/mesh_io/stl.h"
#include "geometry/surface.h"
#include "geometry/tetra_mesh.h"

#include "tests/fuzz/input_file.h"
#include "tests/geometry/written_meshes.h"
#include "tests/support/process.h"

#include <fstream>

namespace omentum::fuzz {

namespace {

using geometry::TetraMesh;

// What programs do next believes these.
void check_indices(const TetraMesh& mesh) {
  for (const auto& tetrahedron : mesh.tetrahedra) {
    for (const auto node : tetrahedron) {
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.positions.size())
        broken("a node is out of range");
    }
  }
  if (mesh.file_node.size() != mesh.positions.size()) broken("nodes have lost their numbers");
}

void read(const std::filesystem::path& file) {
  try {
    check_indices(geometry::check_mesh(geometry::read_mesh(file), 1, {.repair = true}).mesh);
  } catch (const geometry::InputError& refusal) {
    check_refusal(refusal.what(), file.stem());
  }
}

void read_stl(const std::filesystem::path& file) {
  try {
    const geometry::TriangleSurface surface = geometry::read_stl(file);
    for (const auto& triangle : surface.triangles) {
      for (const auto node : triangle) {
        if (node < 0 || static_cast<std::size_t>(node) >= surface.positions.size())
          broken("a corner is out of range");
      }
    }
  } catch (const geometry::InputError& refusal) {
    check_refusal(refusal.what(), file);
  }
}

void read_tetgen(std::string_view nodes, std::string_view elements) {
  static const test::ScratchFolder folder;
  std::ofstream(folder / "input.node", std::ios::binary) << nodes;
  std::ofstream(folder / "input.ele", std::ios::binary) << elements;
  read(folder / "input.node");
}

}  // namespace

void try_input(std::span<const std::uint8_t> input) {
  const std::string_view text = text_of(input);
  if (const std::size_t part = text.find('\f'); part != std::string_view::npos)
    return read_tetgen(text.substr(0, part), text.substr(part + 1));
  const InputFile file(text);
  if (geometry::is_stl(file.path())) read_stl(file.path());
  read(file.path());
}

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const geometry::Format& format : geometry::formats())
    inputs.push_back(format.write(geometry::labelled_mesh()));
  inputs.emplace_back(
      "4 3 0 1\n1 0 0 0 2\n2 1 0 0 2\n3 0 1 0 2\n4 0 0 1 2\n\f"
      "1 4 1\n1 1 2 3 4 7\n");
  inputs.emplace_back(
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid s\n");
  return inputs;
}

}  // namespace omentum::fuzz
