#include "haptic_node/contact_nodes.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <memory>

namespace omentum::haptic {

static_assert(kernels::kBlockStride == 16);

namespace {
// A contact that slides back and forth over an edge comes back within this.
constexpr std::uint64_t kKeepTicks = 50;
// Of what a node moves beyond its neighbours: all of it would leave two equal nodes nothing but their sum.
constexpr double kOwnPart = 0.75;
}  // namespace

ContactNodes::ContactNodes(const NodeCompliance& compliance, std::int32_t mobile_nodes)
    : compliance_(compliance),
      slot_of_node_(static_cast<std::size_t>(mobile_nodes), -1),
      memory_(kSlots * kPitch + kStride, 0.0f) {
  constexpr std::size_t kLine = 64;
  void* begin = memory_.data();
  std::size_t size = memory_.size() * sizeof(float);
  blocks_ = static_cast<float*>(std::align(kLine, size - kLine, begin, size));
}

int ContactNodes::enter(SurfaceId node) noexcept {
  const int slot = free_slot();
  if (slots_[slot].node.valid()) slot_of_node_[slots_[slot].node] = -1;
  slots_[slot].node = node;
  slots_[slot].own = -1;
  slot_of_node_[node] = static_cast<std::int16_t>(slot);
  gather(slot);
  return slot;
}

// The first one that was not needed lately: slots in use then lie close together in memory.
int ContactNodes::free_slot() noexcept {
  int oldest = 0;
  for (int s = 0; s < kSlots; ++s) {
    if (!slots_[s].node.valid() || slots_[s].used + kKeepTicks < tick_) return s;
    if (slots_[s].used < slots_[oldest].used) oldest = s;
  }
  geometry::require(slots_[oldest].used < tick_, "at most kSlots nodes in contact");
  return oldest;
}

void ContactNodes::gather(int slot) noexcept {
  const SurfaceId k = slots_[slot].node;
  for (int s = 0; s < kSlots; ++s) {
    if (!slots_[s].node.valid()) continue;
    // C is symmetric as a whole: the new column serves both blocks
    const Eigen::Matrix3f C_nk = compliance_.block(slots_[s].node, k);
    Eigen::Map<Eigen::Matrix3f>(blocks_ + s * kPitch + slot * kStride) = C_nk;
    Eigen::Map<Eigen::Matrix3f>(blocks_ + slot * kPitch + s * kStride) = C_nk.transpose();
  }
}

double ContactNodes::find_own_compliance(int slot) noexcept {
  return slots_[slot].own = kOwnPart * compliance_.beyond_neighbours(slots_[slot].node);
}

Share share_of(const PointNodes& at, ContactNodes& nodes) noexcept {
  Share share;
  for (int v = 0; v < at.count; ++v) {
    if (at.weight[v] <= 0) continue;
    share.slot[share.count] = nodes.slot_of(at.node[v]);
    share.weight[share.count++] = at.weight[v];
  }
  return share;
}

double own_compliance(ContactNodes& nodes, const Share& i, const Share& j) noexcept {
  double sum = 0;
  for (int a = 0; a < i.count; ++a) {
    for (int b = 0; b < j.count; ++b) {
      if (i.slot[a] == j.slot[b]) sum += i.weight[a] * j.weight[b] * nodes.own_compliance(i.slot[a]);
    }
  }
  return sum;
}

void find_compliance(const ContactNodes& nodes, const Share& i, const Share& j, Eigen::Matrix3d& W) noexcept {
  nodes.combine({i.slot.data(), i.weight.data(), i.count}, {j.slot.data(), j.weight.data(), j.count},
                W.data());
}

}  // namespace omentum::haptic
