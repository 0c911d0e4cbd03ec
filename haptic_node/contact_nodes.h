// C_AA of the nodes in contact, kept between ticks: only nodes that enter are gathered.
#pragma once

#include "geometry/types.h"
#include "haptic_node/cluster_kernels.h"
#include "physics/contact_problem.h"

#include <vector>

namespace omentum::haptic {

using geometry::SurfaceId;
using geometry::Vec3;

/// The compliance between nodes of a body.
class NodeCompliance {
 public:
  NodeCompliance() = default;
  virtual ~NodeCompliance() = default;
  NodeCompliance(const NodeCompliance&) = delete;
  NodeCompliance& operator=(const NodeCompliance&) = delete;

  /// C_nk of two mobile nodes, m/N: C_kn^T.
  virtual Eigen::Matrix3f block(SurfaceId n, SurfaceId k) const noexcept = 0;
  /// What a force on a mobile node moves it beyond its neighbours, as a scalar, m/N: a third of the trace of
  /// C_nn less the neighbours' mean C_nk; never negative.
  virtual double beyond_neighbours(SurfaceId n) const noexcept = 0;
};

/// Slots for contact nodes with the 3x3 blocks between all of them. A node that left keeps its slot for some
/// ticks, so that a contact that slides back and forth over an edge gathers nothing.
///
/// No allocation after construction. One thread at a time. The compliance must outlive it.
class ContactNodes {
 public:
  static constexpr int kSlots = 3 * physics::kMaxContacts;  // a contact shares its force among three nodes

  ContactNodes(const NodeCompliance& compliance, std::int32_t mobile_nodes);

  /// Begins a tick: slots that are asked for from now on stay until the next one.
  void begin_tick() noexcept { ++tick_; }

  /// The slot of a mobile node; at most kSlots distinct nodes in a tick.
  int slot_of(SurfaceId node) noexcept {
    const int known = slot_of_node_[node], slot = known >= 0 ? known : enter(node);
    slots_[slot].used = tick_;
    return slot;
  }

  /// Three quarters of what a force on the node moves it beyond its neighbours, m/N: the dent's part that
  /// belongs to the tool which makes it (own_compliance below).
  double own_compliance(int slot) noexcept {
    const double own = slots_[slot].own;
    return own >= 0 ? own : find_own_compliance(slot);
  }

  SurfaceId node_at(int slot) const noexcept { return slots_[slot].node; }

  /// C_nk between two slots as the kernels read it: nine floats, column after column, and padding.
  const float* block(int n, int k) const noexcept { return blocks_ + n * kPitch + k * kStride; }

  /// sum[9]: the blocks between some slots and others, by both's weights.
  void combine(const kernels::Weighted& rows, const kernels::Weighted& columns, double* sum) const noexcept {
    kernels::combine_blocks(blocks_, kPitch, rows, columns, sum);
  }

 private:
  static constexpr std::ptrdiff_t kStride = 16;
  // one block more than slots: rows of a power-of-two pitch would share few cache sets
  static constexpr std::ptrdiff_t kPitch = (kSlots + 1) * kStride;

  int enter(SurfaceId node) noexcept;
  double find_own_compliance(int slot) noexcept;
  int free_slot() noexcept;
  void gather(int slot) noexcept;

  struct Slot {
    SurfaceId node;
    std::uint64_t used = 0;  // tick that asked for it last
    double own = -1;         // own_compliance, m/N; negative: not known yet
  };

  const NodeCompliance& compliance_;
  std::uint64_t tick_ = 0;
  std::array<Slot, kSlots> slots_;
  std::vector<std::int16_t> slot_of_node_;  // [mobile], -1
  std::vector<float> memory_;
  float* blocks_;  // [kSlots][kSlots][16], on cache lines
};

/// The mobile nodes that share a force at a material point, and their weights in it.
struct PointNodes {
  std::array<SurfaceId, 3> node;
  Vec3 weight = Vec3::Zero();
  int count = 0;
};

/// The same by slots, without those of no weight.
struct Share {
  std::array<int, 3> slot;
  Vec3 weight;
  int count = 0;
};

/// Asks for the nodes' slots.
Share share_of(const PointNodes& at, ContactNodes& nodes) noexcept;

/// W_ij = sum_a sum_b k_a k_b C_ab over the vertices a of one contact and b of the other, m/N.
void find_compliance(const ContactNodes& nodes, const Share& i, const Share& j, Eigen::Matrix3d& W) noexcept;

/// What contacts of two tools do not share, as a scalar, m/N: sum_a k_a^i k_a^j c_a over their common nodes.
/// W_ij of one tool counts it, W_ij between two tools is less by it. A mesh knows one dent per node: two
/// tools on one facet would have a singular W, and whoever is deeper by a hair would take all. With its own
/// part
///     W = B^T (C - diag(c)) B + sum over tools of B_t^T diag(c) B_t
/// is symmetric and positive definite, however many tools meet, since c_a is less than what would make C -
/// diag(c) singular for equal nodes. Nothing changes for a tool that shares no node with another.
double own_compliance(ContactNodes& nodes, const Share& i, const Share& j) noexcept;

}  // namespace omentum::haptic
