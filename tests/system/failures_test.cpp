// Processes of a session die or freeze at any moment, in any order, on any vendor: the others go on, whoever
// comes back finds the same organ, and no hand is struck. OMENTUM_FAILURES=200 tries as many, OMENTUM_SEED
// others.
#include "tests/system/cut_observer.h"
#include "tests/system/hurried_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace omentum::test {
namespace {

using std::chrono::milliseconds;

constexpr int kFewTrials = 5;                                 // in the test command
constexpr int kEarlier_ms = 600;                              // the longest that all are left alone before
constexpr int kShortestStop_ms = 20, kLongestStop_ms = 2500;  // past every lease and deadline
constexpr double kHurry = 3, kMax_n = 10;
constexpr std::array<const char*, 4> kNames{"haptic_node", "deform_node", "render_node", "virtual_device"};

int number_of(const char* variable, int otherwise) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? otherwise : std::atoi(value);
}

class FailuresTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : kNames) start(name);
    ASSERT_TRUE(all_at_work()) << everybodys_words();
  }

  // on a vendor that the dice choose
  void start(const std::string& name) {
    session_.set_vendor(name, below(2) == 0 ? "fast" : "cyclone");
    session_.start(name, name == "deform_node" ? std::vector<std::string>{"--journal", journal_}
                                               : std::vector<std::string>{});
  }
  void kill_and_start(const std::string& name) {
    session_.kill(name);
    if (name == "virtual_device") expect_free_hand();
    if (name == "haptic_node") judge_forces();
    start(name);
  }
  void freeze(const std::string& name) {
    session_[name].send(SIGSTOP);
    const int stop_ms = kShortestStop_ms + below(kLongestStop_ms - kShortestStop_ms);
    std::this_thread::sleep_for(milliseconds(stop_ms));
    if (name == "virtual_device" && stop_ms > kLongestStop_ms / 2) expect_free_hand();
    session_[name].send(SIGCONT);
  }

  // Within a time that only a failure takes: forces, states, pictures.
  bool all_at_work() {
    observer_.forget();
    return comes_true([&] {
      const auto picture = observer_.status(msg::NODE_RENDER);
      return observer_.forces().size() > 200 && observer_.state() && picture && !picture->echoes.empty();
    });
  }
  void expect_free_hand() {
    EXPECT_TRUE(comes_true([&] { return observer_.force_n() == 0; }))
        << "a force is left though nobody holds the tool";
  }
  // Of what one haptic_node told since the last time.
  void judge_forces() {
    const std::vector<msg::ToolForce> felt = observer_.forces();
    for (const msg::ToolForce& force : felt) {
      const double force_n = Eigen::Vector3d(force.force.x, force.force.y, force.force.z).norm();
      EXPECT_LE(force_n, kMax_n * (1 + 1e-9));
    }
    EXPECT_LE(steepest(felt, 0), 1 + 1e-6) << "the hand was struck";
    observer_.forget();
  }
  void judge_cuts() {
    for (msg::Topology& heard : seen_.take()) {
      if (newest_) {
        EXPECT_GE(heard.version, newest_->version);
        EXPECT_TRUE(holds_all(heard, *newest_)) << "what was cut is whole again";
      }
      newest_ = std::move(heard);
    }
  }
  void expect_all_alive() {
    for (const char* name : kNames)
      EXPECT_TRUE(session_[name].running()) << name << ": " << session_[name].messages();
  }

  int below(int count) { return static_cast<int>(dice_() % static_cast<unsigned>(count)); }
  std::string everybodys_words() {
    std::string words;
    for (const char* name : kNames) words += std::string(name) + ": " + session_[name].messages() + "\n";
    return words;
  }

  std::mt19937 dice_{static_cast<unsigned>(number_of("OMENTUM_SEED", 1998))};
  ScratchFolder folder_;
  std::string journal_ = folder_ / "cuts.json";
  SessionOnTrial session_{prepare_hurried("plate_cut", kHurry, folder_.path()), all_on("fast")};
  Observer observer_{session_.domain(), transport::Vendor::kCyclone};
  CutObserver seen_{session_.domain()};
  std::optional<msg::Topology> newest_;
};

TEST_F(FailuresTest, WhoeverDiesOrFreezesTheOthersGoOnAndNoHandIsStruck) {
  const int trials = number_of("OMENTUM_FAILURES", kFewTrials);
  for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
    std::this_thread::sleep_for(milliseconds(below(kEarlier_ms)));
    const std::string name = kNames[static_cast<std::size_t>(trial < 4 ? trial : below(4))];
    const bool dies = below(2) == 0;
    SCOPED_TRACE("trial " + std::to_string(trial) + ": " + name + (dies ? " is killed" : " is frozen"));
    dies ? kill_and_start(name) : freeze(name);
    if (!dies || name != "haptic_node") judge_forces();
    EXPECT_TRUE(all_at_work()) << everybodys_words();
    expect_all_alive();
    judge_forces();
    judge_cuts();
  }
  for (const char* name : kNames) EXPECT_EQ(session_[name].terminate(), 0) << session_[name].messages();
  EXPECT_TRUE(newest_ && removed(*newest_) > 0) << "nothing was cut";
}

}  // namespace
}  // namespace omentum::test
