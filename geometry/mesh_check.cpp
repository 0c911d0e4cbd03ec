#include "geometry/mesh_topology.h"
#include "geometry/tetra_faces.h"
#include "geometry/tetra_mesh.h"
#include "geometry/twin_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omentum::geometry {
namespace {

// A tetrahedron flatter than this fraction of its longest edge has no volume worth the name: its stiffness
// would exceed its neighbours' by the inverse of the same factor.
constexpr double kFlattestHeight = 1e-6;

// Nodes that are closer than this fraction of the mesh's diagonal are at the same place: what single
// precision tells apart there. An honest edge is a thousand times longer.
constexpr double kSamePlace = 1e-7;

// Offenders named in a message before it only counts.
constexpr std::size_t kNamed = 5;

class Checker {
 public:
  Checker(const RawMesh& raw, double metres_per_unit, const CheckOptions& options)
      : raw_(raw),
        tetrahedra_(raw.tetrahedra),
        options_(options),
        node_names_(raw.node_numbers, raw.positions.size(), options.numbering),
        tetrahedron_names_(raw.tetrahedron_numbers, raw.tetrahedra.size(), options.numbering) {
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
  void drop_unused_nodes();
  void keep_file_numbers();

  std::vector<std::int32_t> used_nodes() const;
  void treat_what_is_not_read();
  std::string numbered(const FileNumbers& names, const Offenders& which) const;
  std::string node_name(std::int32_t node) const {
    return "node " + std::to_string(node_names_.of(static_cast<std::size_t>(node)));
  }
  const Vec3& position(std::int32_t node) const { return positions_[static_cast<std::size_t>(node)]; }
  void refuse(const char* thing, const FileNumbers& names, Offenders which, const std::string& what);
  void refuse_tetrahedra(const Offenders& which, const std::string& what) {
    refuse("tetrahedra", tetrahedron_names_, which, what);
  }
  void refuse_nodes(const Offenders& which, const std::string& what) {
    refuse("nodes", node_names_, which, what);
  }
  void warn(std::size_t count, const char* singular, const char* plural);
  [[noreturn]] void throw_reasons() const;
  void stop_if_refused() const {
    if (!reasons_.empty()) throw_reasons();
  }

  const RawMesh& raw_;
  std::vector<Vec3> positions_;                          // all nodes of the file, m
  std::vector<std::array<std::int32_t, 4>> tetrahedra_;  // positively oriented after orient()
  CheckOptions options_;
  FileNumbers node_names_, tetrahedron_names_;  // for messages
  std::vector<std::string> reasons_;
  CheckedMesh result_;
};

std::string Checker::numbered(const FileNumbers& names, const Offenders& which) const {
  std::string text;
  for (std::size_t i = 0; i < std::min(which.size(), kNamed); ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(names.of(which[i]));
  }
  if (which.size() > kNamed) text += ", ... (" + std::to_string(which.size()) + " in all)";
  return text;
}

void Checker::refuse(const char* thing, const FileNumbers& names, Offenders which, const std::string& what) {
  if (which.empty()) return;
  std::sort(which.begin(), which.end());
  which.erase(std::unique(which.begin(), which.end()), which.end());
  reasons_.push_back(thing + numbered(names, which) + ": " + what);
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
        throw InputError(raw_.source + ": tetrahedron " + std::to_string(tetrahedron_names_.of(t)) +
                         " names node " + std::to_string(v[i]) + ", expected 0 to " +
                         std::to_string(count - 1));
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
        throw InputError(raw_.source + ": the position of " + node_name(node) + " is not finite");
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
  refuse_tetrahedra(collapsed, "with nodes that are no farther apart than what is merged");
  for (std::size_t n = 0; n < first.size(); ++n) {
    const auto node = static_cast<std::int32_t>(n);
    if (first[n] != node) result_.mesh.merged.push_back({node, first[n]});
  }
  warn(result_.mesh.merged.size(), "node was merged into another one at its place",
       "nodes were merged into others at their places");
  stop_if_refused();
}

void Checker::check_twins() {
  Vec3 low = position(tetrahedra_[0][0]), high = low;
  const std::vector<std::int32_t> nodes = used_nodes();
  for (const std::int32_t node : nodes)
    low = low.cwiseMin(position(node)), high = high.cwiseMax(position(node));
  const auto pairs = find_twins(positions_, nodes, kSamePlace * (high - low).norm());
  if (pairs.empty()) return;
  // what else is wrong may follow from it
  reasons_.insert(reasons_.begin(), describe_twins(pairs, node_names_, kNamed));
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
  refuse_tetrahedra(flat, "zero volume (height below 1e-6 of the longest edge)");
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
  Offenders repeated;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) repeated.push_back(sorted[i].second);
  }
  refuse_tetrahedra(repeated, "repeating the nodes of an earlier one");
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
  warn(positions_.size() - mesh.positions.size() - mesh.merged.size(),
       "node belongs to no tetrahedron and is dropped", "nodes belong to no tetrahedron and are dropped");
}

void Checker::keep_file_numbers() {
  const auto all = [](const std::vector<std::int64_t>& own, std::size_t count) {
    if (!own.empty()) return own;
    std::vector<std::int64_t> from_zero(count);
    std::iota(from_zero.begin(), from_zero.end(), 0);
    return from_zero;
  };
  result_.mesh.node_numbers = all(raw_.node_numbers, raw_.positions.size());
  result_.mesh.tetrahedron_numbers = all(raw_.tetrahedron_numbers, raw_.tetrahedra.size());
  result_.mesh.regions = raw_.regions;
  result_.mesh.why_no_regions = raw_.why_no_regions;
}

// Elements first: without volume, or among copies, neighbours mean nothing.
void Checker::check_elements() {
  check_node_numbers();
  check_finite();
  merge_twins();
  orient();
  check_repeated();
  stop_if_refused();
}

void Checker::check_neighbours() {
  const std::vector<FaceSide> sides = collect_face_sides(tetrahedra_);
  const Offenders parts = separate_parts(sides, tetrahedra_.size());
  if (parts.size() > 1) refuse_tetrahedra(parts, "in parts that no faces connect");
  const FaceFaults faults = find_face_faults(sides, tetrahedra_.size());
  refuse_tetrahedra(faults.crowded, "sharing a face with more than one other (non-manifold)");
  refuse_tetrahedra(faults.inside_out, "turned inside out against most of their neighbours (overlapping)");
  refuse_tetrahedra(faults.folded, "on the same side of a shared face (overlapping)");
  refuse_tetrahedra(touching_along_edges(sides), "touching along an edge only (non-manifold boundary)");
  refuse_nodes(pinched_nodes(sides, tetrahedra_, positions_.size()),
               "joining regions that touch there in a point or an edge only (non-manifold)");
  if (!reasons_.empty()) check_twins();
  stop_if_refused();
  refuse_nodes(pinched_boundary_nodes(sides, positions_.size()),
               "joining boundary faces that touch there in a point only (non-manifold boundary)");
  refuse_tetrahedra(winding_around_edges(positions_, tetrahedra_),
                    "winding around a shared edge more than once (overlapping)");
  refuse_tetrahedra(crossing_at_boundary(positions_, sides),
                    "boundary faces pass through each other (overlapping)");
  refuse_tetrahedra(covered_at_boundary(positions_, tetrahedra_, sides),
                    "at the boundary lying inside another one (overlapping)");
  check_twins();
  stop_if_refused();
}

// Surfaces, lines and points beside the tetrahedra take no room; what does must not vanish in silence.
void Checker::treat_what_is_not_read() {
  warn(raw_.curved, "tetrahedron has more than four nodes: its corners alone are read",
       "tetrahedra have more than four nodes: their corners alone are read");
  const std::string solids = describe_solids(raw_.others);
  if (solids.empty()) return;
  if (!options_.ignore_other_cells) {
    throw InputError(
        raw_.source + ": found " + solids + " besides the tetrahedra, expected tetrahedra alone: " +
        "the organ would lack what they fill (organ_build --ignore-other-cells leaves them out)");
  }
  result_.warnings.push_back(raw_.source + ": not read, no tetrahedra: " + solids);
}

CheckedMesh Checker::run() {
  treat_what_is_not_read();
  check_elements();
  check_neighbours();
  drop_unused_nodes();
  keep_file_numbers();
  return std::move(result_);
}

}  // namespace

CheckedMesh check_mesh(const RawMesh& raw, double metres_per_unit, const CheckOptions& options) {
  return Checker(raw, metres_per_unit, options).run();
}

}  // namespace omentum::geometry
