// Keys and buttons of the panel, and that it can be read and pressed in pictures of any size.
#include "render_node/panel.h"
#include "render_node/panel_help.h"
#include "render_node/panel_keys.h"
#include "render_node/view_choices.h"

#include "panel_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <set>

namespace omentum::render {
namespace {

TEST(KeyPresses, AreLettersOfEitherCaseAndNothingElse) {
  KeyPresses keys('p');
  keys.add('0');
  keys.add('\0');
  EXPECT_TRUE(keys.has('P'));
  for (char letter = 'A'; letter <= 'Z'; ++letter) EXPECT_EQ(keys.has(letter), letter == 'P') << letter;
  EXPECT_FALSE(keys.has('['));
}

TEST(ControlWords, EveryControlHasAKeyAndAButtonOfItsOwn) {
  std::set<Control> controls;
  std::set<char> keys;
  std::set<std::string> ids;
  for (const ControlWord& word : control_words()) {
    controls.insert(word.control);
    keys.insert(word.key);
    ids.insert(word.button_id);
    EXPECT_TRUE(KeyPresses(word.key).has(word.key));
  }
  EXPECT_EQ(controls.size(), kControlCount);
  EXPECT_EQ(keys.size(), kControlCount);
  EXPECT_EQ(ids.size(), kControlCount);
}

TEST(ControlWords, PauseAndRecordAskForWhateverIsNot) {
  PanelView view;
  EXPECT_TRUE(actions_of(KeyPresses('P'), view).pause);
  EXPECT_TRUE(actions_of(KeyPresses('V'), view).record);
  view.paused = view.recording.on = true;
  EXPECT_TRUE(actions_of(KeyPresses('P'), view).start);
  EXPECT_TRUE(actions_of(KeyPresses('V'), view).stop_recording);
  EXPECT_FALSE(actions_of(KeyPresses('V'), view).record);
}

TEST(ControlWords, FoldsAreOfUseWhereThereIsAGut) {
  PanelView view;
  EXPECT_FALSE(actions_of(KeyPresses('G'), view).switch_folds);
  const std::size_t lines = help_lines(view).size();
  view.has_tube = true;
  EXPECT_EQ(help_lines(view).size(), lines + 1);
  ViewChoices choices;
  choose(actions_of(KeyPresses('G'), view), choices);
  EXPECT_TRUE(choices.folds);
  tell(choices, view);
  EXPECT_TRUE(view.folds);
  choose(actions_of(KeyPresses('G'), view), choices);
  EXPECT_FALSE(choices.folds);
}

TEST(HelpLines, SayWhatTurnsTheCameraWhileAMouseMovesAnInstrument) {
  const auto turning = [](const PanelView& view) {
    for (const HelpLine& line : help_lines(view))
      if (line.does.find("turn the orbit camera") == 0) return line.what;
    return std::string();
  };
  PanelView view;
  EXPECT_EQ(turning(view), "drag");
  view.mouse_help = "mouse: right hand";
  EXPECT_EQ(turning(view), "middle drag");
}

TEST(UiScale, GrowsWithMonitorAndPictureAndShrinksWhereItWouldNotFit) {
  EXPECT_EQ(ui_scale(0, 1, {1280, 720}), 1);
  EXPECT_EQ(ui_scale(0, 1, {1920, 1080}), 1);
  EXPECT_EQ(ui_scale(0, 1, {3840, 2160}), 2);
  EXPECT_EQ(ui_scale(0, 3, {3840, 2160}), 3);
  EXPECT_NEAR(ui_scale(0, 2, {1280, 720}), 1.2, 0.05) << "two would be cut off";
  EXPECT_LT(ui_scale(0, 1, {480, 400}), 1);
  EXPECT_EQ(ui_scale(1.5f, 3, {480, 400}), 1.5f) << "who asks gets it";
}

struct Screen {
  Size size;
  float monitor = 1;
};

// A panel with all that it can say, and help, at a window of some size.
class Panels : public testing::TestWithParam<Screen> {
 protected:
  void SetUp() override {
    const auto& [size, monitor] = GetParam();
    style_panel(ui_scale(0, monitor, size));
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    ImGui::GetIO().DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  }
  void lay_out(const PanelView& view) {
    for (int frame = 0; frame < 2; ++frame) {
      ImGui::NewFrame();
      lay_out_panel(view);
      ImGui::Render();
    }
  }
  static PanelView full() {
    PanelView view;
    view.scene = "A liver pressed by a simulated hand";
    view.interactive = view.endoscope = view.wires = view.shows_help = view.has_tube = true;
    view.recording = {.on = true, .seconds = 3599};
    view.map = TissueMap::kStress;
    view.real_time_factor = 0.9;
    view.hand_to_force_us = view.hand_to_picture_us = 12345;
    view.exposed_organ = "colon";
    view.exposed_share = 0.4;
    view.picture = "quarter pixels, 24 of 30 Hz";
    for (const char* name : {"haptic", "deform", "render", "device", "launcher"})
      view.nodes.push_back({.name = name});
    for (int t = 0; t < 4; ++t) {
      ToolRow& tool = view.tools.emplace_back();
      tool.name = "left hand, grasper";
      tool.colour = Vec3f(0.1f, 0.5f, 0.9f);
      tool.present = true;
      tool.most_n = 12;
      tool.state = {"clamped", "slew-limited"};
    }
    for (int o = 0; o < 3; ++o) {
      OrganRow& organ = view.organs.emplace_back();
      organ.name = "liver";
      organ.nodes = 26000;
      organ.tetrahedra = 132000;
      organ.removed_tetrahedra = 1234;
      organ.moved_mm = 30;
      organ.limit_mm = 20;
    }
    view.faults.assign(9, "haptic: tool 1: position is not finite (first at 3.2 s, 12 times)");
    return view;
  }
  static ImRect rect(const char* window) { return ImGui::FindWindowByName(window)->Rect(); }

  PanelContext context_;
};

TEST_P(Panels, AllWindowsLieInThePictureAndNoneOnAnother) {
  lay_out(full());
  const ImRect picture{{0, 0}, ImGui::GetIO().DisplaySize};
  const std::array windows{rect("omentum"), rect("controls"), rect("help")};
  for (const ImRect& window : windows) EXPECT_TRUE(picture.Contains(window));
  for (std::size_t a = 0; a < windows.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(windows[a].Overlaps(windows[b])) << a << ", " << b;
  const ImDrawData* data = ImGui::GetDrawData();
  for (int list = 0; list < data->CmdListsCount; ++list)
    for (const ImDrawVert& v : data->CmdLists[list]->VtxBuffer) {
      EXPECT_LE(v.pos.x, picture.Max.x);
      EXPECT_LE(v.pos.y, picture.Max.y);
    }
}

TEST_P(Panels, NoButtonsLabelIsCutOff) {
  // letters that do not fit on their button are left out
  const auto corners = [&] {
    lay_out(full());
    return ImGui::FindWindowByName("controls")->DrawList->VtxBuffer.Size;
  };
  const int here = corners();
  ImGui::GetIO().DisplaySize.x = 20'000;
  EXPECT_EQ(here, corners());
}

TEST_P(Panels, TextIsLargeEnoughToRead) {
  lay_out(full());
  const auto& [size, monitor] = GetParam();
  EXPECT_GE(ImGui::GetFontSize(), 15.0f * std::max(1.0f, static_cast<float>(size.height) / 1080) - 0.5f);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Panels,
                         testing::Values(Screen{{1280, 720}}, Screen{{1280, 800}}, Screen{{1920, 1080}},
                                         Screen{{3840, 2160}}, Screen{{3840, 2160}, 2.0f}));

}  // namespace
}  // namespace omentum::render
