#include "geometry/mesh_topology.h"

#include "geometry/self_intersection.h"
#include "geometry/tetra_faces.h"

#include <Eigen/Geometry>
#include <Eigen/StdVector>
#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace omentum::geometry {
namespace {

// Angle sums around an edge come in steps of 2 pi where they are wrong; rounding is far below this, rad.
constexpr double kAngleTolerance = 1e-3;

// Sets that only ever merge, with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) {
    parent_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) parent_.push_back(i);
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::size_t> parent_;
};

// Calls visit(run) for each run of consecutive elements that agree in `key`.
template <class T, class Key, class Visit>
void for_each_run(const std::vector<T>& sorted, Key&& key, Visit&& visit) {
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && key(sorted[last]) == key(sorted[first])) ++last;
    visit(std::span<const T>(sorted).subspan(first, last - first));
  }
}

template <class Visit>
void for_each_face(const std::vector<FaceSide>& sides, Visit&& visit) {
  for_each_run(
      sides, [](const FaceSide& s) { return s.nodes; }, visit);
}

// Sides without another side.
std::vector<FaceSide> boundary_faces(const std::vector<FaceSide>& sides) {
  std::vector<FaceSide> faces;
  for_each_face(sides, [&](std::span<const FaceSide> face) {
    if (face.size() == 1) faces.push_back(face[0]);
  });
  return faces;
}

struct EdgeUse {
  std::array<std::int32_t, 2> nodes;
  std::size_t face;
};

// The edges of the faces, those of one edge next to each other.
std::vector<EdgeUse> boundary_edges(const std::vector<FaceSide>& faces) {
  std::vector<EdgeUse> uses;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f].nodes;
    uses.insert(uses.end(), {{{a, b}, f}, {{a, c}, f}, {{b, c}, f}});
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.nodes < b.nodes; });
  return uses;
}

// Nodes whose corners are not all in one set.
template <class NodeOf>
Offenders nodes_of_several_sets(DisjointSets& corners, std::size_t corner_count, std::size_t node_count,
                                NodeOf&& node_of) {
  constexpr auto kUnseen = static_cast<std::size_t>(-1);
  std::vector<std::size_t> set_of(node_count, kUnseen);
  Offenders several;
  for (std::size_t c = 0; c < corner_count; ++c) {
    const auto node = static_cast<std::size_t>(node_of(c));
    if (set_of[node] == kUnseen) set_of[node] = corners.find(c);
    if (set_of[node] != corners.find(c)) several.push_back(node);
  }
  return several;
}

// Dihedral angle between the two faces that hold the edge i-j, rad.
double dihedral_angle(const std::array<Vec3, 4>& p, int i, int j, int k, int l) {
  const Vec3 along = (p[j] - p[i]).normalized();
  const Vec3 to_k = p[k] - p[i];
  const Vec3 to_l = p[l] - p[i];
  const Vec3 u = to_k - along * along.dot(to_k);
  const Vec3 w = to_l - along * along.dot(to_l);
  return std::atan2(u.cross(w).norm(), u.dot(w));
}

// Finds a tetrahedron with a point inside, other than one; for Eigen's tree of bounding boxes.
class PointInTetrahedron {
 public:
  PointInTetrahedron(std::span<const Vec3> positions, RawTetrahedra tetrahedra, const Vec3& point,
                     std::size_t besides)
      : positions_(positions), tetrahedra_(tetrahedra), point_(point), besides_(besides) {}

  // NOLINTBEGIN(readability-identifier-naming): what Eigen's tree calls
  bool intersectVolume(const Eigen::AlignedBox3d& box) const { return box.contains(point_); }
  bool intersectObject(std::size_t t) {
    found_ = found_ || (t != besides_ && holds(t));
    return found_;
  }
  // NOLINTEND(readability-identifier-naming)
  bool found() const { return found_; }

 private:
  bool holds(std::size_t t) const {
    const auto at = [&](int v) -> const Vec3& { return positions_[tetrahedra_[t][v]]; };
    for (const auto& [a, b, c] : kFaceOpposite) {
      const Vec3 outward = (at(b) - at(a)).cross(at(c) - at(a));
      if (outward.dot(point_ - at(a)) >= 0) return false;
    }
    return true;
  }

  std::span<const Vec3> positions_;
  RawTetrahedra tetrahedra_;
  Vec3 point_;
  std::size_t besides_;
  bool found_ = false;
};

}  // namespace

std::vector<FaceSide> collect_face_sides(RawTetrahedra tetrahedra) {
  std::vector<FaceSide> sides;
  sides.reserve(4 * tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (const auto& [a, b, c] : kFaceOpposite) {
      FaceSide side{{tetrahedra[t][a], tetrahedra[t][b], tetrahedra[t][c]}, t, true};
      const auto order = [&side](int j, int k) {
        if (side.nodes[j] < side.nodes[k]) return;
        std::swap(side.nodes[j], side.nodes[k]);
        side.even = !side.even;
      };
      order(0, 1), order(1, 2), order(0, 1);
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.nodes, a.tetrahedron) < std::tie(b.nodes, b.tetrahedron);
  });
  return sides;
}

FaceFaults find_face_faults(const std::vector<FaceSide>& sides, std::size_t tetrahedron_count) {
  FaceFaults faults;
  std::vector<int> shared(tetrahedron_count, 0), folded(tetrahedron_count, 0);
  std::vector<std::array<std::size_t, 2>> folded_pairs;
  for_each_face(sides, [&](std::span<const FaceSide> face) {
    if (face.size() > 2) {
      for (const FaceSide& side : face) faults.crowded.push_back(side.tetrahedron);
    } else if (face.size() == 2) {
      const bool same_side = face[0].even == face[1].even;
      if (same_side) folded_pairs.push_back({face[0].tetrahedron, face[1].tetrahedron});
      for (const FaceSide& side : face) {
        ++shared[side.tetrahedron];
        folded[side.tetrahedron] += same_side;
      }
    }
  });
  const auto inside_out = [&](std::size_t t) { return folded[t] > 1 && 2 * folded[t] > shared[t]; };
  for (const auto& [a, b] : folded_pairs) {
    for (const std::size_t t : {a, b}) {
      if (inside_out(t)) faults.inside_out.push_back(t);
    }
    if (!inside_out(a) && !inside_out(b)) faults.folded.insert(faults.folded.end(), {a, b});
  }
  return faults;
}

Offenders separate_parts(const std::vector<FaceSide>& sides, std::size_t tetrahedron_count) {
  DisjointSets parts(tetrahedron_count);
  for_each_face(sides, [&](std::span<const FaceSide> face) {
    for (const FaceSide& side : face) parts.merge(face[0].tetrahedron, side.tetrahedron);
  });
  Offenders one_of_each;
  for (std::size_t t = 0; t < tetrahedron_count; ++t) {
    if (parts.find(t) == t) one_of_each.push_back(t);
  }
  return one_of_each;
}

Offenders touching_along_edges(const std::vector<FaceSide>& sides) {
  const std::vector<FaceSide> faces = boundary_faces(sides);
  Offenders which;
  for_each_run(
      boundary_edges(faces), [](const EdgeUse& e) { return e.nodes; },
      [&](std::span<const EdgeUse> edge) {
        if (edge.size() == 2) return;
        for (const EdgeUse& use : edge) which.push_back(faces[use.face].tetrahedron);
      });
  return which;
}

Offenders pinched_nodes(const std::vector<FaceSide>& sides, RawTetrahedra tetrahedra,
                        std::size_t node_count) {
  DisjointSets corners(4 * tetrahedra.size());
  const auto corner_of = [&](std::size_t t, std::int32_t node) {
    const auto& v = tetrahedra[t];
    return 4 * t + static_cast<std::size_t>(std::find(v.begin(), v.end(), node) - v.begin());
  };
  for_each_face(sides, [&](std::span<const FaceSide> face) {
    for (std::size_t i = 1; i < face.size(); ++i) {
      for (const std::int32_t node : face[0].nodes) {
        corners.merge(corner_of(face[0].tetrahedron, node), corner_of(face[i].tetrahedron, node));
      }
    }
  });
  return nodes_of_several_sets(corners, 4 * tetrahedra.size(), node_count,
                               [&](std::size_t corner) { return tetrahedra[corner / 4][corner % 4]; });
}

Offenders pinched_boundary_nodes(const std::vector<FaceSide>& sides, std::size_t node_count) {
  const std::vector<FaceSide> faces = boundary_faces(sides);
  DisjointSets corners(3 * faces.size());
  const auto corner_of = [&](std::size_t f, std::int32_t node) {
    const auto& v = faces[f].nodes;
    return 3 * f + static_cast<std::size_t>(std::find(v.begin(), v.end(), node) - v.begin());
  };
  for_each_run(
      boundary_edges(faces), [](const EdgeUse& e) { return e.nodes; },
      [&](std::span<const EdgeUse> edge) {
        for (const EdgeUse& use : edge) {
          for (const std::int32_t node : use.nodes)
            corners.merge(corner_of(edge[0].face, node), corner_of(use.face, node));
        }
      });
  return nodes_of_several_sets(corners, 3 * faces.size(), node_count,
                               [&](std::size_t corner) { return faces[corner / 3].nodes[corner % 3]; });
}

Offenders winding_around_edges(std::span<const Vec3> positions, RawTetrahedra tetrahedra) {
  struct EdgeAngle {
    std::array<std::int32_t, 2> nodes;
    double angle;
    std::size_t tetrahedron;
  };
  constexpr std::array<std::array<int, 4>, 6> kEdges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  std::vector<EdgeAngle> angles;
  angles.reserve(6 * tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const auto& v = tetrahedra[t];
    const auto at = [&](int i) { return positions[static_cast<std::size_t>(v[i])]; };
    const std::array<Vec3, 4> p = {at(0), at(1), at(2), at(3)};
    for (const auto& [i, j, k, l] : kEdges) {
      angles.push_back({{std::min(v[i], v[j]), std::max(v[i], v[j])}, dihedral_angle(p, i, j, k, l), t});
    }
  }
  std::sort(angles.begin(), angles.end(),
            [](const EdgeAngle& a, const EdgeAngle& b) { return a.nodes < b.nodes; });
  Offenders which;
  for_each_run(
      angles, [](const EdgeAngle& e) { return e.nodes; },
      [&](std::span<const EdgeAngle> edge) {
        double sum = 0;
        for (const EdgeAngle& e : edge) sum += e.angle;
        if (sum < 2 * std::numbers::pi + kAngleTolerance) return;
        for (const EdgeAngle& e : edge) which.push_back(e.tetrahedron);
      });
  return which;
}

Offenders crossing_at_boundary(std::span<const Vec3> positions, const std::vector<FaceSide>& sides) {
  const std::vector<FaceSide> faces = boundary_faces(sides);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const FaceSide& face : faces) triangles.push_back(face.nodes);
  Offenders which;
  for (const auto& [i, j] : crossing_triangles(positions, triangles)) {
    which.insert(which.end(), {faces[i].tetrahedron, faces[j].tetrahedron});
  }
  return which;
}

Offenders covered_at_boundary(std::span<const Vec3> positions, RawTetrahedra tetrahedra,
                              const std::vector<FaceSide>& sides) {
  std::vector<Eigen::AlignedBox3d> boxes(tetrahedra.size());
  std::vector<std::size_t> numbers(tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    numbers[t] = t;
    for (const std::int32_t node : tetrahedra[t]) boxes[t].extend(positions[node]);
  }
  const Eigen::KdBVH<double, 3, std::size_t> tree(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
  Offenders which;
  for (const FaceSide& face : boundary_faces(sides)) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t node : tetrahedra[face.tetrahedron]) centre += positions[node] / 4;
    PointInTetrahedron search(positions, tetrahedra, centre, face.tetrahedron);
    Eigen::BVIntersect(tree, search);
    if (search.found()) which.push_back(face.tetrahedron);
  }
  return which;
}

}  // namespace omentum::geometry
