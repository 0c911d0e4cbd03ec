#include "deform_node/contact_book.h"

#include "deform_node/contact_reach.h"
#include "node_common/contact_bounds.h"
#include "node_common/vectors.h"

#include <algorithm>

namespace omentum::deform {

using node::to_vector;

double staleness_gain(double age_s) noexcept {
  return std::clamp(1.0 - (age_s - kContactStale_s) / kContactFade_s, 0.0, 1.0);
}

const char* describe(Rejection rejection) noexcept {
  switch (rejection) {
    case Rejection::kNone:
      return "contact accepted";
    case Rejection::kTool:
      return "contact dropped: tool that the scene does not have";
    case Rejection::kOrgan:
      return "contact dropped: no such organ in this scene";
    case Rejection::kTopologyVersion:
      return "contact dropped: of another topology version";
    case Rejection::kLengths:
      return "contact dropped: nodes, displacements and forces differ in number";
    case Rejection::kNode:
      return "contact dropped: node that is not on the surface";
    case Rejection::kForce:
      return "contact dropped: forces beyond what the scene's tools exert, or not finite";
    case Rejection::kReach:
      return "contact dropped: moves the organ farther than its own size, or not finite";
    case Rejection::kEdge:
      return "contact dropped: cutting edge that is not finite, or outside of any scene";
  }
  return "contact dropped";
}

ContactBounds bounds_of(const scene::Scene& scene) {
  ContactBounds bounds{.tools = 0, .max_force_n = scene.haptics.max_force_n};
  for (const scene::ToolSpec& tool : scene.tools)
    if (tool.id < msg::MAX_TOOLS) bounds.tools |= 1u << tool.id;
  return bounds;
}

namespace {

bool in_a_scene(const msg::Edge& edge) noexcept {
  constexpr double kFarthest_m = 1000;
  const auto is_near = [](const msg::Vec3& p) { return to_vector(p).cwiseAbs().maxCoeff() <= kFarthest_m; };
  return to_vector(edge.begin).allFinite() && to_vector(edge.end).allFinite() && is_near(edge.begin) &&
         is_near(edge.end);
}

// What the contact says of itself, without a look at its nodes.
Rejection check_claims(const msg::Contact& contact, const std::vector<OrganNumbers>& organs,
                       const ContactBounds& bounds) noexcept {
  if (contact.tool >= static_cast<std::uint32_t>(kMaxTools) || !(bounds.tools >> contact.tool & 1u) ||
      contact.cause.tool != contact.tool)
    return Rejection::kTool;
  if (contact.organ >= organs.size()) return Rejection::kOrgan;
  const std::size_t count = contact.nodes.size();
  if (count > static_cast<std::size_t>(kMaxNodesPerTool) || contact.displacements.size() != count ||
      contact.forces.size() != count)
    return Rejection::kLengths;
  if (!node::within_scene(node::total_force_n(contact), bounds.max_force_n)) return Rejection::kForce;
  for (const msg::Vec3& u : contact.displacements)
    if (!(to_vector(u).norm() <= organs[contact.organ].reach_m)) return Rejection::kReach;
  if (!in_a_scene(contact.edge_before) || !in_a_scene(contact.edge)) return Rejection::kEdge;
  return Rejection::kNone;
}

Rejection translate(const msg::Contact& contact, const OrganNumbers& organ, HeldContact& held) noexcept {
  held.cause = contact.cause;
  held.grasps = contact.grasping;
  held.count = 0;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    if (contact.nodes[i] >= organ.node_of_file.size()) return Rejection::kNode;
    const NodeId node = organ.node_of_file[contact.nodes[i]];
    if (!node.valid() || (organ.compliance && !organ.surface_of_node[node].valid())) return Rejection::kNode;
    if (organ.pinned[node]) continue;
    held.nodes[held.count] = node;
    held.forces[held.count] = to_vector(contact.forces[i]);
    held.displacements[held.count] = to_vector(contact.displacements[i]);
    ++held.count;
  }
  return Rejection::kNone;
}

// Of an organ with tensors, m.
double moved_by(const HeldContact& held, const OrganNumbers& organ) noexcept {
  const auto count = static_cast<std::size_t>(held.count);
  std::array<SurfaceId, kMaxNodesPerTool> nodes;
  for (std::size_t i = 0; i < count; ++i) nodes[i] = organ.surface_of_node[held.nodes[i]];
  return largest_displacement_m(*organ.compliance, {nodes.data(), count}, {held.forces.data(), count});
}

}  // namespace

Rejection check_contact(const msg::Contact& contact, const std::vector<OrganNumbers>& organs,
                        const ContactBounds& bounds, HeldContact& held) noexcept {
  Rejection rejection = check_claims(contact, organs, bounds);
  if (rejection != Rejection::kNone) return rejection;
  const OrganNumbers& organ = organs[contact.organ];
  rejection = translate(contact, organ, held);
  if (rejection != Rejection::kNone || organ.compliance == nullptr) return rejection;
  return moved_by(held, organ) <= organ.reach_m ? Rejection::kNone : Rejection::kReach;
}

bool SentBeforeReset::take(const msg::Contact& contact, const TopologyVersions& versions,
                           std::int64_t now_ns) noexcept {
  const std::uint64_t oldest = versions.oldest.load(std::memory_order_relaxed);
  if (contact.topology_version >= oldest) return false;
  if (oldest != oldest_) {
    oldest_ = oldest;
    first_ns_ = now_ns;
  }
  return 1e-9 * static_cast<double>(now_ns - first_ns_) <= kContactStale_s;
}

ContactBook::ContactBook(std::vector<OrganNumbers> organs, const ContactBounds& bounds,
                         runtime::FaultList& faults)
    : organs_(std::move(organs)), bounds_(bounds), faults_(faults) {
  for (std::size_t i = 0; i < organs_.size(); ++i) pages_.push_back(std::make_unique<OrganPages>());
}

void ContactBook::take(const msg::Contact& contact, std::int64_t now_ns) noexcept {
  const Rejection rejection = check_contact(contact, organs_, bounds_, draft_);
  if (rejection != Rejection::kNone) {
    faults_.raise(describe(rejection));
    return;
  }
  OrganPages& pages = *pages_[contact.organ];
  pages.cuts.take(contact, now_ns);
  if (!pages.versions.hold(contact)) {
    if (!pages.late.take(contact, pages.versions, now_ns))
      faults_.raise(describe(Rejection::kTopologyVersion));
    return;
  }
  draft_.received_ns = now_ns;
  pages.tools[contact.tool].newest.post(draft_);
}

void ContactBook::now_at(std::uint32_t organ, std::uint64_t topology_version) noexcept {
  pages_[organ]->versions.newest.store(topology_version, std::memory_order_relaxed);
}

void ContactBook::begins_at(std::uint32_t organ, std::uint64_t topology_version) noexcept {
  pages_[organ]->versions.oldest.store(topology_version, std::memory_order_relaxed);
  now_at(organ, topology_version);
}

void ContactBook::forget(std::int64_t now_ns) noexcept {
  forget_until_ns_ = now_ns;
  forget_cuts(now_ns);
}

void ContactBook::forget_cuts(std::int64_t now_ns) noexcept {
  for (const auto& organ : pages_) organ->cuts.forget(now_ns);
}

void ContactBook::advance(std::int64_t now_ns) noexcept {
  for (const auto& organ : pages_) {
    organ->cuts.advance(now_ns);
    for (Page& page : organ->tools) advance(page, now_ns);
  }
  gather_echoes();
}

void ContactBook::advance(Page& page, std::int64_t now_ns) noexcept {
  page.newest.fetch();
  const HeldContact& held = page.newest.value();
  page.gain = 0;
  if (held.received_ns == 0 || held.received_ns <= forget_until_ns_) return;
  page.gain = staleness_gain(1e-9 * static_cast<double>(now_ns - held.received_ns));
  for (int i = 0; i < held.count; ++i) page.faded_forces[i] = page.gain * held.forces[i];
}

void ContactBook::gather_echoes() noexcept {
  echo_count_ = 0;
  for (std::size_t tool = 0; tool < kMaxTools; ++tool) {
    const HeldContact* newest = nullptr;
    for (const auto& organ : pages_) {
      const HeldContact& held = organ->tools[tool].newest.value();
      if (held.received_ns != 0 && (!newest || held.received_ns > newest->received_ns)) newest = &held;
    }
    if (newest) echoes_[echo_count_++] = newest->cause;
  }
}

std::span<const CutStroke> ContactBook::cuts(std::uint32_t organ) const noexcept {
  return pages_[organ]->cuts.strokes();
}

std::span<const ToolLoad> ContactBook::loads(std::uint32_t organ) noexcept {
  OrganPages& pages = *pages_[organ];
  std::size_t count = 0;
  for (std::uint32_t tool = 0; tool < kMaxTools; ++tool) {
    const Page& page = pages.tools[tool];
    const HeldContact& held = page.newest.value();
    if (page.gain <= 0 || held.count == 0) continue;
    const auto size = static_cast<std::size_t>(held.count);
    pages.loads[count++] = {.tool = tool,
                            .nodes = {held.nodes.data(), size},
                            .displacements = {held.displacements.data(), size},
                            .forces = {page.faded_forces.data(), size},
                            .gain = page.gain,
                            .grasps = held.grasps};
  }
  return {pages.loads.data(), count};
}

}  // namespace omentum::deform
