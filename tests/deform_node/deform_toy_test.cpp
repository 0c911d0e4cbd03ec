// A toy organ in the whole loop: what it offers comes out at the other end of a wire.
#include "deform_node/deform_loop.h"

#include "tests/deform_node/deform_toy.h"
#include "tests/deform_node/rates.h"
#include "tests/support/block_scene.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::deform {
namespace {

// where the scene says "quasi-static"
constexpr std::array kModels{
    ModelEntry{"quasi-static", organ::Load::kMeshOnly, deform_test::make_hanging_mass}};

TEST(ToyInTheLoop, ItsStatesItsTopologyAndItsLocalModelsComeToWhoHearsThem) {
  const test::BlockScene block(2);
  const organ::Organ organ = block.organ();
  const Vec3 rest = organ.mesh.positions[organ.surface.node.front()];
  test::FakeBus bus;
  DeformOptions options;
  options.node.scene = block.scene();
  options.models = kModels;
  test::StagedLoop<DeformLoop> node(kRate_hz, options, bus.opener());
  node.pass(1);
  EXPECT_FALSE(bus.newest<msg::LocalModel>().has_value()) << "no tool is there";

  msg::ToolPose pose{};
  pose.seq = 1;
  pose.valid = true;
  pose.position = {rest.x(), rest.y(), rest.z()};
  bus.post(pose);
  node.tick();
  const auto state = bus.newest<msg::OrganState>();
  EXPECT_EQ(state->kind, msg::KIND_TUBE);
  EXPECT_EQ(state->node_count, 1u);
  EXPECT_EQ(bus.newest<msg::Topology>()->tetrahedron_count, organ.mesh.tetrahedra.size());
  EXPECT_EQ(bus.take_all<msg::LocalModel>().size(), 1u);

  node.pass(0.5);
  EXPECT_LE(bus.take_all<msg::LocalModel>().size(), 1 + kToolGone_s * kRate_hz) << "the tool has gone";
  EXPECT_EQ(node.end(), "");
  EXPECT_EQ(node.loop().report()["steps"], 52);
}

}  // namespace
}  // namespace omentum::deform
