#include "geometry/mesh_io/file_kind.h"
#include "geometry/mesh_io/mesh_formats.h"
#include "geometry/region_labels.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace omentum::geometry {

namespace {

std::string small(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// What the contents say goes before what the name says; a name alone says what was meant.
MeshKind kind_of(const std::filesystem::path& file) {
  if (const auto found = mesh_kind(file_head(file))) return *found;
  if (const std::string found = foreign_kind(file); !found.empty())
    throw InputError(file.string() + ": found " + found + ", expected a mesh of Gmsh or VTK");
  const std::string extension = small(file.extension().string());
  if (extension == ".msh") return MeshKind::kGmsh;
  if (extension == ".vtk") return MeshKind::kVtkLegacy;
  if (extension == ".vtu") return MeshKind::kVtkXml;
  if (!std::filesystem::exists(file))
    throw InputError(file.string() + ": no such file; expected a mesh file");
  const std::string found =
      extension.empty() ? "no extension" : "the extension '" + file.extension().string() + "'";
  throw InputError(file.string() + ": found " + found +
                   " and contents of no known kind, expected .msh, .vtk, .vtu, .node or .ele");
}

RawMesh read_by_kind(const std::filesystem::path& file) {
  const std::string extension = small(file.extension().string());
  if (extension == ".node" || extension == ".ele") return read_tetgen(file);
  switch (kind_of(file)) {
    case MeshKind::kGmsh:
      return read_gmsh(file);
    case MeshKind::kVtkLegacy:
      return read_vtk_legacy(file);
    case MeshKind::kVtkXml:
      return read_vtu(file);
  }
  throw InputError(file.string() + ": is no mesh");  // not reached
}

}  // namespace

RawMesh read_mesh(const std::filesystem::path& file) {
  RawMesh mesh = read_by_kind(file);
  settle_labels(mesh);
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
    const std::int32_t region = mesh.regions.empty() ? 1 : mesh.regions[t];
    print("%zu 4 2 %d %d %d %d %d %d\n", t + 1, region, std::max(region, 1), v[0] + 1, v[1] + 1, v[2] + 1,
          v[3] + 1);
  }
  print("$EndElements\n%s", "");
  out.close();
  if (!out) throw InputError(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace omentum::geometry
