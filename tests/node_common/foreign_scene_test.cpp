// A node on one machine whose scene.toml is not the one that the session's deform_node serves.
#include "transport/bus.h"

#include "tests/support/block_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace omentum {
namespace {

using test::BlockScene;

struct Vendors {
  std::string session, newcomer;
};

class ForeignSceneTest : public ::testing::TestWithParam<Vendors> {
 protected:
  std::vector<std::string> arguments(const std::string& scene, const std::string& vendor) const {
    return {"--scene", scene, "--dds", vendor, "--domain", std::to_string(domain_)};
  }
  bool is_served() {
    return test::comes_true([&] { return heard_.load(); });
  }

  BlockScene block_{4, std::string(BlockScene::kProbe) +
                           "[[hands]]\ntool = 0\npress_point = [0, 0, 0.1]\n"
                           "press_normal = [0, 0, 1]\n"};
  int domain_ = test::domain_of_test();
  test::Process served_{"deform_node", arguments(block_.scene(), GetParam().session)};
  std::atomic<bool> heard_{false};
  std::unique_ptr<transport::Bus> bus_ =
      transport::Bus::open({.vendor = transport::Vendor::kFast, .domain = domain_, .name = "test"});
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scenes_ =
      bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo&) { heard_ = true; });
};

TEST_P(ForeignSceneTest, IsRefusedWithTheFirstValueThatDiffers) {
  ASSERT_TRUE(is_served()) << served_.messages();
  const std::string other = block_.scene_with("young_pa = 10000", "young_pa = 12000");
  for (const std::string program : {"haptic_node", "deform_node", "virtual_device"}) {
    test::Process newcomer(program, arguments(other, GetParam().newcomer));
    EXPECT_EQ(newcomer.wait(), 2);
    const std::string messages = newcomer.messages();
    const std::string line = program + ": scene: organs[0].young_pa is 10000 at deform_node, 12000 here\n";
    EXPECT_NE(messages.find(line), std::string::npos) << messages;
  }
  EXPECT_TRUE(served_.running()) << served_.messages();
}

INSTANTIATE_TEST_SUITE_P(Vendors, ForeignSceneTest,
                         ::testing::Values(Vendors{"fast", "cyclone"}, Vendors{"cyclone", "fast"}),
                         [](const auto& test) { return test.param.session + "Serves"; });

// What no SceneInfo could carry is refused where it is read.
TEST(TellableScene, AValueThatIsTooLongForSceneInfoIsRefusedAtTheStart) {
  const BlockScene block(4);
  const std::string wordy = block.scene_with("\"probe\"", "\"" + std::string(1000, 'x') + "\"");
  for (const std::string program : {"haptic_node", "deform_node"}) {
    test::Process node(program, {"--scene", wordy});
    EXPECT_EQ(node.wait(), 2);
    EXPECT_EQ(node.messages(),
              program + ": " + wordy + ": tools[0].name: found 1000 characters, expected at most 144\n");
  }
}

}  // namespace
}  // namespace omentum
