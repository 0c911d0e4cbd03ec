// What a session as a whole promises: it is felt and seen over either vendor, and survives any of its parts.
#include "tests/system/session_on_trial.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>

namespace omentum::test {
namespace {

constexpr double kFelt_n = 0.1;     // a hand that presses 10 mm into soft tissue feels more than this
constexpr double kDent_m = 0.0005;  // and moves the surface by more than this
constexpr double kNothing_n = 1e-9;

const std::vector<std::string> kHandAndOrgan = {"haptic_node", "deform_node", "virtual_device"};

bool felt_and_seen(Observer& observer) {
  return observer.force_n(0) > kFelt_n && observer.dent_m() > kDent_m;
}

/// Whether it comes true while the hands hold; if not they go back to their start and press again. A hand
/// that haptic_node lost inside the organ, as a busy machine makes it, feels nothing there until it has come
/// out.
template <class Condition>
bool while_held(SessionOnTrial& session, std::chrono::seconds patience, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  session.command("reset");
  return false;
}

template <class Condition>
bool pressed(SessionOnTrial& session, Condition&& condition) {
  constexpr std::chrono::seconds kPress{10};  // twice what a hand's way into the organ takes (hold.toml)
  return comes_true([&] { return while_held(session, kPress, condition); });
}

bool pressed(SessionOnTrial& session, Observer& observer) {
  return pressed(session, [&] { return felt_and_seen(observer); });
}

bool felt_again(SessionOnTrial& session, Observer& observer) {
  observer.forget();
  return pressed(session, observer);
}

/// Whether one and the same press goes on after `event`, as `condition` tells. Where a busy machine ended it,
/// the next attempt is another press: `before` makes ready for each.
template <class Before, class Event, class Condition>
bool press_outlives(SessionOnTrial& session, Observer& observer, Before&& before, Event&& event,
                    Condition&& condition) {
  constexpr std::chrono::seconds kMoment{3};  // longer than forces fade in
  return comes_true([&] {
    before();
    if (!felt_again(session, observer)) return false;
    event();
    observer.forget();
    return while_held(session, kMoment, condition);
  });
}

template <class Event>
bool press_outlives(SessionOnTrial& session, Observer& observer, Event&& event) {
  return press_outlives(
      session, observer, [] {}, event, [&] { return felt_and_seen(observer); });
}

class VendorsTest : public ::testing::TestWithParam<std::pair<std::string, Vendors>> {};

TEST_P(VendorsTest, ForceIsFeltOrganMovesPictureIsMadeAndAllEndCleanly) {
  SessionOnTrial session(held_scene(), GetParam().second);
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  const std::vector<std::string> names = {"haptic_node", "deform_node", "render_node", "virtual_device"};
  session.start_all(names);
  ASSERT_TRUE(pressed(session, observer))
      << session["haptic_node"].messages() << session["deform_node"].messages()
      << session["virtual_device"].messages();
  EXPECT_TRUE(pressed(session, [&] { return observer.force_n(1) > kFelt_n; })) << "the second hand";
  EXPECT_TRUE(comes_true([&] {
    const auto shown = observer.status(msg::NODE_RENDER);
    return shown && !shown->echoes.empty();
  })) << session["render_node"].messages();
  for (const std::string& name : names) {
    EXPECT_EQ(session[name].terminate(), 0) << name << ": " << session[name].messages();
    EXPECT_EQ(nlohmann::json::parse(read_text(session.report_of(name)))["dds"], GetParam().second.at(name));
  }
  const auto device = nlohmann::json::parse(read_text(session.report_of("virtual_device")));
  EXPECT_GT(device["round_trip_us"]["count"], 0);
}

INSTANTIATE_TEST_SUITE_P(Pairings, VendorsTest,
                         ::testing::Values(std::pair{"Fast", all_on("fast")},
                                           std::pair{"Cyclone", all_on("cyclone")},
                                           std::pair{"Mixed", Vendors{{"haptic_node", "fast"},
                                                                      {"deform_node", "cyclone"},
                                                                      {"render_node", "fast"},
                                                                      {"virtual_device", "cyclone"}}}),
                         [](const auto& test) { return test.param.first; });

class SurvivalTest : public ::testing::TestWithParam<std::string> {
 protected:
  SessionOnTrial session_{held_scene(), all_on(GetParam())};
  Observer observer_{session_.domain(), transport::Vendor::kCyclone};
};

TEST_P(SurvivalTest, WithoutItsDeviceTheForceIsZeroAndANewOneIsServed) {
  session_.start_all(kHandAndOrgan);
  ASSERT_TRUE(pressed(session_, observer_));
  session_.kill("virtual_device");
  EXPECT_TRUE(comes_true([&] { return observer_.force_n() < kNothing_n; }));
  EXPECT_NE(observer_.force()->state & msg::FORCE_STALE, 0U);
  EXPECT_TRUE(session_["haptic_node"].running());
  EXPECT_TRUE(session_["deform_node"].running());
  session_.start("virtual_device");
  EXPECT_TRUE(felt_again(session_, observer_));
}

TEST_P(SurvivalTest, WithoutHapticNodeTheHandFeelsNothingTheOrganRestsAndANewNodeResumes) {
  session_.start_all(kHandAndOrgan);
  ASSERT_TRUE(pressed(session_, observer_));
  const double yielded = observer_.pose()->position.z;
  session_.kill("haptic_node");
  EXPECT_TRUE(comes_true([&] { return observer_.dent_m() == 0; }))
      << "the organ keeps a dent that nobody makes";
  // with no force on it the hand reaches its target, below where the tissue had held it
  EXPECT_TRUE(comes_true([&] { return observer_.pose()->position.z < yielded - 1e-4; }));
  EXPECT_TRUE(session_["virtual_device"].running());
  EXPECT_TRUE(session_["deform_node"].running());
  session_.start("haptic_node");
  observer_.forget();
  ASSERT_TRUE(comes_true([&] { return observer_.force().has_value(); })) << "the new node does not answer";
  // the tip is inside the organ now: it must come out before it can press again
  EXPECT_EQ(session_.command("reset"), 0);
  EXPECT_TRUE(felt_again(session_, observer_));
}

TEST_P(SurvivalTest, WithoutDeformNodeThePrecomputedForceStaysAndANewNodeResumes) {
  session_.start_all({"haptic_node", "virtual_device"});
  const auto serve = [&] { session_.start("deform_node"); };
  const auto lose_it = [&] {
    session_.kill("deform_node");
    observer_.forget();
    EXPECT_TRUE(comes_true([&] { return observer_.forces().size() > 500; })) << "haptic_node fell silent";
  };
  EXPECT_TRUE(
      press_outlives(session_, observer_, serve, lose_it, [&] { return observer_.force_n() > kFelt_n; }));
  EXPECT_TRUE(session_["haptic_node"].running());
  session_.start("deform_node");
  EXPECT_TRUE(felt_again(session_, observer_));
}

TEST_P(SurvivalTest, WithoutRenderNodeNothingElseChangesAndANewNodeDrawsAgain) {
  session_.start_all(kHandAndOrgan);
  const auto lose_it = [&] {
    session_.start("render_node");
    EXPECT_TRUE(comes_true([&] { return observer_.status(msg::NODE_RENDER).has_value(); }));
    session_.kill("render_node");
  };
  EXPECT_TRUE(press_outlives(session_, observer_, lose_it));
  for (const std::string& name : kHandAndOrgan) EXPECT_TRUE(session_[name].running()) << name;
  session_.start("render_node");
  observer_.forget();
  EXPECT_TRUE(comes_true([&] {
    const auto shown = observer_.status(msg::NODE_RENDER);
    return shown && !shown->echoes.empty();
  }));
}

INSTANTIATE_TEST_SUITE_P(Vendors, SurvivalTest, ::testing::Values("fast", "cyclone"),
                         [](const auto& test) { return test.param; });

TEST(SessionTest, SecondHapticNodeForTheSameToolRefusesAndTheFirstGoesOn) {
  SessionOnTrial session(held_scene(), all_on("fast"));
  Observer observer(session.domain(), transport::Vendor::kFast);
  session.start_all(kHandAndOrgan);
  const auto try_it = [&] {
    Process younger("haptic_node", {"--scene", held_scene(), "--dds", "cyclone", "--domain",
                                    std::to_string(session.domain())});
    EXPECT_EQ(younger.wait(), 2);
    const std::string messages = younger.messages();
    EXPECT_TRUE(messages.find("haptic_node: ") != std::string::npos) << messages;
  };
  EXPECT_TRUE(press_outlives(session, observer, try_it));
  EXPECT_TRUE(session["haptic_node"].running());
}

TEST(SessionTest, ResetBringsOrganToRestAndTheHandToItsStartThenItPressesAgain) {
  SessionOnTrial session(held_scene(), all_on("fast"));
  Observer observer(session.domain(), transport::Vendor::kFast);
  session.start_all(kHandAndOrgan);
  ASSERT_TRUE(pressed(session, observer));
  const double pressing = observer.pose()->position.z;
  observer.forget();
  std::atomic<bool> lifted{false}, rested{false}, ended{false};
  std::thread watch([&] {
    while (!ended) {
      const auto pose = observer.pose();
      if (pose && pose->position.z > pressing + 0.005) lifted = true;
      if (observer.state() && observer.dent_m() < 1e-6) rested = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  EXPECT_EQ(session.command("reset"), 0);
  EXPECT_TRUE(comes_true([&] { return lifted && rested; }));
  ended = true;
  watch.join();
  EXPECT_TRUE(felt_again(session, observer));
}

TEST(SessionTest, CommandWithoutASessionIsRefused) {
  Process command("omentum_session", {"pause", "--domain", std::to_string(domain_of_test())});
  EXPECT_EQ(command.wait(), 2);
  EXPECT_TRUE(command.messages().starts_with("omentum_session: no node found")) << command.messages();
}

}  // namespace
}  // namespace omentum::test
