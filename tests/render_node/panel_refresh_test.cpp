// When the panel is drawn anew, and which parts of the picture it lies on.
#include "render_node/panel_refresh.h"
#include "render_node/panel_boxes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace omentum::render {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double kFrame_s = 1.0 / 25;

TEST(PanelRefresh, WhatStaysIsDrawnOnce) {
  PanelRefresh refresh;
  EXPECT_TRUE(refresh.due(7, 0, false));
  for (int k = 1; k < 100; ++k) EXPECT_FALSE(refresh.due(7, k * kFrame_s, k % 3 == 0));
}

TEST(PanelRefresh, WhatChangesByItselfIsDrawnAFewTimesASecond) {
  PanelRefresh refresh;
  int drawn = 0;
  double last_s = 0, longest_s = 0;
  for (int k = 0; k < 250; ++k) {
    if (!refresh.due(static_cast<std::uint64_t>(k), k * kFrame_s, false)) continue;
    longest_s = std::max(longest_s, k * kFrame_s - last_s);
    last_s = k * kFrame_s;
    ++drawn;
  }
  EXPECT_LE(drawn, 250 * kFrame_s / PanelRefresh::kPanelPeriod_s + 1);
  EXPECT_LE(longest_s, PanelRefresh::kPanelPeriod_s + kFrame_s + 1e-9);
}

TEST(PanelRefresh, APersonIsAnsweredAtOnce) {
  PanelRefresh refresh;
  EXPECT_TRUE(refresh.due(1, 0, false));
  EXPECT_FALSE(refresh.due(2, kFrame_s, false));
  EXPECT_TRUE(refresh.due(3, 2 * kFrame_s, true));
  EXPECT_TRUE(refresh.due(4, 3 * kFrame_s, false)) << "what another node answers";
  const double later_s = 2 * kFrame_s + PanelRefresh::kAnswer_s + kFrame_s;
  EXPECT_TRUE(refresh.due(5, later_s, false));
  EXPECT_FALSE(refresh.due(6, later_s + kFrame_s, false));
}

TEST(PanelRefresh, WhatIsLostIsDrawnAgain) {
  PanelRefresh refresh;
  EXPECT_TRUE(refresh.due(1, 0, false));
  refresh.forget();
  EXPECT_TRUE(refresh.due(1, kFrame_s, false));
}

TEST(PanelBoxes, ThoseApartStayAndEmptyOnesGo) {
  EXPECT_THAT(disjoint({{0, 0, 10, 10}, {10, 0, 20, 10}, {5, 5, 5, 9}}),
              UnorderedElementsAre(PixelBox{0, 0, 10, 10}, PixelBox{10, 0, 20, 10}));
  EXPECT_THAT(disjoint({}), IsEmpty());
}

TEST(PanelBoxes, AnyOfThemAreCoveredAndNoPixelTwice) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<PixelBox> boxes;
    for (int b = 0; b < 6; ++b) {
      const auto at = [&] { return static_cast<int>(random() % 30); };
      const int x = at(), y = at();
      boxes.push_back({x, y, x + 1 + at() / 3, y + 1 + at() / 3});
    }
    const std::vector<PixelBox> apart = disjoint(boxes);
    const auto in = [](const std::vector<PixelBox>& all, int x, int y) {
      return std::ranges::count_if(
          all, [&](const PixelBox& b) { return b.x0 <= x && x < b.x1 && b.y0 <= y && y < b.y1; });
    };
    for (int y = 0; y < 45; ++y) {
      for (int x = 0; x < 45; ++x) {
        EXPECT_LE(in(apart, x, y), 1);
        if (in(boxes, x, y) > 0) {
          EXPECT_EQ(in(apart, x, y), 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace omentum::render
