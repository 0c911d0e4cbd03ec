#include "deform_node/body_loads.h"

#include "physics/dynamics/body_state.h"

#include <algorithm>

namespace omentum::deform {

using geometry::MeshEditor;
using geometry::TetId;

BodyLoads::BodyLoads(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
                     const Vec3& gravity_m_s2)
    : mesh_(mesh),
      organ_gravity_(gravity_m_s2),
      tissue_(mesh, material, physics::lumped_masses(mesh, material)),
      is_bare_(mesh.positions.size()),
      weights_(3 * mesh.positions.size()),
      external_(weights_.size()),
      pressed_(mesh.positions.size(), Vec3::Zero()) {
  gravity_.resize(mesh.positions.size());
  held_.reserve(kMaxTools);
  presses_.reserve(kMaxTools);
  restore();
}

physics::Press BodyLoads::HeldPress::press() const noexcept {
  return {.nodes = {nodes.data(), count},
          .displacements = {displacements.data(), count},
          .forces = {forces.data(), count},
          .most_strength = gain * physics::Press::kMostStrength};
}

void BodyLoads::weigh(NodeId n) noexcept {
  const Vec3 weight = is_bare_[n] ? Vec3::Zero().eval() : Vec3(tissue_.kg()[n] * gravity_[n]);
  Vec3::Map(&weights_[3 * n]) = weight;
  Vec3::Map(&external_[3 * n]) = weight + pressed_[n];
}

Vec3 BodyLoads::of_tool(std::uint32_t tool, NodeId n) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const HeldPress& held : held_)
    for (std::size_t i = 0; i < held.count; ++i)
      if (held.tool == tool && held.nodes[i] == n) sum += held.strength * held.forces[i];
  return sum;
}

std::span<const NodeId> BodyLoads::held_by(std::uint32_t tool) const noexcept {
  const auto holds = [tool](const HeldPress& held) { return held.tool == tool && held.grasps; };
  const auto found = std::ranges::find_if(held_, holds);
  return found == held_.end() ? std::span<const NodeId>() : std::span(found->nodes).first(found->count);
}

void BodyLoads::press(std::span<const ToolLoad> presses, const MeshEditor& editor) noexcept {
  forget_presses();
  for (const ToolLoad& load : presses) {
    if (held_.size() == kMaxTools) break;
    HeldPress& held = held_.emplace_back();
    held.tool = load.tool;
    held.grasps = load.grasps;
    held.gain = load.gain;
    held.count = std::min<std::size_t>(load.nodes.size(), kMaxNodesPerTool);
    std::copy_n(load.nodes.begin(), held.count, held.nodes.begin());
    std::copy_n(load.displacements.begin(), held.count, held.displacements.begin());
    std::copy_n(load.forces.begin(), held.count, held.forces.begin());
    keep_attached(held, editor);
    presses_.push_back(held.press());
    for (std::size_t i = 0; i < held.count; ++i) pressed_[held.nodes[i]] += held.forces[i];
    for (std::size_t i = 0; i < held.count; ++i) weigh(held.nodes[i]);
  }
}

void BodyLoads::act(std::span<const double> strengths) noexcept {
  for (std::size_t p = 0; p < held_.size(); ++p) {
    HeldPress& held = held_[p];
    for (std::size_t i = 0; i < held.count; ++i) {
      pressed_[held.nodes[i]] += (strengths[p] - held.strength) * held.forces[i];
      weigh(held.nodes[i]);
    }
    held.strength = strengths[p];
  }
}

void BodyLoads::carry(std::span<const double> forces, const MeshEditor& editor) noexcept {
  for (std::size_t c = 0; c < forces.size(); ++c) {
    if (editor.uses(NodeId(c / 3)) == 0) continue;
    weights_[c] += forces[c];
    external_[c] += forces[c];
  }
}

void BodyLoads::put_down() noexcept {
  for (std::size_t n = 0; n < gravity_.size(); ++n) weigh(NodeId(n));
}

void BodyLoads::forget_presses() noexcept {
  for (const HeldPress& held : held_) {
    for (std::size_t i = 0; i < held.count; ++i) {
      pressed_[held.nodes[i]].setZero();
      weigh(held.nodes[i]);
    }
  }
  held_.clear();
  presses_.clear();
}

void BodyLoads::keep_attached(HeldPress& held, const MeshEditor& editor) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < held.count; ++i) {
    if (editor.uses(held.nodes[i]) == 0) continue;
    held.nodes[kept] = held.nodes[i];
    held.displacements[kept] = held.displacements[i];
    held.forces[kept++] = held.forces[i];
  }
  held.count = kept;
}

void BodyLoads::lighten(std::span<const TetId> gone, const MeshEditor& editor) noexcept {
  tissue_.remove(gone);
  for (const TetId t : gone) {
    for (const NodeId n : mesh_.tetrahedra[t]) {
      is_bare_[n] = editor.uses(n) == 0;
      if (is_bare_[n]) pressed_[n].setZero();
      weigh(n);
    }
  }
  for (std::size_t p = 0; p < held_.size(); ++p) {
    keep_attached(held_[p], editor);
    presses_[p] = held_[p].press();
  }
}

void BodyLoads::let_go(std::span<const TetId> tetrahedra, const Vec3& gravity_m_s2) noexcept {
  for (const TetId t : tetrahedra) {
    for (const NodeId n : mesh_.tetrahedra[t]) {
      gravity_[n] = gravity_m_s2;
      weigh(n);
    }
  }
}

void BodyLoads::restore() noexcept {
  std::ranges::fill(gravity_, organ_gravity_);
  forget_presses();
  tissue_.restore();
  std::fill(is_bare_.begin(), is_bare_.end(), false);
  put_down();
}

}  // namespace omentum::deform
