#include "benchmarks/bench_json.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::ExitedWithCode;

/// A command line, as main() gets it.
struct Words {
  explicit Words(std::vector<std::string> given) : text(std::move(given)) {
    for (std::string& word : text) argv.push_back(word.data());
    argv.push_back(nullptr);
    argc = static_cast<int>(text.size());
  }
  std::vector<std::string> left() const { return {argv.begin(), argv.begin() + argc}; }

  std::vector<std::string> text;
  std::vector<char*> argv;
  int argc;
};

nlohmann::json written(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

TEST(BenchResults, TakesItsOptionAndLeavesTheOtherWords) {
  const test::ScratchFolder folder;
  const std::string file = folder / "a.json";
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--json", file}, {"--json=" + file}}) {
    std::filesystem::remove(file);
    std::vector<std::string> given{"bench", "--only"};
    given.insert(given.end(), option.begin(), option.end());
    given.emplace_back("liver");
    Words words(given);
    Results(words.argc, words.argv.data()).write();
    EXPECT_THAT(words.left(), ElementsAre("bench", "--only", "liver"));
    EXPECT_EQ(written(file), nlohmann::json::array());
  }
}

TEST(BenchResults, WithoutAFileItRefusesAndSaysSo) {
  Words words({"bench", "--json"});
  EXPECT_EXIT(Results(words.argc, words.argv.data()), ExitedWithCode(2),
              "bench: --json: .*expected --json FILE");
}

TEST(BenchResults, WritesWhatThereIsAndLeavesOutWhatThereIsNot) {
  const test::ScratchFolder folder;
  Words words({"bench", "--json", folder / "a.json"});
  Results results(words.argc, words.argv.data());
  results.add({.name = "step/liver", .value = 20, .unit = "us", .limit = 30, .reference = 10, .ratio = 2});
  results.add({.name = "step/kidney", .value = 12.5, .unit = "us"});
  results.write();
  const auto expected = nlohmann::json::parse(R"([
    {"name": "step/liver", "value": 20.0, "unit": "us", "limit": 30.0, "reference": 10.0, "ratio": 2.0},
    {"name": "step/kidney", "value": 12.5, "unit": "us"}])");
  EXPECT_EQ(written(folder / "a.json"), expected);
}

TEST(BenchResults, AFigureMeasuredAgainReplacesTheFirst) {
  Words words({"bench"});
  Results results(words.argc, words.argv.data());
  for (const double value : {3.0, 4.0}) results.add({"step", value, "us"});
  ASSERT_EQ(results.entries().size(), 1u);
  EXPECT_EQ(results.entries()[0].value, 4);
}

TEST(BenchResults, ComparesFiguresByName) {
  Words words({"bench"});
  Results results(words.argc, words.argv.data());
  results.add({"own", 6, "us"});
  results.add({"bare", 4, "us"});
  results.compare("own", "bare");
  results.compare("bare", "never measured");
  results.limit("own", 7);
  const Entry &own = results.entries()[0], &bare = results.entries()[1];
  EXPECT_EQ(own.reference, 4);
  EXPECT_EQ(own.ratio, 1.5);
  EXPECT_EQ(own.limit, 7);
  EXPECT_FALSE(bare.reference || bare.ratio || bare.limit);
}

}  // namespace
}  // namespace omentum::bench
