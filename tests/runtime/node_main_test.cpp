#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace omentum::runtime {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kProgram = "node_main_example";
const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";

void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
  test::Process process(kProgram, arguments);
  EXPECT_EQ(process.wait(), 2);
  const std::string text = process.messages();
  EXPECT_THAT(text, StartsWith("node_main_example: "));
  EXPECT_THAT(text, HasSubstr(says));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(NodeMain, WrongArgumentsAreOneLineAndExitCodeTwo) {
  expect_refused({}, "--scene");
  expect_refused({"--scene", kScene, "--dds", "zenoh"}, "zenoh");
  expect_refused({"--scene", kScene, "--domain", "231"}, "231");
  expect_refused({"--scene", kScene, "--domain", "one"}, "one");
  expect_refused({"--scene", kScene, "--profile", "wan"}, "wan");
  expect_refused({"--scene", kScene, "--speed", "3"}, "--speed");
  expect_refused({"--scene"}, "--scene");
}

TEST(NodeMain, AMissingSceneIsOneLineAndExitCodeTwo) {
  expect_refused({"--scene", "/nonexistent/x.toml"}, "/nonexistent/x.toml");
}

// A report that is lost at the end costs a session.
TEST(NodeMain, AReportThatCannotBeWrittenIsRefusedAtTheStart) {
  const test::ScratchFolder folder;
  const auto refused = [&](const std::string& file, const std::string& reason) {
    expect_refused({"--scene", kScene, "--report", file},
                   "--report: " + file + ": cannot be written: " + reason);
  };
  refused(folder.path(), "it is a folder");
  refused("/dev/null", "it is a device");
  refused(folder / "nowhere/r.json", "No such file or directory");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(NodeMain, HelpListsTheSharedOptionsAndSucceeds) {
  test::Process process(kProgram, {"--help"});
  EXPECT_EQ(process.wait(), 0);
  for (const char* option : {"--scene", "--dds", "--domain", "--profile", "--secure", "--report", "--help"}) {
    EXPECT_THAT(process.output(), HasSubstr(option));
  }
}

TEST(StopSignal, SigintAndSigtermEndCleanlyEvenTwice) {
  for (const int signal : {SIGINT, SIGTERM}) {
    test::Process process(kProgram, {"--scene", kScene});
    ASSERT_TRUE(test::comes_true([&] { return process.output() == "ready\n"; }));
    process.send(signal);
    EXPECT_EQ(process.terminate(), 0);
    EXPECT_EQ(process.output(), "ready\nstopped\n");
  }
}

}  // namespace
}  // namespace omentum::runtime
