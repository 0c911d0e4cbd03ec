#include "geometry/mesh_formats.h"

#include <cstdio>
#include <fstream>

namespace omentum::geometry {

RawMesh read_mesh(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  RawMesh mesh;
  if (extension == ".msh") {
    mesh = read_gmsh(file);
  } else if (extension == ".vtk") {
    mesh = read_vtk_legacy(file);
  } else if (extension == ".vtu") {
    mesh = read_vtu(file);
  } else if (extension == ".node" || extension == ".ele") {
    mesh = read_tetgen(file);
  } else {
    throw InputError(file.string() + ": found the extension '" + extension +
                     "', expected .msh, .vtk, .vtu, .node or .ele");
  }
  if (mesh.tetrahedra.empty()) {
    const std::string others = describe_elements(mesh.others);
    throw InputError(mesh.source + ": found no tetrahedra" + (others.empty() ? "" : ", but " + others) +
                     "; expected a mesh of tetrahedra");
  }
  return mesh;
}

void write_mesh(const TetraMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out(file);
  std::array<char, 128> line;
  const auto print = [&](const char* format, auto... values) {
    out.write(line.data(), std::snprintf(line.data(), line.size(), format, values...));
  };
  print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%zu\n", mesh.positions.size());
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& p = mesh.positions[n];
    print("%zu %.17g %.17g %.17g\n", n + 1, p.x(), p.y(), p.z());
  }
  print("$EndNodes\n$Elements\n%zu\n", mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const Tetrahedron& v = mesh.tetrahedra[t];
    print("%zu 4 2 1 1 %d %d %d %d\n", t + 1, v[0] + 1, v[1] + 1, v[2] + 1, v[3] + 1);
  }
  print("$EndElements\n%s", "");
  out.close();
  if (!out) throw InputError(file.string() + ": cannot be written");
}

}  // namespace omentum::geometry
