// C_AA of the nodes in contact, kept between ticks: only nodes that enter are gathered.
#pragma once

#include "haptic_node/cluster_kernels.h"
#include "haptic_node/deformed_surface.h"

#include <vector>

namespace omentum::haptic {

/// Slots for contact nodes with the 3x3 blocks between all of them. A node that left keeps its slot for some
/// ticks, so that a contact that slides back and forth over an edge gathers nothing.
///
/// No allocation after construction. One thread at a time. The compliance must outlive it.
class ContactNodes {
 public:
  static constexpr int kSlots = DeformedSurface::kMaxForces;

  explicit ContactNodes(const physics::SurfaceCompliance& compliance);

  /// Begins a tick: slots that are asked for from now on stay until the next one.
  void begin_tick() noexcept { ++tick_; }

  /// The slot of a mobile node; at most kSlots distinct nodes in a tick.
  int slot_of(SurfaceId node) noexcept;

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

  int free_slot() noexcept;
  void gather(int slot) noexcept;

  struct Slot {
    SurfaceId node;
    std::uint64_t used = 0;  // tick that asked for it last
  };

  const physics::SurfaceCompliance& compliance_;
  std::uint64_t tick_ = 0;
  std::array<Slot, kSlots> slots_;
  std::vector<std::int16_t> slot_of_node_;  // [mobile], -1
  std::vector<float> memory_;
  float* blocks_;  // [kSlots][kSlots][16], on cache lines
};

/// A contact's share of three nodes: where a force at a material point acts, pinned vertices left out.
struct Share {
  std::array<int, 3> slot;
  Vec3 weight;
  int count = 0;
};

/// The share of a material point; asks for its vertices' slots.
Share share_of(const geometry::Surface& surface, const SurfacePoint& point, ContactNodes& nodes) noexcept;

/// W_ij = sum_a sum_b k_a k_b C_ab over the vertices a of one contact and b of the other, m/N.
void find_compliance(const ContactNodes& nodes, const Share& i, const Share& j, Eigen::Matrix3d& W) noexcept;

}  // namespace omentum::haptic
