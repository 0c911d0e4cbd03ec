#include "haptic_node/deformed_surface.h"

#include "geometry/precondition.h"
#include "haptic_node/cluster_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace omentum::haptic {
namespace {

using geometry::kClusterSize;

// Drift after which a cluster's box is drawn anew, m, and the part of the binning margin that it may be at
// most: some ticks of a moving dent, little beside kReach_m.
constexpr float kLooseBox_m = 4e-4f;
constexpr double kLoosePart = 0.25;
// Clusters outside of all regions that are made exact in a tick, so that those inside know their neighbours.
constexpr int kRefreshesPerTick = 4;
// Regions evaluated in a tick: one per tool.
constexpr std::size_t kMaxRegions = 8;
// So many clusters' marks are looked at together: the first one is the lowest byte.
using MarkWord = std::uint64_t;
static_assert(std::endian::native == std::endian::little);

}  // namespace

DeformedSurface::DeformedSurface(const geometry::Surface& surface, std::span<const Vec3> rest,
                                 const physics::SurfaceCompliance& compliance, const BodyOrigin& origin)
    : Body(origin, compliance.mobile_count()),
      surface_(surface),
      rest_(rest),
      compliance_(compliance),
      clusters_(compliance.cluster_count()),
      positions_(rest.begin(), rest.end()),
      index_of_(rest.size(), -1),
      grid_(surface, rest, geometry::BucketGrid::suitable_slack(surface, rest)),
      binning_margin_(grid_.slack() / 2),
      loosest_(std::min(kLooseBox_m, static_cast<float>(kLoosePart * binning_margin_))) {
  for (auto* nodes : {&nodes_, &proposed_nodes_}) nodes->reserve(kMaxForces);
  for (auto* forces : {&forces_, &proposed_forces_}) forces->reserve(kMaxForces);
  index_clusters();
  find_normals();
  find_longest_edges();
  find_border();
  find_other_side();
  size_bounds();
  restore_rest();
}

void DeformedSurface::index_clusters() {
  std::vector<std::vector<std::int32_t>> outer(clusters_), owned(clusters_);
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    const geometry::Triangle& triangle = surface_.triangles[t];
    std::array<std::int32_t, 3> home;
    for (int v = 0; v < 3; ++v) home[v] = triangle[v] / kClusterSize;
    const std::int32_t owner = *std::min_element(home.begin(), home.end());
    if (owner < clusters_) owned[owner].push_back(static_cast<std::int32_t>(t));
    for (int v = 0; v < 3; ++v) {
      for (int w = 0; w < 3; ++w) {
        if (home[v] < clusters_ && home[w] != home[v]) outer[home[v]].push_back(triangle[w]);
      }
    }
  }
  for (std::int32_t c = 0; c < clusters_; ++c) {
    std::sort(outer[c].begin(), outer[c].end());
    outer[c].erase(std::unique(outer[c].begin(), outer[c].end()), outer[c].end());
    outer_start_.push_back(static_cast<std::int32_t>(outer_.size()));
    next_start_.push_back(static_cast<std::int32_t>(next_.size()));
    owned_start_.push_back(static_cast<std::int32_t>(owned_.size()));
    outer_.insert(outer_.end(), outer[c].begin(), outer[c].end());
    owned_.insert(owned_.end(), owned[c].begin(), owned[c].end());
    for (const std::int32_t n : outer[c]) {  // ascending, so clusters come in runs
      const std::int32_t home = n / kClusterSize;
      if (home < clusters_ && (std::ssize(next_) == next_start_[c] || next_.back() != home))
        next_.push_back(home);
    }
  }
  outer_start_.push_back(static_cast<std::int32_t>(outer_.size()));
  next_start_.push_back(static_cast<std::int32_t>(next_.size()));
  owned_start_.push_back(static_cast<std::int32_t>(owned_.size()));
}

void DeformedSurface::size_bounds() {
  const auto clusters = static_cast<std::size_t>(clusters_);
  for (int i = 0; i < 3; ++i) {
    low_[i].resize(clusters);
    high_[i].resize(clusters);
  }
  for (auto* values : {&moved_, &moved_since_binning_, &step_, &motion_}) values->resize(clusters);
  marks_.assign((clusters / sizeof(MarkWord) + 1) * sizeof(MarkWord), 0);
  pending_.reserve(clusters);
  unbinned_.reserve(kMaxRegions * clusters);
  cluster_version_.resize(clusters);
}

void DeformedSurface::restore_rest() noexcept {
  std::ranges::copy(rest_, positions_.begin());
  nodes_.clear();
  forces_.clear();
  unbinned_.clear();
  std::ranges::fill(index_of_, std::int16_t{-1});
  for (auto* values : {&moved_, &step_, &motion_}) std::ranges::fill(*values, 0.0f);
  // wherever triangles were, their buckets are looked at before they are asked
  std::ranges::fill(moved_since_binning_, 2 * static_cast<float>(binning_margin_));
  std::ranges::fill(cluster_version_, ++version_);
  known_motion_ = entered_motion_ = 0;
  change_.count = 0;
  for (std::int32_t c = 0; c < clusters_; ++c) enclose(c);
}

void DeformedSurface::propose(std::span<const SurfaceId> nodes, std::span<const Vec3> forces) noexcept {
  geometry::require(nodes.size() == forces.size() && nodes.size() <= kMaxForces,
                    "a force for each of at most kMaxForces nodes");
  geometry::require(std::ranges::all_of(nodes, [this](SurfaceId n) { return is_mobile(n); }), "mobile nodes");
  proposed_nodes_.assign(nodes.begin(), nodes.end());
  proposed_forces_.assign(forces.begin(), forces.end());
  change_.count = 0;
  const auto add = [&](SurfaceId node, const Vec3& difference) {
    if (difference.isZero(0)) return;
    change_.nodes[change_.count] = node;
    // float rounding of the sums must not lose any of it
    change_.sizes_n[change_.count++] = static_cast<float>(difference.norm() * 1.00001);
  };
  std::array<bool, kMaxForces> goes_on;
  std::fill_n(goes_on.begin(), nodes_.size(), false);
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    const std::int16_t old = index_of_[nodes[q]];
    if (old >= 0) goes_on[old] = true;
    add(nodes[q], old < 0 ? forces[q] : Vec3(forces[q] - forces_[old]));
  }
  for (std::size_t q = 0; q < nodes_.size(); ++q) {
    if (!goes_on[q]) add(nodes_[q], forces_[q]);
  }
}

double DeformedSurface::motion_bound(const SurfacePoint& point) const noexcept {
  const geometry::Triangle& t = surface_.triangles[point.triangle];
  const auto mobile = std::ranges::find_if(t, [&](SurfaceId n) { return n < surface_.mobile_count; });
  if (mobile == t.end()) return 0;
  double sum = 0;
  for (int i = 0; i < change_.count; ++i)
    sum += change_.sizes_n[i] * compliance_.bounds(change_.nodes[i])[*mobile / kClusterSize];
  return sum;
}

double DeformedSurface::beyond_neighbours(SurfaceId n) const noexcept {
  const auto mean = [&](SurfaceId k) { return compliance_.block(n, k).trace() / 3; };
  double around = 0;
  int count = 0;
  for (const TriangleId t : surface_.triangles_of(n)) {
    for (const SurfaceId k : surface_.triangles[t]) {
      if (k == n) continue;
      if (k < surface_.mobile_count) around += mean(k);
      ++count;
    }
  }
  return std::max(0.0, mean(n) - around / count);
}

void DeformedSurface::accept() noexcept {
  std::array<const float*, 2 * kMaxForces> rows;
  for (int i = 0; i < change_.count; ++i) rows[i] = compliance_.bounds(change_.nodes[i]).data();
  for (const SurfaceId node : nodes_) index_of_[node] = -1;
  nodes_.swap(proposed_nodes_);
  forces_.swap(proposed_forces_);
  for (std::size_t q = 0; q < nodes_.size(); ++q) index_of_[nodes_[q]] = static_cast<std::int16_t>(q);
  evaluated_clusters_ = 0;
  known_motion_ = entered_motion_ = 0;
  refreshed_ = 0;
  unbinned_.clear();
  kernels::weighted_sum(rows.data(), change_.sizes_n.data(), change_.count, clusters_, step_.data());
  motion_ = step_;
  if (change_.count == 0) return;
  kernels::add_to_both(step_.data(), clusters_, moved_.data(), moved_since_binning_.data());
  ++version_;
}

void DeformedSurface::rest_moved(double most_m) noexcept {
  if (most_m == 0) return;
  const float more = static_cast<float>(most_m) + kRounding_m;
  for (auto* values : {&step_, &motion_, &moved_, &moved_since_binning_}) {
    for (float& value : *values) value += more;
  }
  // positions that the last accept left to be found are found with both motions
  if (change_.count == 0 || evaluated_clusters_ > 0) ++version_;
}

void DeformedSurface::evaluate(const Region& region) noexcept {
  const Eigen::Vector3f low = (region.low.array() - kReach_m).cast<float>() - kRounding_m;
  const Eigen::Vector3f high = (region.high.array() + kReach_m).cast<float>() + kRounding_m;
  const kernels::Boxes boxes{{low_[0].data(), low_[1].data(), low_[2].data()},
                             {high_[0].data(), high_[1].data(), high_[2].data()}};
  kernels::mark_meeting(boxes, moved_.data(), low.data(), high.data(), clusters_, marks_.data());
  pending_.clear();
  for (std::int32_t word = 0; word < clusters_; word += sizeof(MarkWord)) {
    MarkWord marks;
    std::memcpy(&marks, &marks_[word], sizeof marks);
    for (; marks != 0; marks &= marks - 1) pending_.push_back(word + std::countr_zero(marks) / 8);
  }
  // all positions first: boxes then see their neighbours' exact ones
  const auto exact =
      std::partition(pending_.begin(), pending_.end(), [this](std::int32_t c) { return !fresh(c); });
  for (auto c = pending_.begin(); c != exact; ++c) superpose(*c);
  for (auto c = pending_.begin(); c != exact; ++c) learn_motion(*c);
  for (const std::int32_t c : pending_) {
    if (moved_since_binning_[c] > binning_margin_) unbinned_.push_back(c);
  }
}

void DeformedSurface::make_exact(std::int32_t cluster) noexcept {
  superpose(cluster);
  learn_motion(cluster);
}

void DeformedSurface::superpose(std::int32_t cluster) noexcept {
  float u[3 * kClusterSize];
  physics::superpose_cluster(compliance_, cluster, nodes_, forces_, u);
  const std::int32_t first = cluster * kClusterSize;
  const std::int32_t count = std::min(kClusterSize, surface_.mobile_count - first);
  double moved_squared = 0;
  for (std::int32_t l = 0; l < count; ++l) {
    const Vec3 x = rest_[first + l] + Vec3(u[l], u[kClusterSize + l], u[2 * kClusterSize + l]);
    moved_squared = std::max(moved_squared, (x - positions_[first + l]).squaredNorm());
    positions_[first + l] = x;
  }
  // where the positions before were those of the forces before, the motion is known, not only bounded
  if (cluster_version_[cluster] + 1 == version_) {
    motion_[cluster] = std::min(step_[cluster], static_cast<float>(std::sqrt(moved_squared)) + kRounding_m);
    known_motion_ = std::max(known_motion_, static_cast<double>(motion_[cluster]));
  } else {
    entered_motion_ = std::max(entered_motion_, static_cast<double>(step_[cluster]));
  }
  cluster_version_[cluster] = version_;
  ++evaluated_clusters_;
}

// The last step was added with its bound; now that the motion is known, this replaces it.
void DeformedSurface::learn_motion(std::int32_t cluster) noexcept {
  float motion = motion_[cluster];
  for (std::int32_t o = next_start_[cluster]; o < next_start_[cluster + 1]; ++o)
    motion = std::max(motion, motion_[next_[o]]);
  const float surplus = step_[cluster] - std::min(motion, step_[cluster]);
  moved_since_binning_[cluster] -= surplus;
  moved_[cluster] -= surplus;
  if (moved_[cluster] > loosest_) enclose(cluster);
}

void DeformedSurface::enclose(std::int32_t cluster) noexcept {
  const std::int32_t first = cluster * kClusterSize;
  const std::int32_t last = std::min(first + kClusterSize, surface_.node_count());
  Eigen::Array3d low = positions_[first].array(), high = low;
  for (std::int32_t n = first + 1; n < last; ++n) {
    low = low.min(positions_[n].array());
    high = high.max(positions_[n].array());
  }
  // neighbours that were not superposed with these forces may be anywhere within what they moved since
  for (std::int32_t o = outer_start_[cluster]; o < outer_start_[cluster + 1]; ++o) {
    const std::int32_t n = outer_[o], home = n / kClusterSize;
    const float moved = fresh(home) ? 0.0f : moved_[home];
    low = low.min(positions_[n].array() - moved);
    high = high.max(positions_[n].array() + moved);
  }
  for (int i = 0; i < 3; ++i) {
    low_[i][cluster] = static_cast<float>(low[i]) - kRounding_m;
    high_[i][cluster] = static_cast<float>(high[i]) + kRounding_m;
  }
  moved_[cluster] = 0;
}

void DeformedSurface::bin(std::int32_t cluster) noexcept {
  if (moved_since_binning_[cluster] <= binning_margin_) return;  // listed twice
  float stale = 0;
  for (std::int32_t o = outer_start_[cluster]; o < outer_start_[cluster + 1]; ++o) {
    const std::int32_t home = outer_[o] / kClusterSize;
    if (fresh(home)) continue;
    // a neighbour that is too vague would bring this cluster here in every tick; they are made exact a few at
    // a time, so that no tick pays for all
    if (moved_[home] > binning_margin_ / 2 && refreshed_ < kRefreshesPerTick) {
      ensure(home);
      ++refreshed_;
    } else {
      stale = std::max(stale, moved_[home]);
    }
  }
  for (std::int32_t o = owned_start_[cluster]; o < owned_start_[cluster + 1]; ++o) {
    grid_.update(TriangleId(owned_[o]), positions_);
  }
  moved_since_binning_[cluster] = stale;
}

void DeformedSurface::bin_pending() noexcept {
  for (const std::int32_t c : unbinned_) bin(c);  // adds none: what bin() makes exact lies outside
  unbinned_.clear();
}

}  // namespace omentum::haptic
