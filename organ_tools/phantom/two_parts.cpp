#include "organ_tools/phantom/two_parts.h"

#include "geometry/mesh_editor.h"

#include <map>

namespace omentum::phantom {
namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::Vec3;
using Corners = std::array<std::int32_t, 4>;

// Middles of edges, each once, behind the nodes that there are.
class Middles {
 public:
  explicit Middles(std::vector<Vec3>& positions) : positions_(positions) {}

  std::int32_t of(std::int32_t a, std::int32_t b) {
    const auto [found, is_new] =
        number_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(positions_.size()));
    if (is_new)
      positions_.emplace_back(
          (positions_[static_cast<std::size_t>(a)] + positions_[static_cast<std::size_t>(b)]) / 2);
    return found->second;
  }

 private:
  std::vector<Vec3>& positions_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> number_;
};

// Four around the shortest of the three diagonals of the octahedron between the middles.
void add_octahedron(const std::array<std::array<std::int32_t, 4>, 4>& m, geometry::RawMesh& raw) {
  struct Diagonal {
    std::int32_t from, to;
    Corners ring;
  };
  const std::array<Diagonal, 3> diagonals{Diagonal{m[0][1], m[2][3], {m[0][2], m[0][3], m[1][3], m[1][2]}},
                                          Diagonal{m[0][2], m[1][3], {m[0][1], m[0][3], m[2][3], m[1][2]}},
                                          Diagonal{m[0][3], m[1][2], {m[0][1], m[0][2], m[2][3], m[1][3]}}};
  const auto place = [&](std::int32_t n) -> const Vec3& {
    return raw.positions[static_cast<std::size_t>(n)];
  };
  const Diagonal* shortest = diagonals.data();
  for (const Diagonal& d : diagonals)
    if ((place(d.from) - place(d.to)).norm() < (place(shortest->from) - place(shortest->to)).norm())
      shortest = &d;
  for (std::size_t i = 0; i < 4; ++i) {
    Corners t{shortest->from, shortest->to, shortest->ring[i], shortest->ring[(i + 1) % 4]};
    if (geometry::signed_volume(place(t[0]), place(t[1]), place(t[2]), place(t[3])) < 0)
      std::swap(t[2], t[3]);
    raw.tetrahedra.push_back(t);
  }
}

TetraMesh taken(const TetraMesh& mesh, const geometry::MeshEditor& editor, bool removed, const char* name) {
  geometry::RawMesh raw;
  raw.source = name;
  std::vector<std::int32_t> number(mesh.positions.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (editor.is_removed(TetId(t)) != removed) continue;
    Corners corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::int32_t& n = number[static_cast<std::size_t>(mesh.tetrahedra[t][i])];
      if (n < 0) {
        n = static_cast<std::int32_t>(raw.positions.size());
        raw.positions.push_back(mesh.positions[mesh.tetrahedra[t][i]]);
      }
      corners[i] = n;
    }
    raw.tetrahedra.push_back(corners);
  }
  return geometry::check_mesh(raw, 1.0).mesh;
}

}  // namespace

TetraMesh eight_times_finer(const TetraMesh& mesh) {
  geometry::RawMesh raw;
  raw.source = "refined";
  raw.positions = mesh.positions;
  Middles middles(raw.positions);
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    std::array<std::array<std::int32_t, 4>, 4> m{};
    for (std::size_t i = 0; i < 4; ++i) {
      m[i][i] = static_cast<std::int32_t>(t[i]);
      for (std::size_t j = i + 1; j < 4; ++j)
        m[i][j] = m[j][i] = middles.of(static_cast<std::int32_t>(t[i]), static_cast<std::int32_t>(t[j]));
    }
    for (const Corners& row : m) raw.tetrahedra.push_back(row);
    add_octahedron(m, raw);
  }
  return geometry::check_mesh(raw, 1.0).mesh;
}

TwoParts parted_at(const TetraMesh& mesh, double z_m) {
  std::vector<TetId> below;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    double height_m = 0;
    for (const NodeId n : mesh.tetrahedra[t]) height_m += mesh.positions[n].z() / 4;
    if (height_m < z_m) below.emplace_back(t);
  }
  geometry::MeshEditor editor(mesh);
  editor.remove(below);
  return {taken(mesh, editor, false, "upper part"), taken(mesh, editor, true, "lower part")};
}

}  // namespace omentum::phantom
