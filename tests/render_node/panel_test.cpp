// What the panel says, and that it can be laid out.
#include "render_node/panel.h"
#include "render_node/panel_lines.h"
#include "render_node/pose_arrivals.h"
#include "render_node/tissue_map.h"

#include "panel_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

namespace omentum::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

msg::NodeStatus status_of(std::uint32_t kind, std::uint64_t instance) {
  msg::NodeStatus status{};
  status.kind = kind;
  status.instance = instance;
  return status;
}

TEST(ForceHistory, KeepsTenSeconds) {
  ForceHistory history;
  for (int k = 0; k <= 200; ++k) history.add(0.1 * k, k < 50 ? 8 : 2);
  EXPECT_GE(history.samples().front().time_s, 20 - ForceHistory::kSpan_s - 1e-9);
  EXPECT_NEAR(history.samples().size(), 101, 1);
  EXPECT_EQ(history.largest_n(), 2) << "what is forgotten does not count";
}

TEST(ForceHistory, LineBreaksWhereNothingWasFelt) {
  ForceHistory history;
  history.add(0, 1);
  history.add(1, 1);
  history.interrupt();
  history.interrupt();
  history.add(5, 2);
  history.add(6, 2);
  std::vector<bool> begins;
  for (const auto& sample : history.samples()) begins.push_back(sample.after_gap);
  EXPECT_THAT(begins, ElementsAre(true, false, true, false));
}

TEST(ForceHistory, AxisHoldsTheLargestForce) {
  for (const double force : {0.0, 0.4, 1.0, 1.01, 3.7, 9.9, 10.0, 11.0, 480.0}) {
    EXPECT_GE(force_axis_n(force), force);
    EXPECT_GE(force_axis_n(force), 1);
    EXPECT_LE(force_axis_n(force), std::max(1.0, 2.5 * force));
  }
}

TEST(PanelView, SilentNodesAreToldApart) {
  std::vector<HeardStatus> heard;
  remember_status(status_of(msg::NODE_HAPTIC, 1), 0, heard);
  remember_status(status_of(msg::NODE_DEFORM, 1), 3 * kSecond, heard);
  const auto rows = node_rows(heard, 3 * kSecond);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(rows[0].silent);
  EXPECT_FALSE(rows[1].silent);
}

TEST(PanelView, RateIsMeasuredNotConfigured) {
  msg::NodeStatus status = status_of(msg::NODE_HAPTIC, 1);
  status.rate_hz = 1000;
  status.period_us.p50 = 1250;
  EXPECT_NEAR(node_rows({{status, 0}}, 0)[0].rate_hz, 800, 1e-9);
}

TEST(PanelView, TheRoundTripIsTheDevicesOwnAndTheSlowestOne) {
  msg::NodeStatus haptic = status_of(msg::NODE_HAPTIC, 1), quick = status_of(msg::NODE_DEVICE, 2),
                  slow = status_of(msg::NODE_DEVICE, 3);
  EXPECT_EQ(device_round_trip({{haptic, 0}}).count, 0u);
  quick.round_trip_us = {.p50 = 90, .p99 = 200, .p999 = 300, .max = 400, .count = 7};
  slow.round_trip_us = {.p50 = 130, .p99 = 180, .p999 = 300, .max = 400, .count = 7};
  EXPECT_EQ(device_round_trip({{haptic, 0}, {slow, 0}, {quick, 0}}).p50, 130);
}

TEST(PanelView, MissesOfRealTimeLoopsMatter) {
  for (const auto& [kind, missed, matter] : {std::tuple{msg::NODE_HAPTIC, 0, false},
                                             {msg::NODE_HAPTIC, 20, true},
                                             {msg::NODE_RENDER, 20, false}}) {
    msg::NodeStatus status = status_of(kind, 1);
    status.ticks = 10'000;
    status.missed = static_cast<std::uint64_t>(missed);
    EXPECT_EQ(node_rows({{status, 0}}, 0)[0].misses_matter, matter);
  }
}

TEST(PanelView, FaultsNameTheirNode) {
  msg::NodeStatus status = status_of(msg::NODE_DEFORM, 1);
  status.faults = {"contact of an unknown node"};
  EXPECT_THAT(all_faults({{status, 0}}), ElementsAre("deform: contact of an unknown node"));
}

TEST(PanelView, ForceStateInWords) {
  EXPECT_THAT(force_state_words(0), IsEmpty());
  EXPECT_THAT(force_state_words(msg::FORCE_CLAMPED | msg::FORCE_FAULT), ElementsAre("FAULT", "clamped"));
  EXPECT_THAT(force_state_words(msg::FORCE_RAMP | msg::FORCE_FAULT), ElementsAre("FAULT")) << "latched";
}

TEST(RememberStatus, RestartedNodeTakesItsPredecessorsPlace) {
  std::vector<HeardStatus> heard;
  remember_status(status_of(msg::NODE_DEFORM, 1), 0, heard);
  remember_status(status_of(msg::NODE_DEFORM, 2), kSecond, heard);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0].status.instance, 2u);
  remember_status(status_of(msg::NODE_DEFORM, 1), kSecond, heard);
  EXPECT_EQ(heard[0].status.instance, 2u) << "a late sample of the old run";
  remember_status(status_of(msg::NODE_DEFORM, 1), 60 * kSecond, heard);
  EXPECT_EQ(heard[0].status.instance, 1u) << "whoever was the newest is silent";
}

TEST(RememberStatus, ACrowdOfNamesHasAnEnd) {
  std::vector<HeardStatus> heard;
  for (std::uint64_t instance = 1; instance < 1000; ++instance)
    remember_status(status_of(msg::NODE_HAPTIC, instance), static_cast<std::int64_t>(instance), heard);
  EXPECT_EQ(heard.size(), kMostHeard);
  EXPECT_EQ(heard.back().status.instance, 999u) << "the newest is among them";
}

TEST(RememberStatus, SeveralHandsHaveALineEachUntilTheyFallSilent) {
  std::vector<HeardStatus> heard;
  remember_status(status_of(msg::NODE_DEVICE, 1), 0, heard);
  remember_status(status_of(msg::NODE_DEVICE, 2), 0, heard);
  EXPECT_EQ(heard.size(), 2u);
  remember_status(status_of(msg::NODE_DEVICE, 2), 60 * kSecond, heard);
  EXPECT_EQ(heard.size(), 1u);
}

TEST(RememberStatus, SessionsNodesStayUntilTheyReturn) {
  std::vector<HeardStatus> heard;
  remember_status(status_of(msg::NODE_HAPTIC, 1), 0, heard);
  remember_status(status_of(msg::NODE_DEFORM, 1), 0, heard);
  remember_status(status_of(msg::NODE_DEVICE, 1), 60 * kSecond, heard);
  const auto rows = node_rows(heard, 60 * kSecond);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_TRUE(rows[0].silent && rows[1].silent);
  remember_status(status_of(msg::NODE_HAPTIC, 2), 61 * kSecond, heard);
  remember_status(status_of(msg::NODE_DEFORM, 2), 61 * kSecond, heard);
  ASSERT_EQ(heard.size(), 3u) << "the new runs took the silent ones' places";
  EXPECT_FALSE(node_rows(heard, 61 * kSecond)[0].silent);
}

TEST(RememberStatus, LivingHapticNodesHaveALineEach) {
  std::vector<HeardStatus> heard;
  remember_status(status_of(msg::NODE_HAPTIC, 1), 0, heard);
  remember_status(status_of(msg::NODE_HAPTIC, 2), kSecond, heard);
  EXPECT_EQ(heard.size(), 2u);
  remember_status(status_of(msg::NODE_HAPTIC, 2), 60 * kSecond, heard);
  EXPECT_EQ(heard.size(), 2u) << "the living one does not take the silent one's place: it has its own";
}

TEST(HapticPaused, IsWhatASpeakingHapticNodeSays) {
  msg::NodeStatus status = status_of(msg::NODE_HAPTIC, 1);
  status.paused = true;
  EXPECT_EQ(haptic_paused({}, 0), std::nullopt);
  EXPECT_EQ(haptic_paused({{status, 0}}, 0), true);
  EXPECT_EQ(haptic_paused({{status, 0}}, 60 * kSecond), std::nullopt) << "it fell silent";
  status.paused = false;
  EXPECT_EQ(haptic_paused({{status, 0}}, 0), false);
}

TEST(OrganRow, IsStaleWhenNoStateCame) {
  EXPECT_FALSE((OrganRow{.known = true, .age_ns = kSecond / 10}.stale()));
  EXPECT_TRUE((OrganRow{.known = true, .age_ns = kSecond}.stale()));
}

TEST(OrganRow, LinearRangeIsThatOfTheLargestDisplacement) {
  EXPECT_FALSE((OrganRow{.moved_mm = 17, .limit_mm = 18}.beyond_linear()));
  EXPECT_TRUE((OrganRow{.moved_mm = 19, .limit_mm = 18}.beyond_linear()));
}

TEST(OrganRow, ALawThatTurnsWithTheTissueIsBeyondItsRangeByStrainAlone) {
  OrganRow row{.moved_mm = 500, .limit_mm = 18, .trusted = scene::Trusted::kSmallStrains};
  EXPECT_FALSE(row.beyond_linear());
  EXPECT_FALSE(row.beyond_small_strains()) << "nobody knows";
  row.strained = 0.3;
  EXPECT_TRUE(row.beyond_small_strains());
  row.trusted = scene::Trusted::kSmallDisplacements;
  EXPECT_TRUE(row.beyond_linear());
  EXPECT_FALSE(row.beyond_small_strains());
}

TEST(PanelShare, LeavesTheOrganInANarrowPicture) {
  EXPECT_NEAR(panel_share({960, 600}), (kPanelWidth + kPanelMargin) / 960, 1e-6);
  for (const int width : {64, 200, 480}) EXPECT_LE(panel_share({width, 300}), 0.4);
}

TEST(PoseArrivals, AreFoundUntilOverwritten) {
  PoseArrivals arrivals;
  EXPECT_FALSE(arrivals.find(0));
  arrivals.add(0, 100);
  arrivals.add(1, 200);
  EXPECT_EQ(arrivals.find(0), 100);
  EXPECT_EQ(arrivals.find(1), 200);
  EXPECT_FALSE(arrivals.find(2));
  arrivals.add(PoseArrivals::kKept, 300);
  EXPECT_FALSE(arrivals.find(0)) << "its place is taken";
}

// Lays a panel out without anything to draw it on; the height that it took.
class PanelLayout : public testing::Test {
 protected:
  PanelContext context_;

  float height_of(const PanelView& view, int frames = 3) {
    PanelActions actions;
    for (int frame = 0; frame < frames; ++frame) {
      ImGui::GetIO().DisplaySize = {960, 600};
      ImGui::NewFrame();
      actions = lay_out_panel(view);
      ImGui::Render();
    }
    EXPECT_FALSE(actions.pause || actions.reset || actions.clear_fault) << "nobody pressed anything";
    float top = 600, bottom = 0;
    for_each_corner([&](const ImDrawVert& v) {
      top = std::min(top, v.pos.y);
      bottom = std::max(bottom, v.pos.y);
      EXPECT_LT(v.pos.x, kPanelMargin + kPanelWidth + 1);
    });
    return bottom - top;
  }

  // Of what was laid out last.
  template <class Visit>
  static void for_each_corner(Visit&& visit) {
    const ImDrawData* data = ImGui::GetDrawData();
    for (int list = 0; list < data->CmdListsCount; ++list)
      for (const ImDrawVert& v : data->CmdLists[list]->VtxBuffer) visit(v);
  }

  static int count_corners() {
    int count = 0;
    for_each_corner([&](const ImDrawVert&) { ++count; });
    return count;
  }

  static PanelView busy() {
    PanelView view;
    view.scene = "A liver pressed by a simulated hand";
    view.time_s = 10;
    for (const char* name : {"haptic", "deform", "render", "device"}) view.nodes.push_back({.name = name});
    for (int t = 0; t < 2; ++t) {
      ToolRow& tool = view.tools.emplace_back();
      tool.name = "left hand, grasper";
      tool.colour = Vec3f(0.1f, 0.5f, 0.9f);
      tool.state = {"clamped"};
      for (int k = 0; k < 300; ++k) tool.curve.push_back({k / 30.0, 2.0f});
    }
    view.dent_mm = 7;
    view.organs = {{.moved_mm = 25, .limit_mm = 18, .known = true, .age_ns = 4 * kSecond}};
    view.faults.assign(9, "haptic: tool 1: position is not finite (first at 3.2 s, 12 times)");
    return view;
  }
};

TEST_F(PanelLayout, BusyPanelFitsAPictureAndItsColumn) {
  EXPECT_LT(height_of(busy()), 590);
}

TEST_F(PanelLayout, FaultsTakeRoom) {
  PanelView view = busy();
  const float with_faults = height_of(view);
  view.faults.clear();
  EXPECT_LT(height_of(view), with_faults);
}

TEST_F(PanelLayout, MoreOrgansAndFaultsThanFitAreCounted) {
  PanelView view = busy();
  view.organs.assign(8,
                     {.moved_mm = 25, .limit_mm = 18, .known = true, .age_ns = 4 * kSecond, .name = "gut"});
  EXPECT_LT(height_of(view), 600 - 2 * kPanelMargin + 1);
}

TEST_F(PanelLayout, AnOrgansSizeAndAHandsPeakAreTold) {
  PanelView view = busy();
  view.organs[0].age_ns = 0;
  const float before = height_of(view);
  view.organs[0].nodes = 1765;
  view.organs[0].tetrahedra = 7185;
  EXPECT_GT(height_of(view), before);
  const int corners = count_corners();
  view.tools[0].most_n = 3.5f;
  height_of(view);
  EXPECT_GT(count_corners(), corners);
}

TEST_F(PanelLayout, ATubeHasALengthAndNoDentAndAnExposedOrganItsShare) {
  PanelView view = busy();
  view.organs = {{.known = true, .name = "gut"}};
  const float with_dent = height_of(view);
  view.dents = false;
  const float plain = height_of(view);
  EXPECT_LT(plain, with_dent);
  view.organs[0].length_mm = 3950;
  const float with_length = height_of(view);
  EXPECT_GT(with_length, plain);
  view.exposed_organ = "a colon with a name that is far too long for one line of a panel";
  view.exposed_share = 0.42;
  EXPECT_GT(height_of(view), with_length);
}

TEST_F(PanelLayout, StaleOrganIsTold) {
  PanelView view = busy();
  const float told = height_of(view);
  view.organs[0].age_ns = 0;
  EXPECT_LT(height_of(view), told);
}

TEST_F(PanelLayout, CutsAndTheirTimeAreTold) {
  PanelView view = busy();
  view.faults.clear();  // they give way
  const float whole = height_of(view);
  view.organs[0].removed_tetrahedra = 312;
  const float cut = height_of(view);
  EXPECT_GT(cut, whole);
  view.real_time_factor = 1;
  EXPECT_GT(height_of(view), cut);
}

TEST_F(PanelLayout, NoLatencyIsTooLongForItsLine) {
  PanelView view = busy();
  for (double us = 1; us < 1e8; us *= 9.7) {
    view.hand_to_force_us = view.hand_to_picture_us = us;
    view.hand_to_force_p99_us = view.hand_to_picture_p99_us = 1.1 * us;
    height_of(view);  // looks at every corner
  }
}

TEST_F(PanelLayout, TheMapsScaleAndWhatIsNotToldTakeALineEach) {
  PanelView view = busy();
  view.faults.clear();  // they give way
  const float tissue = height_of(view);
  view.map = TissueMap::kStress;
  view.full_stress_pa = 1800;
  EXPECT_GT(height_of(view), tissue) << "that none is told";
  view.organs[0].mapped = true;
  const float unknown = height_of(view);
  EXPECT_GT(unknown, tissue);
  view.organs[0].stressed_pa = 420;
  EXPECT_GT(height_of(view), unknown) << "the largest of it has a line of its own";
  view.organs[0].trusted = scene::Trusted::kSmallStrains;
  const float linear = height_of(view);
  view.organs[0].strained = 0.4;
  EXPECT_GT(height_of(view), linear);
}

TEST_F(PanelLayout, WhereNoStressIsToldNoScaleSaysWhatColoursMean) {
  PanelView view = busy();
  view.full_stress_pa = 1800;
  const auto scale_corners = [&](TissueMap map, bool mapped) {
    view.map = map;
    view.organs[0].mapped = mapped;
    height_of(view);
    const ImU32 brightest = ImGui::GetColorU32(shown(map_colours().back()));
    int count = 0;
    for_each_corner([&](const ImDrawVert& v) { count += v.col == brightest; });
    return count;
  };
  for (const TissueMap map : {TissueMap::kStrain, TissueMap::kStress}) {
    EXPECT_EQ(scale_corners(map, false), 0);
    EXPECT_EQ(scale_corners(map, true), 2) << "the end of the scale";
  }
}

TEST_F(PanelLayout, WhatIsNewIsInTheBoxAtOnceInTheFirstFrameToo) {
  PanelView view = busy();
  view.faults.clear();
  for (int change = 0; change < 2; ++change) {
    const float at_once = height_of(view, 1);
    const int drawn = count_corners();
    EXPECT_EQ(at_once, height_of(view));
    EXPECT_EQ(drawn, count_corners());
    view.map = TissueMap::kStrain;
    view.real_time_factor = 1;
  }
}

TEST_F(PanelLayout, ALongSceneNameLeavesRoomForWhatStandsBesideIt) {
  const auto amber = [&](const std::string& name) {  // corners of "paused"
    PanelView view;
    view.paused = true;
    view.scene = name;
    height_of(view);
    const ImU32 colour = ImGui::ColorConvertFloat4ToU32({1.0f, 0.74f, 0.28f, 1});
    int count = 0;
    for_each_corner([&](const ImDrawVert& v) { count += v.col == colour; });
    return count;
  };
  ASSERT_GT(amber("liver"), 0);
  EXPECT_EQ(amber("openhelp_kidney_left_22k pressed by a simulated hand"), amber("liver"));
}

TEST_F(PanelLayout, NoLabelLiesOnTheForceCurve) {
  height_of(busy());
  // the curves alone are clipped to their own field
  ImVec4 field{0, 0, 960, 600};
  const ImDrawData* data = ImGui::GetDrawData();
  for (int list = 0; list < data->CmdListsCount; ++list) {
    for (const ImDrawCmd& command : data->CmdLists[list]->CmdBuffer) {
      if (command.ElemCount > 0 && command.ClipRect.w - command.ClipRect.y < field.w - field.y)
        field = command.ClipRect;
    }
  }
  ASSERT_LT(field.w - field.y, 100);
  const ImU32 label = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  for_each_corner([&](const ImDrawVert& v) {
    const bool inside = v.pos.x > field.x && v.pos.x < field.z && v.pos.y > field.y && v.pos.y < field.w;
    EXPECT_FALSE(inside && v.col == label) << "at " << v.pos.x << ", " << v.pos.y;
  });
}

TEST_F(PanelLayout, ALongNameLeavesRoomForWhatForceSafetyDid) {
  // which letters are dim, as their places in the font: three dots may stand for three letters
  const auto dim_letters = [&](const std::string& name, const std::string& word, float most_n) {
    PanelView view;
    ToolRow& tool = view.tools.emplace_back();
    tool.name = name;
    tool.present = true;
    tool.most_n = most_n;
    tool.state = {word};
    height_of(view);
    const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    double places = 0;
    for_each_corner([&](const ImDrawVert& v) { places += v.col == dim ? v.uv.x + v.uv.y : 0; });
    return places;
  };
  for (const char* word : {"stale", "clamped", "damped"})
    for (const float most_n : {0.31f, 0.91f, 1.47f, 4.44f, 11.11f})
      for (const char* name :
           {"right hand, probe", "left hand, grasper", "iiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiiii"})
        EXPECT_NEAR(dim_letters(name, word, most_n), dim_letters("a", word, most_n), 1e-6)
            << name << ", " << word;
}

TEST_F(PanelLayout, EmptyPanelIsLaidOutToo) {
  EXPECT_GT(height_of({}), 0);
}

}  // namespace
}  // namespace omentum::render
