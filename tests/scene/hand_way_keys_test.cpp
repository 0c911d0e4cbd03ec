#include "scene/scene_values.h"
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The good scene with a hand that goes along these waypoints.
std::string going(const std::string& waypoints) {
  const std::string text = kGood;
  return text.substr(0, text.find("press_point")) + waypoints;
}

const std::string kTwo = R"([[hands.way]]
to = [0, 0, 0.1]
seconds = 1
grip_rad = 0.5
[[hands.way]]
to = [0.1, 0, 0]
seconds = 2
)";

TEST(HandWayKeys, AHandWithWaypointsNeedsNoPress) {
  const HandSpec hand = load_scene(write_scene(going(kTwo))).hands[0];
  ASSERT_EQ(hand.way.size(), 2u);
  EXPECT_EQ(hand.way[0].grip_rad, 0.5);
  EXPECT_EQ(hand.way[1].to, Vec3(0.1, 0, 0));
  EXPECT_EQ(hand.way[1].seconds, 2);
  EXPECT_EQ(hand.way[1].grip_rad, 0) << "closed";
  EXPECT_EQ(hand.press_point, Vec3(0, 0, 0.1));
  EXPECT_THAT(scene_values(load_scene(write_scene(going(kTwo)))),
              Contains("hands[0].way[1].to = [0.1, 0, 0]"));
}

TEST(HandWayKeys, APressBesideAWayIsRefused) {
  EXPECT_THAT(message_of(write_scene(going("press_point = [0, 0, 1]\n" + kTwo))),
              HasSubstr("hands[0].press_point: found an unknown key"));
}

TEST(HandWayKeys, AHandThatWouldTeleportIsRefusedWithWhatItNeeds) {
  const auto file =
      write_scene(going("[[hands.way]]\nto = [0, 0, 0]\nseconds = 9\n"
                        "[[hands.way]]\nto = [1, 0, 0]\nseconds = 0.1\n"));
  EXPECT_THAT(message_of(file), AllOf(HasSubstr(":21: hands[0].way[1].seconds: found 0.1 s"),
                                      HasSubstr("at least 0.375 s"), HasSubstr("5 m/s")));
  EXPECT_THAT(message_of(write_scene(going("[[hands.way]]\nto = [0, 0, 0]\nseconds = 0\n"))),
              HasSubstr("hands[0].way[0].seconds: found 0"));
}

TEST(HandWayKeys, AHandWithWaypointsMayCut) {
  std::string text = going("cut = true\n" + kTwo);
  EXPECT_THAT(message_of(write_scene(text)),
              HasSubstr("hands[0].cut: found true with a tool that does not cut"));
  text.insert(text.find("points ="), "cuts = true\nedge = [[0, 0, 0], [0, 0, 0.01]]\n");
  const HandSpec hand = load_scene(write_scene(text)).hands[0];
  EXPECT_TRUE(hand.cut);
  EXPECT_EQ(hand.way.size(), 2u);
}

TEST(HandWayKeys, JawsOpenToARightAngleAtMost) {
  EXPECT_THAT(message_of(write_scene(going("[[hands.way]]\nto = [0, 0, 0]\nseconds = 1\ngrip_rad = 30\n"))),
              HasSubstr("hands[0].way[0].grip_rad: found 30"));
}

}  // namespace
}  // namespace omentum::scene
