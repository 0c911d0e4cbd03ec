// What a scene says of who moves a tool.
#include "scene/scene_values.h"
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::string for_device(const std::string& name) {
  return with("shape = \"probe\"", "shape = \"probe\"\ndevice = \"" + name + "\"");
}

TEST(DeviceKeys, AToolMayNameItsDeviceAndMachinesHaveToAgreeOnIt) {
  const Scene scene = load_scene(write_scene(for_device("omega.7 left")));
  EXPECT_EQ(scene.tools[0].device, "omega.7 left");
  EXPECT_THAT(scene_values(scene), Contains("tools[0].device = omega.7 left"));
  const Scene anybody = load_scene(write_scene(kGood));
  EXPECT_EQ(anybody.tools[0].device, "");
  EXPECT_THAT(scene_values(anybody), Not(Contains(HasSubstr("device"))));
}

TEST(DeviceKeys, ANameThatNoDeviceCanHaveIsRefused) {
  EXPECT_THAT(message_of(write_scene(for_device(""))), HasSubstr("tools[0].device: found no name"));
  EXPECT_THAT(message_of(write_scene(for_device(std::string(65, 'a')))),
              HasSubstr("tools[0].device: found 65 characters, expected at most 64"));
}

}  // namespace
}  // namespace omentum::scene
