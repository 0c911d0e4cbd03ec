// The program as a user runs it.
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace omentum::device {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";

struct VirtualDevice : ::testing::Test {
  test::ScratchFolder folder;
  std::string domain = std::to_string(test::domain_of_test());

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }

  static void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
    test::Process process("virtual_device", arguments);
    EXPECT_EQ(process.wait(), 2);
    const std::string text = process.messages();
    EXPECT_THAT(text, StartsWith("virtual_device: "));
    EXPECT_THAT(text, HasSubstr(says));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
};

TEST_F(VirtualDevice, BadInputIsOneLineAndExitCodeTwo) {
  expect_refused({}, "--scene");
  expect_refused({"--scene", "/nonexistent.toml"}, "/nonexistent.toml");
  expect_refused({"--scene", kScene, "--dds", "zenoh"}, "zenoh");
  expect_refused({"--scene", kScene, "--rate-hz", "0"}, "--rate-hz");
  expect_refused({"--scene", kScene, "--rate-hz", "39"}, "40");
  expect_refused({"--scene", kScene, "--seconds", "-1"}, "--seconds");
  expect_refused({"--scene", kScene, "--trace", "/nonexistent.csv"}, "/nonexistent.csv");
  expect_refused({"--scene", kScene, "--record", "/nonexistent/x.csv"}, "/nonexistent/x.csv");
  expect_refused({"--scene", kScene, "--log", "/nonexistent/x.csv"}, "/nonexistent/x.csv");
  expect_refused({"--scene", kScene, "--trace", file("bad.csv", "t_s,px\n")}, "bad.csv:1: ");
  expect_refused({"--scene", kScene, "--trace",
                  file("tool.csv", "t_s,px,py,pz,qw,qx,qy,qz,grip,tool\n0,0,0,0,1,0,0,0,0,7\n")},
                 "found tool 7");
  expect_refused(
      {"--scene", kScene, "--frames", file("dead.toml", "[[devices]]\ntool = 0\nenable_button = 2\n")},
      "dead.toml: devices: found enable_button of tool 0");
  expect_refused({"--scene", kScene, "--frames",
                  file("near.toml", "[[devices]]\ntool = 0\nholds = \"handle\"\nleast_outside_m = 0.001\n")},
                 "least_outside_m");
  const std::string no_hands =
      file("scene.toml",
           "name = \"x\"\n[[organs]]\nname = \"o\"\nmesh = \"phantom:paper\"\nyoung_pa = 1\n"
           "poisson = 0.4\ndensity_kg_m3 = 1\nfixed = \"plane:x<0\"\n"
           "[[tools]]\nid = 0\nname = \"t\"\nshape = \"probe\"\npoints = [[0, 0, 0]]\n");
  expect_refused({"--scene", no_hands}, "hands: found none");
}

TEST_F(VirtualDevice, EndsOnSigtermWithAReportOfAllFields) {
  const std::string report = (folder / "report.json").string(), log = (folder / "log.csv").string();
  test::Process process("virtual_device",
                        {"--scene", kScene, "--domain", domain, "--report", report, "--log", log});
  ASSERT_TRUE(test::comes_true([&] { return test::read_text(log).find("\n100,") != std::string::npos; }));
  EXPECT_EQ(process.terminate(), 0) << process.messages();
  const auto json = nlohmann::json::parse(test::read_text(report));
  for (const char* field : {"dds", "loop", "round_trip_us", "sent", "answers", "lost", "unanswered",
                            "refused", "expired", "energy_j", "faults", "hands", "link"}) {
    EXPECT_TRUE(json.contains(field)) << field;
  }
  for (const char* field : {"tool_to_force_us", "tool_to_organ_us", "tool_to_picture_us"}) {
    EXPECT_TRUE(json["link"].contains(field)) << field;
  }
  EXPECT_EQ(json["hands"].size(), 2u);
  EXPECT_EQ(json["sent"], 2 * json["loop"]["ticks"].get<int>());
  EXPECT_EQ(json["faults"].size(), 0u);
}

TEST_F(VirtualDevice, ARecordedHandCanBePlayedAgain) {
  const std::string trace = (folder / "trace.csv").string(), again = (folder / "again.csv").string();
  const std::vector<std::string> shared{"--scene", kScene, "--domain", domain, "--seconds", "0.5"};
  auto record = shared, play = shared;
  record.insert(record.end(), {"--record", trace});
  play.insert(play.end(), {"--trace", trace, "--record", again});
  EXPECT_EQ(test::Process("virtual_device", record).wait(), 0);
  EXPECT_EQ(test::Process("virtual_device", play).wait(), 0);
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_GT(lines(test::read_text(trace)), 100);
  EXPECT_GT(lines(test::read_text(again)), 100);
}

}  // namespace
}  // namespace omentum::device
