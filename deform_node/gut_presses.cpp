#include "deform_node/gut_presses.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

namespace {

std::size_t mass_count(const geometry::GutSkin& skin) {
  std::int32_t most = 0;
  for (std::size_t n = 0; n < skin.node_count(); ++n)
    for (const geometry::MassId m : skin.node(NodeId(n)).mass) most = std::max<std::int32_t>(most, m);
  return static_cast<std::size_t>(most) + 1;
}

}  // namespace

GutPresses::GutPresses(const geometry::GutSkin& skin, std::vector<Vec3> rest, double wall_m_n)
    : skin_(skin), rest_(std::move(rest)), wall_m_n_(wall_m_n), forces_(mass_count(skin), Vec3::Zero()) {
  held_.reserve(kMaxTools);
  presses_.reserve(kMaxTools);
}

void GutPresses::press(std::span<const ToolLoad> presses, std::span<const Vec3> places,
                       std::span<const Vec3> x) noexcept {
  held_.clear();
  presses_.clear();
  for (const ToolLoad& load : presses) {
    if (held_.size() == kMaxTools) break;
    HeldPress& held = held_.emplace_back();
    held.tool = load.tool;
    held.grasping = load.grasping;
    for (std::size_t i = 0; i < std::min<std::size_t>(load.nodes.size(), kMaxNodesPerTool); ++i) {
      const auto n = static_cast<std::size_t>(load.nodes[i]);
      // where the masses have to be together for this node to be where the hand has it
      const Vec3 offset = places[n] - weighted(skin_.node(load.nodes[i]), x);
      add(load.nodes[i], rest_[n] + load.displacements[i] - offset, load.forces[i], held);
    }
    presses_.push_back({.nodes = {held.masses.data(), held.mass_count},
                        .displacements = {held.places.data(), held.mass_count},
                        .forces = {held.mass_forces.data(), held.mass_count},
                        .own_yield_j = held.own_yield_j,
                        .most_strength = load.gain * physics::Press::kMostStrength});
  }
  add_up();
}

void GutPresses::add(NodeId node, const Vec3& middle, const Vec3& force, HeldPress& held) noexcept {
  held.nodes[held.count] = node;
  held.forces[held.count++] = force;
  held.own_yield_j += wall_m_n_ * force.squaredNorm();
  const geometry::GutSkin::Node& of = skin_.node(node);
  for (std::size_t k = 0; k < geometry::GutSkin::kMostWeights; ++k) {
    if (of.weight[k] == 0) continue;
    held.masses[held.mass_count] = NodeId(std::int32_t{of.mass[k]});
    held.places[held.mass_count] = middle;
    held.mass_forces[held.mass_count++] = of.weight[k] * force;
  }
}

void GutPresses::forget() noexcept {
  held_.clear();
  presses_.clear();
  add_up();
}

void GutPresses::act(std::span<const double> strengths) noexcept {
  for (std::size_t p = 0; p < held_.size(); ++p) held_[p].strength = strengths[p];
  add_up();
}

void GutPresses::act(double strength) noexcept {
  for (HeldPress& held : held_) held.strength = strength;
  add_up();
}

void GutPresses::add_up() noexcept {
  std::ranges::fill(forces_, Vec3::Zero());
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.mass_count; ++i)
      forces_[static_cast<std::size_t>(held.masses[i])] += held.strength * held.mass_forces[i];
}

Vec3 GutPresses::of_tool(std::uint32_t tool, NodeId n) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.count; ++i)
      if (held.tool == tool && held.nodes[i] == n) sum += held.strength * held.forces[i];
  return sum;
}

std::optional<Vec3> GutPresses::middle(std::uint32_t tool, std::span<const Vec3> places) const noexcept {
  Vec3 sum = Vec3::Zero();
  std::size_t count = 0;
  for (const HeldPress& held : held_) {
    if (held.tool != tool) continue;
    count += held.count;
    for (std::size_t i = 0; i < held.count; ++i) sum += places[static_cast<std::size_t>(held.nodes[i])];
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

bool GutPresses::grasps(std::uint32_t tool, NodeId n) const noexcept {
  return std::ranges::any_of(held_, [&](const HeldPress& held) {
    const auto end = held.nodes.begin() + static_cast<std::ptrdiff_t>(held.count);
    return held.tool == tool && held.grasping && std::find(held.nodes.begin(), end, n) != end;
  });
}

void GutPresses::dent(std::span<Vec3> places) const noexcept {
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.count; ++i)
      places[static_cast<std::size_t>(held.nodes[i])] += held.strength * wall_m_n_ * held.forces[i];
}

}  // namespace omentum::deform
