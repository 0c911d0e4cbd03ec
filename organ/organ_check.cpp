#include "organ/organ_check.h"

#include "geometry/tetra_faces.h"
#include "organ/organ_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::kMostNodes;
using geometry::NodeId;
using geometry::Tetrahedron;
using geometry::Triangle;

class Checker {
 public:
  Checker(const Organ& organ, const std::filesystem::path& file)
      : mesh_(organ.mesh),
        surface_(organ.surface),
        regions_(organ.material.regions),
        fixed_(organ.fixed),
        file_(file) {}

  void run() const {
    check_sizes();
    check_mesh();
    check_merged();
    check_regions();
    check_surface_nodes();
    check_triangles();
    check_closed();
    check_fans();
  }

 private:
  void check_sizes() const;
  void check_mesh() const;
  void check_merged() const;
  void check_regions() const;
  void check_surface_nodes() const;
  void check_triangles() const;
  void check_closed() const;
  void check_fans() const;

  void require(bool right, const char* dataset, std::size_t row, const char* what) const {
    if (right) return;
    throw InputError(file_.string() + ": is damaged: row " + std::to_string(row) + " of '" + dataset + "' " +
                     what);
  }
  void require_count(std::size_t found, std::size_t expected, const char* dataset) const {
    if (found == expected) return;
    throw InputError(file_.string() + ": is damaged: '" + dataset + "' has " + std::to_string(found) +
                     " rows; expected " + std::to_string(expected));
  }
  bool is_outward_face(const Triangle& triangle, const Tetrahedron& behind) const;

  const geometry::TetraMesh& mesh_;
  const geometry::Surface& surface_;
  const std::vector<physics::RegionMaterial>& regions_;
  const FixedComponents& fixed_;
  const std::filesystem::path& file_;
};

bool in_range(std::int32_t index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

void Checker::check_sizes() const {
  const std::size_t nodes = mesh_.positions.size(), triangles = surface_.triangles.size();
  require(nodes >= 4 && nodes <= kMostNodes, layout::kPositions, nodes,
          "is the last; expected 4 to 2^31 / 3");
  require(!mesh_.tetrahedra.empty() && mesh_.tetrahedra.size() <= kMostNodes, layout::kTetrahedra,
          mesh_.tetrahedra.size(), "is the last; expected 1 to 2^31 / 3");
  require(triangles >= 4 && triangles <= kMostNodes, layout::kTriangles, triangles,
          "is the last; expected 4 to 2^31 / 3");
  require_count(mesh_.file_node.size(), nodes, layout::kFileNode);
  require_count(mesh_.node_numbers.size(), static_cast<std::size_t>(mesh_.file_node_count),
                layout::kNodeNumbers);
  require_count(mesh_.tetrahedron_numbers.size(), mesh_.tetrahedra.size(), layout::kTetrahedronNumbers);
  require_count(fixed_.size(), nodes, layout::kFixed);
  require_count(surface_.tetrahedron.size(), triangles, layout::kBehind);
  require_count(surface_.fan_start.size(), surface_.node.size() + 1, layout::kFanStart);
  require_count(surface_.fan.size(), 3 * triangles, layout::kFan);
}

void Checker::check_mesh() const {
  const std::size_t nodes = mesh_.positions.size();
  for (std::size_t n = 0; n < nodes; ++n) {
    require(mesh_.positions[n].allFinite(), layout::kPositions, n, "is not finite");
    require(fixed_[n] <= physics::kPinned, layout::kFixed, n, "holds more than three components");
    require(in_range(mesh_.file_node[n], static_cast<std::size_t>(mesh_.file_node_count)) &&
                (n == 0 || mesh_.file_node[n] > mesh_.file_node[n - 1]),
            layout::kFileNode, n, "is no number of the mesh file, or not above the one before");
  }
  const auto at = [this](NodeId n) -> const geometry::Vec3& { return mesh_.positions[n]; };
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    const Tetrahedron& v = mesh_.tetrahedra[t];
    require(std::ranges::all_of(v, [&](NodeId n) { return in_range(n, nodes); }), layout::kTetrahedra, t,
            "names a node that is not there");
    require(geometry::signed_volume(at(v[0]), at(v[1]), at(v[2]), at(v[3])) > 0, layout::kTetrahedra, t,
            "has no positive volume");
  }
}

// What took a node's place is a node of the mesh; what was dropped is none.
void Checker::check_merged() const {
  const auto used = [this](std::int32_t node) { return std::ranges::binary_search(mesh_.file_node, node); };
  const auto count = static_cast<std::size_t>(mesh_.file_node_count);
  for (std::size_t i = 0; i < mesh_.merged.size(); ++i) {
    const auto& [dropped, kept] = mesh_.merged[i];
    require(in_range(dropped, count) && !used(dropped) && used(kept) &&
                (i == 0 || dropped > mesh_.merged[i - 1].dropped),
            layout::kMerged, i, "names a node that is not there, or in use, or not above the one before");
  }
}

// Labels where there are materials of regions, and only there; each region has a tetrahedron.
void Checker::check_regions() const {
  require_count(mesh_.regions.size(), regions_.empty() ? 0 : mesh_.tetrahedra.size(), layout::kRegions);
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    require(std::ranges::find(mesh_.regions, regions_[i].label) != mesh_.regions.end() &&
                (i == 0 || regions_[i].label > regions_[i - 1].label),
            layout::kRegionLabels, i, "is the label of no tetrahedron, or not above the one before");
  }
}

// Each mesh node at most once; those that move first.
void Checker::check_surface_nodes() const {
  const std::size_t nodes = mesh_.positions.size();
  std::vector<bool> seen(nodes);
  if (surface_.mobile_count > surface_.node_count()) {
    throw InputError(file_.string() + ": is damaged: '" + layout::kMobile +
                     "' is more than the surface's nodes");
  }
  for (std::size_t s = 0; s < surface_.node.size(); ++s) {
    const NodeId n = surface_.node[s];
    require(in_range(n, nodes) && !seen[n], layout::kSurfaceNode, s,
            "names a node that is not there, or twice");
    seen[n] = true;
    const bool mobile = s < static_cast<std::size_t>(surface_.mobile_count);
    require(mobile == (fixed_[n] != physics::kPinned), layout::kSurfaceNode, s,
            "is on the wrong side of those that are held");
  }
}

// Whether the triangle is one of the four faces, seen from outside.
bool Checker::is_outward_face(const Triangle& triangle, const Tetrahedron& behind) const {
  const std::array<NodeId, 3> nodes = {surface_.node[triangle[0]], surface_.node[triangle[1]],
                                       surface_.node[triangle[2]]};
  return std::ranges::any_of(geometry::kFaceOpposite, [&](const std::array<int, 3>& face) {
    for (int turn = 0; turn < 3; ++turn) {
      if (nodes[0] == behind[face[turn]] && nodes[1] == behind[face[(turn + 1) % 3]] &&
          nodes[2] == behind[face[(turn + 2) % 3]]) {
        return true;
      }
    }
    return false;
  });
}

void Checker::check_triangles() const {
  for (std::size_t f = 0; f < surface_.triangles.size(); ++f) {
    const Triangle& triangle = surface_.triangles[f];
    require(std::ranges::all_of(triangle, [&](SurfaceId s) { return in_range(s, surface_.node.size()); }),
            layout::kTriangles, f, "names a node that is not there");
    require(in_range(surface_.tetrahedron[f], mesh_.tetrahedra.size()), layout::kBehind, f,
            "names a tetrahedron that is not there");
    require(is_outward_face(triangle, mesh_.tetrahedra[surface_.tetrahedron[f]]), layout::kTriangles, f,
            "is no face of the tetrahedron behind it");
  }
}

// Every edge is passed once in each direction: what walks over the surface finds a neighbour everywhere.
void Checker::check_closed() const {
  using Edge = std::array<std::int32_t, 2>;
  std::vector<Edge> forth, back;
  for (const Triangle& t : surface_.triangles) {
    for (int i = 0; i < 3; ++i) {
      forth.push_back({t[i], t[(i + 1) % 3]});
      back.push_back({t[(i + 1) % 3], t[i]});
    }
  }
  std::ranges::sort(forth);
  std::ranges::sort(back);
  if (forth != back || std::ranges::adjacent_find(forth) != forth.end()) {
    throw InputError(file_.string() + ": is damaged: its surface '" + layout::kTriangles +
                     "' does not close");
  }
}

void Checker::check_fans() const {
  const std::vector<std::int32_t>& start = surface_.fan_start;
  require(start.front() == 0, layout::kFanStart, 0, "is not 0");
  for (std::size_t s = 0; s < surface_.node.size(); ++s) {
    require(start[s] < start[s + 1] && static_cast<std::size_t>(start[s + 1]) <= surface_.fan.size(),
            layout::kFanStart, s + 1, "is not above the one before, or beyond the fans");
    for (std::int32_t i = start[s]; i < start[s + 1]; ++i) {
      const geometry::TriangleId f = surface_.fan[i];
      require(in_range(f, surface_.triangles.size()) &&
                  std::ranges::count(surface_.triangles[f], SurfaceId(s)) == 1 &&
                  (i == start[s] || f > surface_.fan[i - 1]),
              layout::kFan, i, "is no triangle at its node, or not above the one before");
    }
  }
  require_count(static_cast<std::size_t>(start.back()), surface_.fan.size(), layout::kFan);
}

}  // namespace

namespace {

void require_material(const physics::Material& m, const std::string& where) {
  const auto refuse = [&](const std::string& what, double found, const std::string& expected) {
    throw InputError(where + what + " is " + std::to_string(found) + "; expected " + expected);
  };
  if (!(m.young_pa > 0) || !std::isfinite(m.young_pa))
    refuse("Young's modulus", m.young_pa, "a positive number (Pa)");
  if (!(m.poisson > -1 && m.poisson < 0.5))
    refuse("Poisson's ratio", m.poisson, "more than -1 and less than 0.5");
  if (!(m.density_kg_m3 > 0) || !std::isfinite(m.density_kg_m3)) {
    refuse("density", m.density_kg_m3, "a positive number (kg/m^3)");
  }
}

}  // namespace

void require_materials(const physics::MaterialMap& material, const std::string& where) {
  require_material(material.common, where);
  for (const physics::RegionMaterial& region : material.regions)
    require_material(region.material, where + "region " + std::to_string(region.label) + ": ");
}

void require_consistent(const Organ& organ, const std::filesystem::path& file) {
  require_materials(organ.material, file.string() + ": ");
  Checker(organ, file).run();
}

}  // namespace omentum::organ
