// A block as an organ, and what the other nodes of its session would say of it.
#pragma once

#include "node_common/loaded_scene.h"
#include "organ/build_organ.h"
#include "transport/bus.h"

#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <algorithm>
#include <memory>

namespace omentum::render::test {

using geometry::Vec3;
using namespace omentum::test;

/// A block of 10 cm, held at z = 0, and a scene around it.
class BlockScene {
 public:
  BlockScene() {
    const geometry::TetraMesh mesh = test::make_box_mesh(3, 3, 3, Vec3::Constant(0.1));
    organ::FixedComponents fixed(mesh.positions.size(), 0);
    for (std::size_t n = 0; n < fixed.size(); ++n) {
      if (mesh.positions[n].z() < 0.001) fixed[n] = 7;
    }
    organ_ = organ::make_organ("block", mesh, {.young_pa = 1e4, .poisson = 0.45, .density_kg_m3 = 1000},
                               fixed, organ::Storage::kFloat);
    organ::build_organ(organ_, folder_ / "block.h5", {});
    std::ofstream(scene())
        << "name = \"a block\"\n"
           "[[organs]]\nname = \"block\"\nmesh = \"block.msh\"\nfile = \"block.h5\"\n"
           "young_pa = 10000\npoisson = 0.45\ndensity_kg_m3 = 1000\nfixed = \"plane:z<0.001\"\n"
           "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
  }
  std::string scene() const { return folder_ / "scene.toml"; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const organ::Organ& organ() const { return organ_; }
  /// What a deform_node tells that serves this scene with the organ file of that hash.
  msg::SceneInfo info(const std::string& organ_hash) const {
    const scene::Scene loaded = scene::load_scene(scene());
    return node::to_message(node::loaded_scene(loaded, {{.name = "block", .hash = organ_hash}}), loaded.name);
  }

 private:
  test::ScratchFolder folder_;
  organ::Organ organ_;
};

/// The whole state in one block, every node moved by `u`, or only the highest ones.
msg::OrganState state_of(const organ::Organ& organ, std::uint64_t seq, const Vec3& u) {
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
