#include "runtime/loop_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace omentum::runtime {
namespace {

TEST(LoopLog, EveryTickIsOneLineInOrder) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "loop_log_test.csv";
  {
    LoopLog log(file);
    for (int i = 0; i < 5000; ++i) log.push({i * 1000, 1000, 7, i % 2});
  }
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "tick,start_ns,period_ns,compute_ns,cause");
  for (int i = 0; i < 5000; ++i) {
    ASSERT_TRUE(std::getline(in, line));
    const std::string n = std::to_string(i);
    ASSERT_EQ(line, n + "," + std::to_string(i * 1000) + ",1000,7," + std::to_string(i % 2));
  }
  EXPECT_FALSE(std::getline(in, line));
}

TEST(LoopLog, AFileThatCannotBeWrittenIsNamed) {
  try {
    LoopLog log("/nonexistent/log.csv");
    FAIL() << "no exception";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("/nonexistent/log.csv"), std::string::npos);
  }
}

TEST(LoopLog, LinesThatAFullDiskDidNotTakeAreTold) {
  LoopLog log("/dev/full");
  for (int i = 0; i < 5000; ++i) log.push({i * 1000, 1000, 7, 0});
  try {
    log.finish();
    FAIL() << "no exception";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("/dev/full: not all lines could be written: No space left"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace omentum::runtime
