#include "geometry/self_intersection.h"
#include "geometry/tetra_faces.h"
#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace omentum::geometry {
namespace {

// A tetrahedron flatter than this fraction of its longest edge has no volume worth the name: its stiffness
// would exceed its neighbours' by the inverse of the same factor.
constexpr double kFlattestHeight = 1e-6;

// Angle sums around an edge come in steps of 2 pi where they are wrong; rounding is far below this, rad.
constexpr double kAngleTolerance = 1e-3;

// Offenders named in a message before it only counts.
constexpr std::size_t kNamed = 5;

using TetList = std::vector<std::size_t>;

// Sets that only ever merge, with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::size_t> parent_;
};

// One side of a face: its nodes in ascending order, where it lies, and whether that order is an even
// permutation of its outward one.
struct FaceSide {
  std::array<std::int32_t, 3> nodes;
  std::size_t tetrahedron;
  int opposite;
  bool even;
};

class Checker {
 public:
  Checker(const RawMesh& raw, double metres_per_unit) : raw_(raw) { scale_positions(metres_per_unit); }

  CheckedMesh run();

 private:
  void scale_positions(double metres_per_unit);
  void check_node_numbers() const;
  void check_finite() const;
  void orient();
  void check_repeated();
  void collect_faces();
  void check_face_sides();
  void check_connected();
  void check_boundary_edges();
  void check_vertex_stars();
  void check_edge_angles();
  void check_boundary_crossings();
  void drop_unused_nodes();

  template <class Visit>
  void for_each_face(Visit&& visit) const;
  const Vec3& position(std::int32_t node) const { return positions_[static_cast<std::size_t>(node)]; }
  void refuse(const char* thing, TetList which, const std::string& what);
  void warn(std::size_t count, const char* singular, const char* plural);
  [[noreturn]] void throw_reasons() const;
  void stop_if_refused() const {
    if (!reasons_.empty()) throw_reasons();
  }

  const RawMesh& raw_;
  std::vector<Vec3> positions_;                          // all nodes of the file, m
  std::vector<std::array<std::int32_t, 4>> tetrahedra_;  // positively oriented after orient()
  std::vector<FaceSide> faces_;                          // sorted by nodes
  std::vector<std::string> reasons_;
  CheckedMesh result_;
};

std::string numbered(const TetList& which) {
  std::string text;
  for (std::size_t i = 0; i < std::min(which.size(), kNamed); ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(which[i]);
  }
  if (which.size() > kNamed) text += ", ... (" + std::to_string(which.size()) + " in all)";
  return text;
}

void Checker::refuse(const char* thing, TetList which, const std::string& what) {
  if (which.empty()) return;
  std::sort(which.begin(), which.end());
  which.erase(std::unique(which.begin(), which.end()), which.end());
  reasons_.push_back(thing + numbered(which) + " " + what);
}

void Checker::warn(std::size_t count, const char* singular, const char* plural) {
  if (count == 0) return;
  result_.warnings.push_back(raw_.source + ": " + std::to_string(count) + " " +
                             (count == 1 ? singular : plural));
}

void Checker::throw_reasons() const {
  std::string message = raw_.source + ": not a valid mesh: ";
  for (std::size_t i = 0; i < reasons_.size(); ++i) message += (i == 0 ? "" : "; ") + reasons_[i];
  throw InputError(message);
}

void Checker::scale_positions(double metres_per_unit) {
  if (!(metres_per_unit > 0) || !std::isfinite(metres_per_unit)) {
    throw InputError(raw_.source + ": found the scale " + std::to_string(metres_per_unit) +
                     " metres per unit, expected a positive number");
  }
  positions_.reserve(raw_.positions.size());
  for (const Vec3& p : raw_.positions) positions_.push_back(metres_per_unit * p);
}

void Checker::check_node_numbers() const {
  const auto count = static_cast<std::int64_t>(positions_.size());
  for (std::size_t t = 0; t < raw_.tetrahedra.size(); ++t) {
    const auto& v = raw_.tetrahedra[t];
    for (int i = 0; i < 4; ++i) {
      if (v[i] < 0 || v[i] >= count) {
        throw InputError(raw_.source + ": tetrahedron " + std::to_string(t) + " names node " +
                         std::to_string(v[i]) + ", expected 0 to " + std::to_string(count - 1));
      }
    }
  }
  if (raw_.tetrahedra.empty()) throw InputError(raw_.source + ": found no tetrahedra, expected at least one");
}

void Checker::check_finite() const {
  for (std::size_t n = 0; n < positions_.size(); ++n) {
    if (!positions_[n].allFinite()) {
      throw InputError(raw_.source + ": the position of node " + std::to_string(n) + " is not finite");
    }
  }
}

// Height over the largest face, as a fraction of the longest edge.
double relative_height(const std::array<Vec3, 4>& p, double volume) {
  double longest = 0;
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, (p[j] - p[i]).norm());
    const auto [a, b, c] = kFaceOpposite[i];
    largest = std::max(largest, (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2);
  }
  return largest * longest > 0 ? 3 * std::abs(volume) / (largest * longest) : 0.0;
}

void Checker::orient() {
  tetrahedra_ = raw_.tetrahedra;
  TetList flat;
  std::size_t reordered = 0;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    auto& v = tetrahedra_[t];
    const std::array<Vec3, 4> p = {position(v[0]), position(v[1]), position(v[2]), position(v[3])};
    const double volume = signed_volume(p[0], p[1], p[2], p[3]);
    if (!(relative_height(p, volume) > kFlattestHeight)) {
      flat.push_back(t);
    } else if (volume < 0) {
      std::swap(v[2], v[3]);
      ++reordered;
    }
  }
  refuse("tetrahedra", flat, "have zero volume (height below 1e-6 of the longest edge)");
  warn(reordered, "tetrahedron was listed in negative order and is reordered",
       "tetrahedra were listed in negative order and are reordered");
}

void Checker::check_repeated() {
  std::vector<std::pair<std::array<std::int32_t, 4>, std::size_t>> sorted;
  sorted.reserve(tetrahedra_.size());
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    sorted.emplace_back(tetrahedra_[t], t);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  TetList repeated;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) repeated.push_back(sorted[i].second);
  }
  refuse("tetrahedra", repeated, "repeat the nodes of an earlier one");
}

void Checker::collect_faces() {
  faces_.reserve(4 * tetrahedra_.size());
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      const auto [a, b, c] = kFaceOpposite[i];
      FaceSide side{{tetrahedra_[t][a], tetrahedra_[t][b], tetrahedra_[t][c]}, t, i, true};
      const auto order = [&side](int j, int k) {
        if (side.nodes[j] < side.nodes[k]) return;
        std::swap(side.nodes[j], side.nodes[k]);
        side.even = !side.even;
      };
      order(0, 1), order(1, 2), order(0, 1);
      faces_.push_back(side);
    }
  }
  std::sort(faces_.begin(), faces_.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.nodes, a.tetrahedron) < std::tie(b.nodes, b.tetrahedron);
  });
}

// Calls visit(first, last) for the sides of each face.
template <class Visit>
void Checker::for_each_face(Visit&& visit) const {
  for (auto first = faces_.begin(); first != faces_.end();) {
    const auto last =
        std::find_if(first, faces_.end(), [&](const FaceSide& s) { return s.nodes != first->nodes; });
    visit(first, last);
    first = last;
  }
}

void Checker::check_face_sides() {
  TetList crowded;
  TetList folded;
  for_each_face([&](auto first, auto last) {
    if (last - first > 2) {
      for (auto side = first; side != last; ++side) crowded.push_back(side->tetrahedron);
    } else if (last - first == 2 && first->even == first[1].even) {
      folded.push_back(first->tetrahedron);
      folded.push_back(first[1].tetrahedron);
    }
  });
  refuse("tetrahedra", crowded, "share a face with more than one other (non-manifold)");
  refuse("tetrahedra", folded, "lie on the same side of a shared face (overlapping)");
}

void Checker::check_connected() {
  DisjointSets sets(tetrahedra_.size());
  for_each_face([&](auto first, auto last) {
    for (auto side = first + 1; side != last; ++side) sets.merge(first->tetrahedron, side->tetrahedron);
  });
  TetList one_of_each;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    if (sets.find(t) == t) one_of_each.push_back(t);
  }
  if (one_of_each.size() > 1) {
    refuse("tetrahedra", one_of_each,
           "lie in different parts (" + std::to_string(one_of_each.size()) +
               " parts not connected through faces)");
  }
}

void Checker::check_boundary_edges() {
  struct EdgeUse {
    std::int32_t low, high;
    std::size_t tetrahedron;
  };
  std::vector<EdgeUse> uses;
  for_each_face([&](auto first, auto last) {
    if (last - first != 1) return;
    const auto& n = first->nodes;
    for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 2}})
      uses.push_back({n[i], n[j], first->tetrahedron});
  });
  const auto key = [](const EdgeUse& e) { return std::pair(e.low, e.high); };
  std::sort(uses.begin(), uses.end(), [&](const EdgeUse& a, const EdgeUse& b) { return key(a) < key(b); });
  TetList which;
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && key(uses[last]) == key(uses[first])) ++last;
    if (last - first == 2) continue;
    for (std::size_t i = first; i < last; ++i) which.push_back(uses[i].tetrahedron);
  }
  refuse("tetrahedra", which, "touch along an edge only (non-manifold boundary)");
}

// Around each node the tetrahedra must be connected through faces that hold it: else two regions touch in a
// point.
void Checker::check_vertex_stars() {
  DisjointSets corners(4 * tetrahedra_.size());
  const auto corner_of = [&](std::size_t t, std::int32_t node) {
    const auto& v = tetrahedra_[t];
    return 4 * t + static_cast<std::size_t>(std::find(v.begin(), v.end(), node) - v.begin());
  };
  for_each_face([&](auto first, auto last) {
    if (last - first != 2) return;
    for (const std::int32_t node : first->nodes) {
      corners.merge(corner_of(first->tetrahedron, node), corner_of(first[1].tetrahedron, node));
    }
  });
  std::vector<std::size_t> star_of(positions_.size(), corners.find(0));
  std::vector<bool> seen(positions_.size(), false);
  TetList pinched;
  for (std::size_t c = 0; c < 4 * tetrahedra_.size(); ++c) {
    const auto node = static_cast<std::size_t>(tetrahedra_[c / 4][c % 4]);
    if (!seen[node]) star_of[node] = corners.find(c);
    if (seen[node] && star_of[node] != corners.find(c)) pinched.push_back(node);
    seen[node] = true;
  }
  refuse("nodes", pinched, "join regions that touch there in a point or an edge only (non-manifold)");
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

// Tetrahedra that wind around an edge more than once overlap, although each pair of neighbours looks right.
void Checker::check_edge_angles() {
  struct EdgeAngle {
    std::int32_t low, high;
    double angle;
    std::size_t tetrahedron;
  };
  constexpr std::array<std::array<int, 4>, 6> kEdges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  std::vector<EdgeAngle> angles;
  angles.reserve(6 * tetrahedra_.size());
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    const auto& v = tetrahedra_[t];
    const std::array<Vec3, 4> p = {position(v[0]), position(v[1]), position(v[2]), position(v[3])};
    for (const auto& [i, j, k, l] : kEdges) {
      angles.push_back({std::min(v[i], v[j]), std::max(v[i], v[j]), dihedral_angle(p, i, j, k, l), t});
    }
  }
  const auto key = [](const EdgeAngle& e) { return std::pair(e.low, e.high); };
  std::sort(angles.begin(), angles.end(),
            [&](const EdgeAngle& a, const EdgeAngle& b) { return key(a) < key(b); });
  TetList which;
  for (std::size_t first = 0, last = 0; first < angles.size(); first = last) {
    double sum = 0;
    for (; last < angles.size() && key(angles[last]) == key(angles[first]); ++last) sum += angles[last].angle;
    if (sum < 2 * std::numbers::pi + kAngleTolerance) continue;
    for (std::size_t i = first; i < last; ++i) which.push_back(angles[i].tetrahedron);
  }
  refuse("tetrahedra", which, "wind around a shared edge more than once (overlapping)");
}

// With every neighbour on its own side, tetrahedra can only overlap where the boundary passes through itself.
void Checker::check_boundary_crossings() {
  std::vector<std::array<std::int32_t, 3>> triangles;
  TetList behind;
  for_each_face([&](auto first, auto last) {
    if (last - first != 1) return;
    triangles.push_back(first->nodes);
    behind.push_back(first->tetrahedron);
  });
  TetList which;
  for (const auto& [i, j] : crossing_triangles(positions_, triangles)) {
    which.push_back(behind[i]);
    which.push_back(behind[j]);
  }
  refuse("tetrahedra", which, "have boundary faces that pass through each other (overlapping)");
}

void Checker::drop_unused_nodes() {
  std::vector<std::int32_t> compact(positions_.size(), -1);
  for (const auto& v : tetrahedra_) {
    for (const std::int32_t node : v) compact[static_cast<std::size_t>(node)] = 0;
  }
  TetraMesh& mesh = result_.mesh;
  mesh.file_node_count = static_cast<std::int32_t>(positions_.size());
  for (std::size_t n = 0; n < positions_.size(); ++n) {
    if (compact[n] < 0) continue;
    compact[n] = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.push_back(positions_[n]);
    mesh.file_node.push_back(static_cast<std::int32_t>(n));
  }
  const auto node = [&](std::int32_t n) { return NodeId(compact[static_cast<std::size_t>(n)]); };
  for (const auto& v : tetrahedra_)
    mesh.tetrahedra.push_back({node(v[0]), node(v[1]), node(v[2]), node(v[3])});
  warn(positions_.size() - mesh.positions.size(), "node belongs to no tetrahedron and is dropped",
       "nodes belong to no tetrahedron and are dropped");
}

CheckedMesh Checker::run() {
  check_node_numbers();
  check_finite();
  orient();
  check_repeated();
  collect_faces();
  check_connected();
  stop_if_refused();  // without volume or among copies, neighbours mean nothing
  check_face_sides();
  check_boundary_edges();
  check_vertex_stars();
  stop_if_refused();
  check_edge_angles();
  check_boundary_crossings();
  stop_if_refused();
  drop_unused_nodes();
  return std::move(result_);
}

}  // namespace

CheckedMesh check_mesh(const RawMesh& raw, double metres_per_unit) {
  return Checker(raw, metres_per_unit).run();
}

}  // namespace omentum::geometry
