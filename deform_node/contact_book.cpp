#include "deform_node/contact_book.h"

#include "node/vectors.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

using node::to_vector;

double staleness_gain(double age_s) noexcept {
  return std::clamp(1.0 - (age_s - kContactStaleS) / kContactFadeS, 0.0, 1.0);
}

const char* describe(Rejection rejection) noexcept {
  switch (rejection) {
    case Rejection::kNone:
      return "contact accepted";
    case Rejection::kTool:
      return "contact dropped: tool number out of range";
    case Rejection::kOrgan:
      return "contact dropped: no such organ in this scene";
    case Rejection::kTopologyVersion:
      return "contact dropped: of another topology version";
    case Rejection::kLengths:
      return "contact dropped: nodes, displacements and forces differ in number";
    case Rejection::kNode:
      return "contact dropped: node that is not on the surface";
    case Rejection::kNotFinite:
      return "contact dropped: a force or displacement is not finite";
  }
  return "contact dropped";
}

Rejection check_contact(const msg::Contact& contact, const std::vector<OrganNumbers>& organs,
                        HeldContact& held) noexcept {
  if (contact.tool >= static_cast<std::uint32_t>(kMaxTools)) return Rejection::kTool;
  if (contact.organ >= organs.size()) return Rejection::kOrgan;
  const OrganNumbers& organ = organs[contact.organ];
  if (contact.topology_version != organ.topology_version) return Rejection::kTopologyVersion;
  const std::size_t count = contact.nodes.size();
  if (count > static_cast<std::size_t>(kMaxNodesPerTool) || contact.displacements.size() != count ||
      contact.forces.size() != count)
    return Rejection::kLengths;
  held.organ = contact.organ;
  held.cause = contact.cause;
  held.count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (contact.nodes[i] >= organ.surface_of_file_node.size()) return Rejection::kNode;
    const SurfaceId node = organ.surface_of_file_node[contact.nodes[i]];
    if (!node.valid()) return Rejection::kNode;
    const Vec3 force = to_vector(contact.forces[i]);
    const Vec3 displacement = to_vector(contact.displacements[i]);
    if (!force.allFinite() || !displacement.allFinite()) return Rejection::kNotFinite;
    if (node >= organ.mobile_count) continue;
    held.nodes[held.count] = node;
    held.forces[held.count] = force;
    held.displacements[held.count] = displacement;
    ++held.count;
  }
  return Rejection::kNone;
}

ContactBook::ContactBook(std::vector<OrganNumbers> organs, runtime::FaultList& faults)
    : organs_(std::move(organs)), faults_(faults) {}

void ContactBook::take(const msg::Contact& contact, std::int64_t now_ns) noexcept {
  const Rejection rejection = check_contact(contact, organs_, draft_);
  if (rejection != Rejection::kNone) {
    faults_.raise(describe(rejection));
    return;
  }
  draft_.received_ns = now_ns;
  newest_[contact.tool].post(draft_);
}

void ContactBook::advance(std::int64_t now_ns) noexcept {
  echo_count_ = 0;
  for (int tool = 0; tool < kMaxTools; ++tool) {
    newest_[tool].fetch();
    const HeldContact& held = newest_[tool].value();
    gain_[tool] = 0;
    if (held.received_ns == 0) continue;
    echoes_[echo_count_++] = held.cause;
    if (held.received_ns <= forget_until_ns_) continue;
    gain_[tool] = staleness_gain(1e-9 * static_cast<double>(now_ns - held.received_ns));
    for (int i = 0; i < held.count; ++i) faded_forces_[tool][i] = gain_[tool] * held.forces[i];
  }
}

std::span<const ToolLoad> ContactBook::loads(std::uint32_t organ) noexcept {
  std::size_t count = 0;
  for (int tool = 0; tool < kMaxTools; ++tool) {
    const HeldContact& held = newest_[tool].value();
    if (gain_[tool] <= 0 || held.organ != organ || held.count == 0) continue;
    const auto size = static_cast<std::size_t>(held.count);
    loads_[count++] = {.tool = static_cast<std::uint32_t>(tool),
                       .nodes = {held.nodes.data(), size},
                       .displacements = {held.displacements.data(), size},
                       .forces = {faded_forces_[tool].data(), size}};
  }
  return {loads_.data(), count};
}

}  // namespace omentum::deform
