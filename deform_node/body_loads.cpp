#include "deform_node/body_loads.h"

#include "deform_node/contact_book.h"

#include <algorithm>

namespace omentum::deform {

using geometry::MeshEditor;
using geometry::TetId;

BodyLoads::BodyLoads(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
                     const Vec3& gravity_m_s2)
    : mesh_(mesh),
      gravity_(gravity_m_s2),
      uncut_kg_(mesh.positions.size()),
      external_(3 * mesh.positions.size()),
      pressed_(mesh.positions.size(), Vec3::Zero()) {
  quarter_kg_.reserve(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    const auto& x = mesh.positions;
    quarter_kg_.push_back(material.of(mesh, TetId(t)).density_kg_m3 *
                          geometry::signed_volume(x[a], x[b], x[c], x[d]) / 4);
    for (const NodeId n : mesh.tetrahedra[t]) uncut_kg_[n] += quarter_kg_.back();
  }
  presses_.reserve(kMaxLoadedNodes);
  restore();
}

void BodyLoads::weigh(NodeId n) noexcept {
  Eigen::Map<Vec3>(external_.data() + 3 * n) = carried_kg_[n] * gravity_ + pressed_[n];
}

Vec3 BodyLoads::of_tool(std::uint32_t tool, NodeId n) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const Press& press : presses_)
    if (press.tool == tool && press.node == n) sum += press.force;
  return sum;
}

void BodyLoads::press(std::span<const ToolLoad> presses, const MeshEditor& editor) noexcept {
  for (const Press& last : presses_) {
    pressed_[last.node].setZero();
    weigh(last.node);
  }
  presses_.clear();
  for (const ToolLoad& load : presses) {
    for (std::size_t i = 0; i < load.nodes.size(); ++i) {
      const NodeId n = load.nodes[i];
      if (editor.uses(n) == 0 || presses_.size() == kMaxLoadedNodes) continue;
      presses_.push_back({load.tool, n, load.forces[i]});
      pressed_[n] += load.forces[i];
      weigh(n);
    }
  }
}

void BodyLoads::lighten(std::span<const TetId> gone, const MeshEditor& editor) noexcept {
  for (const TetId t : gone) {
    for (const NodeId n : mesh_.tetrahedra[t]) {
      // nothing, not what rounding leaves of it
      carried_kg_[n] = editor.uses(n) == 0 ? 0 : carried_kg_[n] - quarter_kg_[t];
      if (editor.uses(n) == 0) pressed_[n].setZero();
      weigh(n);
    }
  }
}

void BodyLoads::restore() noexcept {
  carried_kg_ = uncut_kg_;
  std::ranges::fill(pressed_, Vec3::Zero());
  presses_.clear();
  for (std::size_t n = 0; n < uncut_kg_.size(); ++n) weigh(NodeId(n));
}

}  // namespace omentum::deform
