// Programs on a machine that gives them little: a line and exit code 2, never a signal.
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace omentum::test {
namespace {

const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";

using Limited = std::pair<std::string, std::vector<std::string>>;  // a program and its arguments

class LimitsTest : public testing::TestWithParam<Limited> {
 protected:
  // As `ulimit -v` in a user's shell.
  static Process run_with(int kilobytes, const Limited& limited) {
    std::vector<std::string> words = {
        "-c", "ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + "; exec \"$0\" \"$@\"",
        OMENTUM_BIN_DIR "/" + limited.first};
    words.insert(words.end(), limited.second.begin(), limited.second.end());
    return {"/bin/sh", words};
  }
};

// Below these the system's loader itself refuses; above, what libraries start was refused, one at another
// time.
TEST_P(LimitsTest, TooFewAddressesAreSaidInALine) {
  for (const int kilobytes : {130'000, 160'000, 220'000, 300'000, 400'000, 500'000}) {
    SCOPED_TRACE(kilobytes);
    Process process = run_with(kilobytes, GetParam());
    EXPECT_EQ(process.wait(), 2);
    const std::string text = process.messages();
    EXPECT_THAT(text, testing::StartsWith(GetParam().first + ": not enough memory"));
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
  }
}

std::vector<Limited> programs() {
  std::vector<Limited> all = {{"omentum_session", {"pause", "--domain", "97"}}};
  for (const char* node : {"haptic_node", "deform_node", "virtual_device"})
    for (const char* vendor : {"fast", "cyclone"})
      all.emplace_back(node, std::vector<std::string>{"--scene", kScene, "--dds", vendor, "--domain", "97"});
  all.emplace_back("render_node",
                   std::vector<std::string>{"--scene", kScene, "--headless", "--domain", "97"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Programs, LimitsTest, testing::ValuesIn(programs()), [](const auto& info) {
  const auto& words = info.param.second;
  const bool cyclone = std::ranges::find(words, "cyclone") != words.end();
  return info.param.first + (cyclone ? "_cyclone" : "_fast");
});

}  // namespace
}  // namespace omentum::test
