// What the other nodes of a block's session would say of it.
#pragma once

#include "organ/organ.h"
#include "transport/bus.h"

#include "tests/support/block_scene.h"

#include <algorithm>
#include <memory>

namespace omentum::render::test {

using geometry::Vec3;
using namespace omentum::test;

/// The whole state in one block: nodes at the top moved by `u`, those below by their share of it.
inline msg::OrganState state_of(const organ::Organ& organ, std::uint64_t seq, const Vec3& u) {
  msg::OrganState state{};
  state.block_count = 1;
  state.seq = seq;
  state.stamp_ns = static_cast<std::int64_t>(seq);
  state.node_count = static_cast<std::uint32_t>(organ.surface.node_count());
  state.echoes = {{.tool = 0, .seq = 100 + seq, .stamp_ns = 5000}};
  for (const geometry::NodeId n : organ.surface.node) {
    const double share = organ.mesh.positions[n].z() / 0.1;
    for (int c = 0; c < 3; ++c) state.values.push_back(static_cast<float>(share * u[c]));
  }
  return state;
}

/// A tool that presses the middle of the block's upper face.
class PressingTool {
 public:
  PressingTool(transport::Bus& bus, const organ::Organ& organ)
      : poses_(bus.writer<msg::ToolPose>()),
        forces_(bus.writer<msg::ToolForce>()),
        contacts_(bus.writer<msg::Contact>()) {
    pose_.valid = true;
    pose_.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    force_.force = {0, 0, 1};
    const auto& nodes = organ.surface.node;
    const auto to_middle = [&](geometry::NodeId n) {
      return (organ.mesh.positions[n] - Vec3(0.05, 0.05, 0.1)).norm();
    };
    const auto top = *std::min_element(nodes.begin(), nodes.end(),
                                       [&](auto a, auto b) { return to_middle(a) < to_middle(b); });
    const Vec3& p = organ.mesh.positions[top];
    pose_.position = {p.x(), p.y(), p.z()};
    contact_.nodes = {static_cast<std::uint32_t>(organ.mesh.file_node[top])};
    contact_.forces = {{0, 0, -1}};
    contact_.displacements = {{0, 0, -0.01}};
  }
  void speak() {
    ++pose_.seq, ++force_.seq, ++contact_.seq;
    poses_->write(pose_);
    forces_->write(force_);
    contacts_->write(contact_);
  }

 private:
  std::unique_ptr<transport::Writer<msg::ToolPose>> poses_;
  std::unique_ptr<transport::Writer<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Writer<msg::Contact>> contacts_;
  msg::ToolPose pose_{};
  msg::ToolForce force_{};
  msg::Contact contact_{};
};

}  // namespace omentum::render::test
