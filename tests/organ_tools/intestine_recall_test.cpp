// How much of an intestine's contact the searches find.
#include "organ_tools/intestine_recall/recall_plot.h"
#include "organ_tools/intestine_recall/recall_run.h"

#include "organ_tools/intestine_recall/pulling_hand.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace omentum::intestine_recall {
namespace {

using testing::HasSubstr;

TEST(CollidingRegions, AreConnectedInIndexSpace) {
  const geometry::GutLayout layout{4, 100};
  geometry::GutOverlaps overlaps;
  // a stair of three pairs, a pair beside nothing, and two cells of the mesentery that meet at a corner
  for (const auto& [i, j] : {std::pair{10, 40}, {11, 39}, {12, 38}, {10, 43}})
    overlaps.tube.push_back({i, j, 0.03});
  for (const auto& [i, row, column] : {std::array{70, 1, 20}, {70, 2, 21}})
    overlaps.mesentery.push_back({i, 2 * (row * layout.segment_count() + column) + 1, 0.01});
  const std::vector<Region> regions = regions_of(layout, overlaps);
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_EQ(regions[0], (Region{axis_pair(10, 40), axis_pair(39, 11), axis_pair(12, 38)}));
  EXPECT_EQ(regions[1], Region{axis_pair(43, 10)});
  EXPECT_EQ(regions[2], (Region{{70, 1, 20}, {70, 2, 21}}));
}

TEST(CollidingRegions, OneOfTheAxisIsNoneOfTheMesenterysFirstRow) {
  const geometry::GutLayout layout{4, 100};
  geometry::GutOverlaps overlaps;
  overlaps.tube.push_back({10, 40, 0.03});
  overlaps.mesentery.push_back({10, 2 * 40, 0.01});
  EXPECT_EQ(regions_of(layout, overlaps).size(), 2u);
}

TEST(PullingHand, TakesOneFreeMassOfTheAxisAndLetsItFall) {
  const geometry::GutShape gut = geometry::make_gut({});
  PullingHand hand(gut, 3), again(gut, 3);
  constexpr double kStep_s = 0.01;
  int pulling = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto forces = hand.pull(gut.positions, kStep_s);
    EXPECT_TRUE(std::ranges::equal(forces, again.pull(gut.positions, kStep_s))) << "the same seed";
    int pulled = 0;
    for (std::size_t m = 0; m < forces.size(); ++m) {
      if (forces[m].isZero()) continue;
      ++pulled;
      EXPECT_EQ(gut.layout.row(geometry::MassId(m)), 0);
      EXPECT_FALSE(gut.layout.is_held(geometry::MassId(m)));
      EXPECT_LT(forces[m].norm(), 8.001);
    }
    EXPECT_LE(pulled, 1);
    pulling += pulled;
  }
  EXPECT_GT(pulling, 500);
  EXPECT_LT(pulling, 900);
}

// What the measure asks of a minute, of half a second behind the fall.
TEST(Recall, TheCompleteSearchFindsAllAndTheStochasticOneNearlyAllWithATwentiethOfTheTests) {
  RecallOptions options;
  options.settle_s = 3;
  options.seconds = 0.5;
  const RecallReport report = measure_recall(options);
  EXPECT_EQ(report.samples.size(), 100u);
  EXPECT_GT(report.regions, 1000);
  EXPECT_GT(report.lasting, 20);
  const auto& [stochastic, complete] = report.methods;
  EXPECT_EQ(complete.found, report.regions);
  EXPECT_EQ(complete.found_in_time, report.lasting);
  EXPECT_GE(100 * stochastic.found, 99 * report.regions);
  EXPECT_GE(100 * stochastic.found_in_time, 99 * report.lasting)
      << stochastic.found_in_time << " of " << report.lasting;
  EXPECT_LE(100 * stochastic.tests, 5 * report.exhaustive_tests);
  EXPECT_LE(100 * complete.tests, 5 * report.exhaustive_tests);
  EXPECT_EQ(report.exhaustive_tests, 100 * (96 * 97 / 2 + 96 * 97 * 6));
}

TEST(Recall, TheSameSeedFindsTheSame) {
  RecallOptions options;
  options.settle_s = 0.3;
  options.seconds = 0.05;
  const RecallReport report = measure_recall(options), again = measure_recall(options);
  EXPECT_GT(report.regions, 50) << "the gut has come down on itself";
  for (std::size_t k = 0; k < report.samples.size(); ++k) {
    EXPECT_EQ(report.samples[k].regions, again.samples[k].regions);
    EXPECT_EQ(report.samples[k].found, again.samples[k].found);
    EXPECT_LE(report.samples[k].found[0], report.samples[k].regions);
  }
  EXPECT_EQ(report.methods[0].tests, again.methods[0].tests);
}

bool near(const force_map::Colour& a, const force_map::Colour& b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue) < 0.02f;
}

TEST(RecallPlot, AMissShowsAndWhatIsFoundLiesOnTheTopLine) {
  RecallReport whole, missed;
  whole.samples.assign(200, {10, {10, 10}});
  missed.samples.assign(200, {10, {10, 10}});
  for (std::size_t k = 100; k < 120; ++k) missed.samples[k].found[0] = 5;
  const force_map::Canvas a = draw_recall(whole, 0.005), b = draw_recall(missed, 0.005);
  const force_map::Colour orange{0.85f, 0.37f, 0.01f};
  std::vector<int> shown_a, shown_b;  // rows of the stochastic search's colour, in the middle of the time
  const int x = a.width() * 55 / 100;
  for (int y = 60; y < a.height(); ++y) {
    if (near(a.at(x, y), orange)) shown_a.push_back(y);
    if (near(b.at(x, y), orange)) shown_b.push_back(y);
  }
  ASSERT_FALSE(shown_a.empty());
  ASSERT_FALSE(shown_b.empty());
  EXPECT_GT(shown_b.front(), shown_a.front() + 50);
  EXPECT_GT(shown_b.back(), shown_a.back() + 50);
}

TEST(IntestineRecall, PrintsTheTableDrawsAndWritesItsNumbers) {
  const test::ScratchFolder folder;
  const std::string picture = folder / "recall.png", json = folder / "recall.json";
  test::Process process("intestine_recall",
                        {"--seconds", "0.3", "--seed", "2", "-o", picture, "--json", json});
  ASSERT_EQ(process.wait(), 0) << process.messages();
  EXPECT_THAT(process.output(), HasSubstr("stochastic"));
  EXPECT_THAT(process.output(), HasSubstr("in 60 steps"));
  EXPECT_THAT(test::read_text(picture), testing::StartsWith("\x89PNG"));
  std::map<std::string, double> numbers;
  for (const auto& figure : nlohmann::json::parse(test::read_text(json)))
    numbers[figure.at("name")] = figure.at("value");
  EXPECT_EQ(numbers.at("recall/complete"), 100);
  EXPECT_EQ(numbers.at("recall_in_time/complete"), 100);
  EXPECT_GT(numbers.at("recall/stochastic"), 50);
  EXPECT_LT(numbers.at("tests/stochastic"), 10);
}

TEST(IntestineRecall, WrongArgumentsEndWithTwoAndOneLine) {
  const test::ScratchFolder folder;
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--seconds", "0"}, {"--masses", "40"}, {"--seed", "x"}, {"-o", (folder / "no/x.png").string()}}) {
    test::Process process("intestine_recall", arguments);
    EXPECT_EQ(process.wait(), 2);
    EXPECT_THAT(process.messages(), testing::StartsWith("intestine_recall: "));
    EXPECT_EQ(std::ranges::count(process.messages(), '\n'), 1);
  }
}

}  // namespace
}  // namespace omentum::intestine_recall
