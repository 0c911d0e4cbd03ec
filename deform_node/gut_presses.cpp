#include "deform_node/gut_presses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::deform {

namespace {

// Of dynamic relaxation: half of the way is right where the gut yields twice of what was thought, and safe up
// to four times; afterwards what was seen counts, down to twenty times.
constexpr double kFirstRelaxation = 0.5, kLeastRelaxation = 0.05;
// Strengths are found to this share.
constexpr double kAsWanted = 1e-4;

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
  presses_.reserve(kMostPatterns);
  lacking_.resize(kMostPatterns);
  next_.resize(kMostPatterns);
}

void GutPresses::press(std::span<const ToolLoad> presses, std::span<const Vec3> places,
                       std::span<const Vec3> x) noexcept {
  held_.clear();
  presses_.clear();
  for (const ToolLoad& load : presses) {
    if (held_.size() == kMaxTools) break;
    HeldPress& held = held_.emplace_back();
    held.tool = load.tool;
    for (std::size_t i = 0; i < std::min<std::size_t>(load.nodes.size(), kMaxNodesPerTool); ++i) {
      const auto n = static_cast<std::size_t>(load.nodes[i]);
      // where the masses have to be together for this node to be where the hand has it
      const Vec3 offset = places[n] - weighted(skin_.node(load.nodes[i]), x);
      add(load.nodes[i], rest_[n] + load.displacements[i] - offset, load.forces[i], held);
    }
    held.grasps = load.grasps;
    pose(load.gain, held);
  }
  add_up();
}

void GutPresses::pose(double gain, HeldPress& held) noexcept {
  const physics::Press press{.nodes = {held.masses.data(), held.mass_count},
                             .displacements = {held.places.data(), held.mass_count},
                             .forces = {held.mass_forces.data(), held.mass_count},
                             .own_yield_j = held.own_yield_j,
                             .most_strength = gain * physics::Press::kMostStrength,
                             .already = 1};
  presses_.push_back(press);
  if (!held.grasps) return;
  held.find_sides();
  for (std::size_t side = 0; side < held.sides.size(); ++side) {
    physics::Press& aside = presses_.emplace_back(press);
    aside.forces = {held.side_forces[side].data(), held.mass_count};
    aside.most_strength = gain;
    aside.least_strength = -gain;
    aside.already = 0;
  }
}

void GutPresses::HeldPress::find_sides() noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += forces[i];
  if (sum.squaredNorm() > 0) sides = {sum.unitOrthogonal(), sum.cross(sum.unitOrthogonal()).normalized()};
  for (std::size_t side = 0; side < sides.size(); ++side)
    for (std::size_t m = 0; m < mass_count; ++m) side_forces[side][m] = mass_sizes[m] * sides[side];
}

void GutPresses::add(NodeId node, const Vec3& middle, const Vec3& force, HeldPress& held) noexcept {
  held.nodes[held.count] = node;
  held.forces[held.count++] = force;
  held.own_yield_j += wall_m_n_ * force.squaredNorm();
  const Vec3 place = middle - wall_m_n_ * force;
  const geometry::GutSkin::Node& of = skin_.node(node);
  for (std::size_t k = 0; k < geometry::GutSkin::kMostWeights; ++k) {
    if (of.weight[k] == 0) continue;
    held.masses[held.mass_count] = NodeId(std::int32_t{of.mass[k]});
    held.places[held.mass_count] = place;
    held.mass_sizes[held.mass_count] = of.weight[k] * force.norm();
    held.mass_forces[held.mass_count++] = of.weight[k] * force;
  }
}

void GutPresses::forget() noexcept {
  held_.clear();
  presses_.clear();
  add_up();
}

void GutPresses::act(std::span<const double> strengths) noexcept {
  for (std::size_t i = 0; i < presses_.size(); ++i) presses_[i].already = strengths[i];
  std::size_t p = 0;
  for (HeldPress& held : held_) {
    held.strength = strengths[p++];
    held.aside.setZero();
    if (!held.grasps) continue;
    for (const Vec3& side : held.sides) held.aside += strengths[p++] * side;
  }
  add_up();
}

void GutPresses::act(double strength) noexcept {
  std::size_t p = 0;
  for (const HeldPress& held : held_) {
    next_[p++] = strength;
    for (std::size_t side = 0; held.grasps && side < held.sides.size(); ++side) next_[p++] = 0;
  }
  act(std::span<const double>(next_).first(p));
}

bool GutPresses::approach(std::span<const double> strengths, bool first) noexcept {
  double along = 0, squared = 0, most = 0;
  for (std::size_t p = 0; p < presses_.size(); ++p) {
    const double lacking = strengths[p] - presses_[p].already, change = lacking - lacking_[p];
    along += lacking_[p] * change;
    squared += change * change;
    most = std::max(most, std::abs(lacking));
    lacking_[p] = lacking;
  }
  if (most < kAsWanted) return false;
  relaxation_ = first || squared == 0 ? kFirstRelaxation
                                      : std::clamp(-relaxation_ * along / squared, kLeastRelaxation, 1.0);
  for (std::size_t p = 0; p < presses_.size(); ++p)
    next_[p] = std::clamp(presses_[p].already + relaxation_ * lacking_[p], presses_[p].least_strength,
                          presses_[p].most_strength);
  act(std::span<const double>(next_).first(presses_.size()));
  return true;
}

bool GutPresses::are_as_said(double share) const noexcept {
  return std::ranges::all_of(held_, [share](const HeldPress& held) {
    return std::abs(held.strength - 1) < share && held.aside.norm() < share;
  });
}

void GutPresses::add_up() noexcept {
  std::ranges::fill(forces_, Vec3::Zero());
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.mass_count; ++i)
      forces_[static_cast<std::size_t>(held.masses[i])] +=
          held.strength * held.mass_forces[i] + held.mass_sizes[i] * held.aside;
}

Vec3 GutPresses::of_tool(std::uint32_t tool, NodeId n) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.count; ++i)
      if (held.tool == tool && held.nodes[i] == n) sum += held.force(i);
  return sum;
}

bool GutPresses::any_grasps() const noexcept {
  return std::ranges::any_of(held_, &HeldPress::grasps);
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
    return held.tool == tool && held.grasps && std::find(held.nodes.begin(), end, n) != end;
  });
}

void GutPresses::dent(std::span<Vec3> places) const noexcept {
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.count; ++i)
      places[static_cast<std::size_t>(held.nodes[i])] += wall_m_n_ * held.force(i);
}

}  // namespace omentum::deform
