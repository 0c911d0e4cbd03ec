#include "geometry/compact_mesh.h"
#include "geometry/hanging_tetrahedra.h"
#include "geometry/mesh_findings.h"
#include "geometry/mesh_topology.h"
#include "geometry/tetra_faces.h"
#include "geometry/tetra_mesh.h"
#include "geometry/twin_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace omentum::geometry {
namespace {

// A tetrahedron flatter than this fraction of its longest edge has no volume worth the name: its stiffness
// would exceed its neighbours' by the inverse of the same factor.
constexpr double kFlattestHeight = 1e-6;

// Nodes that are closer than this fraction of the mesh's diagonal are at the same place: what single
// precision tells apart there. An honest edge is a thousand times longer.
constexpr double kSamePlace = 1e-7;

// More than this fraction of the volume is no few elements that a mesher left hanging.
constexpr double kMostHanging = 0.05;

class Checker {
 public:
  Checker(const RawMesh& raw, double metres_per_unit, const CheckOptions& options)
      : raw_(raw),
        tetrahedra_(raw.tetrahedra),
        kept_(raw.tetrahedra.size()),
        options_(options),
        findings_(raw, options.numbering) {
    std::iota(kept_.begin(), kept_.end(), 0);
    scale_positions(metres_per_unit);
  }

  CheckedMesh run();

 private:
  void scale_positions(double metres_per_unit);
  void check_elements();
  void check_neighbours();
  void check_node_numbers() const;
  void check_finite() const;
  void merge_twins();
  void check_twins();
  void orient();
  void check_repeated();
  void drop_hanging();
  void keep_only(const Offenders& dropped);
  TetraMesh compacted();

  std::vector<std::int32_t> used_nodes() const;
  void treat_what_is_not_read();
  const Vec3& position(std::int32_t node) const { return positions_[static_cast<std::size_t>(node)]; }
  double volume(const std::array<std::int32_t, 4>& v) const {
    return signed_volume(position(v[0]), position(v[1]), position(v[2]), position(v[3]));
  }

  const RawMesh& raw_;
  std::vector<Vec3> positions_;                          // all nodes of the file, m
  std::vector<std::array<std::int32_t, 4>> tetrahedra_;  // positively oriented after orient()
  std::vector<std::size_t> kept_;                        // place in the file of each of them
  CheckOptions options_;
  MeshFindings findings_;
  std::vector<MergedNode> merged_;
};

void Checker::scale_positions(double metres_per_unit) {
  if (!(metres_per_unit > 0) || !std::isfinite(metres_per_unit)) {
    throw InputError(raw_.source + ": found the scale " + std::to_string(metres_per_unit) +
                     " metres per unit, expected a positive number");
  }
  if (!(options_.merge_m >= 0) || !std::isfinite(options_.merge_m)) {
    throw InputError(raw_.source + ": found the merging distance " + std::to_string(options_.merge_m) +
                     " m, expected a positive number");
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
        throw InputError(raw_.source + ": " + findings_.tetrahedron(t) + " names node " +
                         std::to_string(v[i]) + ", expected 0 to " + std::to_string(count - 1));
      }
    }
  }
  if (positions_.size() > kMostNodes || raw_.tetrahedra.size() > kMostNodes) {
    throw InputError(raw_.source + ": found " + std::to_string(positions_.size()) + " nodes and " +
                     std::to_string(raw_.tetrahedra.size()) + " tetrahedra, expected at most " +
                     std::to_string(kMostNodes) + " of each");
  }
  if (raw_.tetrahedra.empty()) throw InputError(raw_.source + ": found no tetrahedra, expected at least one");
}

void Checker::check_finite() const {
  for (const auto& tetrahedron : raw_.tetrahedra) {
    for (const std::int32_t node : tetrahedron) {
      if (!position(node).allFinite())
        throw InputError(raw_.source + ": the position of " + findings_.node(static_cast<std::size_t>(node)) +
                         " is not finite");
    }
  }
}

std::vector<std::int32_t> Checker::used_nodes() const {
  std::vector<bool> used(positions_.size());
  for (const auto& tetrahedron : tetrahedra_) {
    for (const std::int32_t node : tetrahedron) used[static_cast<std::size_t>(node)] = true;
  }
  std::vector<std::int32_t> nodes;
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (used[n]) nodes.push_back(static_cast<std::int32_t>(n));
  }
  return nodes;
}

void Checker::merge_twins() {
  if (options_.merge_m == 0) return;
  const std::vector<std::int32_t> first =
      first_of_twins(find_twins(positions_, used_nodes(), options_.merge_m), positions_.size());
  Offenders collapsed;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    auto& v = tetrahedra_[t];
    for (std::int32_t& node : v) node = first[static_cast<std::size_t>(node)];
    auto sorted = v;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) collapsed.push_back(t);
  }
  findings_.refuse_tetrahedra(collapsed, "with nodes that are no farther apart than what is merged");
  for (std::size_t n = 0; n < first.size(); ++n) {
    const auto node = static_cast<std::int32_t>(n);
    if (first[n] != node) merged_.push_back({node, first[n]});
  }
  findings_.warn(merged_.size(), "node was merged into another one at its place",
                 "nodes were merged into others at their places");
  findings_.stop_if_refused();
}

void Checker::check_twins() {
  Vec3 low = position(tetrahedra_[0][0]), high = low;
  const std::vector<std::int32_t> nodes = used_nodes();
  for (const std::int32_t node : nodes)
    low = low.cwiseMin(position(node)), high = high.cwiseMax(position(node));
  findings_.refuse_twins(find_twins(positions_, nodes, kSamePlace * (high - low).norm()));
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
  Offenders flat;
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
  findings_.refuse_tetrahedra(flat, "zero volume (height below 1e-6 of the longest edge)");
  findings_.warn(reordered, "tetrahedron was listed in negative order and is reordered",
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
  Offenders repeated;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) repeated.push_back(sorted[i].second);
  }
  findings_.refuse_tetrahedra(repeated, "repeating the nodes of an earlier one");
}

void Checker::keep_only(const Offenders& dropped) {
  std::vector<bool> goes(tetrahedra_.size(), false);
  for (const std::size_t t : dropped) goes[t] = true;
  std::size_t count = 0;
  for (std::size_t t = 0; t < goes.size(); ++t) {
    if (goes[t]) continue;
    tetrahedra_[count] = tetrahedra_[t];
    kept_[count++] = kept_[t];
  }
  tetrahedra_.resize(count);
  kept_.resize(count);
  findings_.count_tetrahedra_among(kept_);
}

void Checker::drop_hanging() {
  const Offenders hanging = hanging_tetrahedra(tetrahedra_, positions_.size());
  if (hanging.empty()) return;
  double all = 0, dropped = 0;
  for (const auto& v : tetrahedra_) all += volume(v);
  for (const std::size_t t : hanging) dropped += volume(tetrahedra_[t]);
  std::ostringstream what;
  what << hanging.size() << (hanging.size() == 1 ? " tetrahedron" : " tetrahedra")
       << findings_.list_tetrahedra(hanging) << " with " << dropped * 1e9 << " mm^3, " << 100 * dropped / all
       << " % of the volume, at nodes or edges where parts touch only there";
  if (dropped > kMostHanging * all) {
    throw InputError(raw_.source + ": to repair it would drop " + what.str() + "; expected at most " +
                     std::to_string(std::lround(100 * kMostHanging)) + " %: join the parts by faces");
  }
  keep_only(hanging);
  findings_.warn("repaired: dropped " + what.str());
}

TetraMesh Checker::compacted() {
  TetraMesh mesh = compact_mesh(raw_, positions_, tetrahedra_, kept_);
  mesh.merged = std::move(merged_);
  // a repair may have dropped what used the node that was kept
  std::erase_if(mesh.merged, [&](const MergedNode& pair) {
    return !std::ranges::binary_search(mesh.file_node, pair.kept);
  });
  findings_.warn(positions_.size() - mesh.positions.size() - mesh.merged.size(),
                 "node belongs to no tetrahedron and is dropped",
                 "nodes belong to no tetrahedron and are dropped");
  return mesh;
}

// Elements first: without volume, or among copies, neighbours mean nothing.
void Checker::check_elements() {
  check_node_numbers();
  check_finite();
  merge_twins();
  orient();
  check_repeated();
  findings_.stop_if_refused();
  if (options_.repair) drop_hanging();
}

void Checker::check_neighbours() {
  const std::vector<FaceSide> sides = collect_face_sides(tetrahedra_);
  const Offenders parts = separate_parts(sides, tetrahedra_.size());
  if (parts.size() > 1) findings_.refuse_tetrahedra(parts, "in parts that no faces connect");
  const FaceFaults faults = find_face_faults(sides, tetrahedra_.size());
  findings_.refuse_tetrahedra(faults.crowded, "sharing a face with more than one other (non-manifold)");
  findings_.refuse_tetrahedra(faults.inside_out,
                              "turned inside out against most of their neighbours (overlapping)");
  findings_.refuse_tetrahedra(faults.folded, "on the same side of a shared face (overlapping)");
  findings_.refuse_tetrahedra(touching_along_edges(sides),
                              "touching along an edge only (non-manifold boundary)");
  findings_.refuse_nodes(pinched_nodes(sides, tetrahedra_, positions_.size()),
                         "joining regions that touch there in a point or an edge only (non-manifold)");
  if (findings_.refused()) check_twins();
  findings_.stop_if_refused();
  findings_.refuse_nodes(pinched_boundary_nodes(sides, positions_.size()),
                         "joining boundary faces that touch there in a point only (non-manifold boundary)");
  findings_.refuse_tetrahedra(winding_around_edges(positions_, tetrahedra_),
                              "winding around a shared edge more than once (overlapping)");
  findings_.refuse_tetrahedra(crossing_at_boundary(positions_, sides),
                              "boundary faces pass through each other (overlapping)");
  findings_.refuse_tetrahedra(covered_at_boundary(positions_, tetrahedra_, sides),
                              "at the boundary lying inside another one (overlapping)");
  check_twins();
  findings_.stop_if_refused();
}

// Surfaces, lines and points beside the tetrahedra take no room; what does must not vanish in silence.
void Checker::treat_what_is_not_read() {
  findings_.warn(raw_.curved, "tetrahedron has more than four nodes: its corners alone are read",
                 "tetrahedra have more than four nodes: their corners alone are read");
  const std::string solids = describe_solids(raw_.others);
  if (solids.empty()) return;
  if (!options_.ignore_other_cells) {
    throw InputError(
        raw_.source + ": found " + solids + " besides the tetrahedra, expected tetrahedra alone: " +
        "the organ would lack what they fill (organ_build --ignore-other-cells leaves them out)");
  }
  findings_.warn("not read, no tetrahedra: " + solids);
}

CheckedMesh Checker::run() {
  treat_what_is_not_read();
  check_elements();
  check_neighbours();
  TetraMesh mesh = compacted();
  return {std::move(mesh), findings_.warnings()};
}

}  // namespace

CheckedMesh check_mesh(const RawMesh& raw, double metres_per_unit, const CheckOptions& options) {
  return Checker(raw, metres_per_unit, options).run();
}

}  // namespace omentum::geometry
