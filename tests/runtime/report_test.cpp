#include "runtime/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace omentum::runtime {
namespace {

std::filesystem::path empty_folder(const char* name) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(Report, HoldsExactlyTheFieldsOfTheContract) {
  LoopRecord record;
  record.ticks = 3;
  record.missed = 1;
  record.period.add_ns(1'000'000);
  const auto json = to_json(record, 1000);
  EXPECT_EQ(json.size(), 5u);
  EXPECT_EQ(json["rate_hz"], 1000);
  EXPECT_EQ(json["ticks"], 3);
  EXPECT_EQ(json["missed"], 1);
  for (const char* name : {"period_us", "compute_us"}) {
    EXPECT_EQ(json[name].size(), 5u);
    for (const char* field : {"p50", "p99", "p999", "max", "count"}) EXPECT_TRUE(json[name].contains(field));
  }
  EXPECT_EQ(json["period_us"]["count"], 1);
}

TEST(Report, OfATextOfAnyBytesIsWritten) {
  const auto file = empty_folder("report_bytes_test") / "report.json";
  write_report({{"name", "exampl\xe9"}}, file);
  std::ifstream in(file);
  EXPECT_EQ(nlohmann::json::parse(in)["name"], "exampl\xef\xbf\xbd");
}

TEST(Report, ReplacesAnOlderOneAndLeavesNoDraft) {
  const auto folder = empty_folder("report_test");
  write_report({{"run", 1}}, folder / "report.json");
  write_report({{"run", 2}}, folder / "report.json");
  std::ifstream in(folder / "report.json");
  EXPECT_EQ(nlohmann::json::parse(in)["run"], 2);
  const std::filesystem::directory_iterator files(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Report, AnUnwritablePlaceIsNamedAndNothingIsLeft) {
  const auto folder = empty_folder("report_unwritable_test");
  EXPECT_THROW(write_report({}, folder / "absent" / "report.json"), std::runtime_error);
  std::filesystem::create_directory(folder / "taken");  // a folder cannot be replaced by a file
  EXPECT_THROW(write_report({}, folder / "taken"), std::runtime_error);
  const std::filesystem::directory_iterator files(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

}  // namespace
}  // namespace omentum::runtime
