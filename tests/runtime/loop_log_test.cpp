#include "runtime/loop_log.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
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

// A limit of the file's size does what a full disk does.
TEST(LoopLog, LinesThatAFullDiskDidNotTakeAreTold) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "omentum_full_loop_log.csv";
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{16 << 10, limit.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  std::string told;
  try {
    LoopLog log(file);
    for (int i = 0; i < 5000; ++i) log.push({i * 1000, 1000, 7, 0});
    log.finish();
  } catch (const std::runtime_error& e) {
    told = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::filesystem::remove(file);
  EXPECT_NE(told.find(file.string() + ": not all lines could be written: File too large"), std::string::npos)
      << told;
}

TEST(LoopLog, WhatIsNoFileIsRefused) {
  EXPECT_THROW(LoopLog("/dev/full"), std::runtime_error);
  EXPECT_THROW(LoopLog("/dev/null"), std::runtime_error);
}

}  // namespace
}  // namespace omentum::runtime
