// The figures of a cut along a planned line, against cuts whose figures are known by hand.
#include "deform_node/cut_score.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

constexpr double kScoreRounding = 1e-9;
constexpr double kLineWidth_m = 0.004;

/// A plate of 10 x 10 cm and 1 cm thick, in cells of 1 cm; its line goes along x in the middle of the top.
class CutScoreTest : public testing::Test {
 protected:
  CutScoreTest() : u_(3 * mesh_.positions.size(), 0.0), removed_((mesh_.tetrahedra.size() + 7) / 8) {}

  OrganView view() const { return {.values = {}, .removed_bits = removed_, .body_u = u_}; }
  /// An upright blade goes along x, `aside_m` from the line, in steps of a millimetre.
  void cut_along(CutScore& score, double aside_m, double from_x, double to_x) {
    const int steps = static_cast<int>(std::lround((to_x - from_x) / 1e-3));
    for (int i = 0; i < steps; ++i) {
      const auto blade = [&](double x) {
        return std::array<Vec3, 2>{Vec3(x, kMiddle_m + aside_m, -0.01), Vec3(x, kMiddle_m + aside_m, 0.02)};
      };
      const CutStroke stroke{.from = blade(from_x + 1e-3 * i), .to = blade(from_x + 1e-3 * (i + 1))};
      score.follow({&stroke, 1}, view(), 1, now_s_ += 0.01);
    }
  }
  /// All whose middles have y between these, and how much that is.
  double remove_between(double low_m, double high_m) {
    double volume_m3 = 0;
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      const auto& [a, b, c, d] = mesh_.tetrahedra[geometry::TetId(t)];
      const auto& x = mesh_.positions;
      const double y = (x[a] + x[b] + x[c] + x[d]).y() / 4;
      if (y < low_m || y > high_m) continue;
      removed_[t / 8] = static_cast<std::uint8_t>(removed_[t / 8] | 1 << t % 8);
      volume_m3 += std::abs(geometry::signed_volume(x[a], x[b], x[c], x[d]));
    }
    return volume_m3;
  }

  static constexpr double kMiddle_m = 0.05, kTop_m = 0.01;
  geometry::TetraMesh mesh_ = test::make_box_mesh(10, 10, 1, {0.1, 0.1, kTop_m});
  geometry::Surface surface_ = geometry::extract_surface(mesh_, std::vector<bool>(mesh_.positions.size()));
  scene::ScoreSpec spec_{.line_of = "plate",
                         .planned_line = {Vec3(0.02, kMiddle_m, kTop_m), Vec3(0.08, kMiddle_m, kTop_m)},
                         .line_width_m = kLineWidth_m};
  std::vector<double> u_;
  std::vector<std::uint8_t> removed_;
  double now_s_ = 3;
};

TEST_F(CutScoreTest, ABladeOnTheLineIsNowhereFromIt) {
  CutScore score(spec_, mesh_, surface_);
  cut_along(score, 0, 0.02, 0.08);
  const CutFigures figures = score.figures(view());
  EXPECT_NEAR(figures.way_m, 0.06, kScoreRounding);
  EXPECT_NEAR(figures.mean_m, 0, kScoreRounding);
  EXPECT_NEAR(figures.largest_m, 0, kScoreRounding);
  EXPECT_NEAR(figures.seconds, 59 * 0.01, kScoreRounding) << "from the first moment to the last";
}

TEST_F(CutScoreTest, TheMeanIsByTheWayAndTheLargestIsOne) {
  CutScore score(spec_, mesh_, surface_);
  cut_along(score, 0.003, 0.02, 0.04);
  cut_along(score, -0.006, 0.04, 0.08);
  const CutFigures figures = score.figures(view());
  EXPECT_NEAR(figures.mean_m, (0.02 * 0.003 + 0.04 * 0.006) / 0.06, kScoreRounding);
  EXPECT_NEAR(figures.largest_m, 0.006, kScoreRounding);
}

TEST_F(CutScoreTest, BeyondItsEndTheLineIsAsFarAsItsEnd) {
  CutScore score(spec_, mesh_, surface_);
  cut_along(score, 0, 0.08, 0.09);
  EXPECT_NEAR(score.figures(view()).largest_m, 0.01, kScoreRounding);
  EXPECT_NEAR(score.figures(view()).mean_m, 0.0055, kScoreRounding);
}

TEST_F(CutScoreTest, TheLineGoesWithTheTissue) {
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n) u_[3 * n + 1] = 0.01;
  CutScore score(spec_, mesh_, surface_);
  cut_along(score, 0.01, 0.02, 0.08);
  EXPECT_NEAR(score.figures(view()).largest_m, 0, kScoreRounding);
}

TEST_F(CutScoreTest, ABladeInTheAirIsNotScored) {
  CutScore score(spec_, mesh_, surface_);
  const CutStroke stroke{.from = {Vec3(0, 0, 1), Vec3(0, 0, 2)}, .to = {Vec3(1, 0, 1), Vec3(1, 0, 2)}};
  score.follow({&stroke, 1}, view(), 0, 1);
  EXPECT_EQ(score.figures(view()).way_m, 0);
  EXPECT_EQ(score.figures(view()).seconds, 0);
}

TEST_F(CutScoreTest, ASecondBladeInTheAirIsNotScoredWhileTheFirstCuts) {
  CutScore score(spec_, mesh_, surface_);
  const std::array cutting{Vec3(0.03, kMiddle_m, -0.01), Vec3(0.03, kMiddle_m, 0.02)};
  const Vec3 on(1e-3, 0, 0), off(0, 0, 1);
  const std::array strokes{
      CutStroke{.tool = 0, .from = cutting, .to = {cutting[0] + on, cutting[1] + on}},
      CutStroke{.tool = 1, .from = {off, 2 * off}, .to = {off + 10 * on, 2 * off + 10 * on}}};
  score.follow(strokes, view(), 1, now_s_);
  EXPECT_NEAR(score.figures(view()).way_m, 1e-3, kScoreRounding);
  EXPECT_NEAR(score.figures(view()).largest_m, 0, kScoreRounding);
}

TEST_F(CutScoreTest, WhatThePlannedCutMeetsIsInsideHoweverDeepAndTheRestIsOutside) {
  const double both_rows_m3 = remove_between(0.04, 0.06);
  CutFigures figures = CutScore(spec_, mesh_, surface_).figures(view());
  EXPECT_NEAR(both_rows_m3, 0.02 * 0.1 * kTop_m, kScoreRounding);
  EXPECT_NEAR(figures.removed_m3, both_rows_m3, kScoreRounding);
  // the rows beside the line go on for 2 cm beyond each of its ends, where 4 mm count as its end
  EXPECT_GT(figures.outside_m3, 2 * 0.01 * 0.02 * kTop_m - kScoreRounding);
  EXPECT_LT(figures.outside_m3, 2 * 0.02 * 0.02 * kTop_m + kScoreRounding);
  const double third_row_m3 = remove_between(0.06, 0.07);
  EXPECT_NEAR(CutScore(spec_, mesh_, surface_).figures(view()).outside_m3 - figures.outside_m3, third_row_m3,
              kScoreRounding)
      << "a centimetre from the line";
}

TEST_F(CutScoreTest, AWiderLineForgivesMore) {
  remove_between(0.04, 0.08);
  const double narrow_m3 = CutScore(spec_, mesh_, surface_).figures(view()).outside_m3;
  spec_.line_width_m = 0.012;
  EXPECT_LT(CutScore(spec_, mesh_, surface_).figures(view()).outside_m3, narrow_m3);
}

TEST_F(CutScoreTest, AResetBeginsAnew) {
  CutScore score(spec_, mesh_, surface_);
  cut_along(score, 0.003, 0.02, 0.04);
  score.reset();
  EXPECT_EQ(score.figures(view()).way_m, 0);
  cut_along(score, 0.001, 0.04, 0.06);
  EXPECT_NEAR(score.figures(view()).largest_m, 0.001, kScoreRounding);
}

}  // namespace
}  // namespace omentum::deform
