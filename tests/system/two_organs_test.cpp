// Two organs in one session: each hand moves the one that it presses, and no other.
#include "tests/system/session_on_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace omentum::test {
namespace {

constexpr double kFelt_n = 0.1;     // a tip that sinks some millimetres into soft tissue feels more than this
constexpr double kMoved_m = 0.001;  // and moves its surface by more than this
constexpr std::size_t kStatesInARow = 10;              // 0.1 s: not one contact that was lost or late
constexpr std::uint32_t kLiver = 0, kGallbladder = 1;  // organs, and the tools whose hands press them

const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/two_organs.toml";

/// How far the organs are moved in one and the same state of both, m.
using Moved = std::array<double, 2>;

/// Listens for states and keeps of each how far it is from rest: whole states, copied at every look, would
/// keep a small machine busy. Each is sent as one block.
class MovedOrgans {
 public:
  explicit MovedOrgans(int domain)
      : bus_(transport::Bus::open({.vendor = transport::Vendor::kCyclone, .domain = domain, .name = "eye"})),
        reader_(bus_->reader<msg::OrganState>([this](const msg::OrganState& state) { keep(state); })) {}

  std::vector<Moved> together() {
    const std::lock_guard lock(mutex_);
    std::vector<Moved> moved;
    for (const auto& [seq, of_organ] : states_)
      if (of_organ.size() == 2) moved.push_back({of_organ.at(kLiver), of_organ.at(kGallbladder)});
    return moved;
  }

 private:
  void keep(const msg::OrganState& state) {
    double largest_m = 0;
    for (const float u : state.values) largest_m = std::max(largest_m, std::abs(static_cast<double>(u)));
    const std::lock_guard lock(mutex_);
    states_[state.seq][state.organ] = largest_m;
  }

  std::mutex mutex_;
  std::map<std::uint64_t, std::map<std::uint32_t, double>> states_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Reader<msg::OrganState>> reader_;
};

/// Whether for some states in a row those organs were moved, and the others at rest.
bool moved_for_a_while(const std::vector<Moved>& moved, const std::array<bool, 2>& wanted) {
  const auto is = [](double moved_m, bool wanted) { return wanted ? moved_m > kMoved_m : moved_m == 0; };
  std::size_t in_a_row = 0;
  return std::ranges::any_of(moved, [&](const Moved& m) {
    const bool as_wanted = is(m[kLiver], wanted[kLiver]) && is(m[kGallbladder], wanted[kGallbladder]);
    in_a_row = as_wanted ? in_a_row + 1 : 0;
    return in_a_row == kStatesInARow;
  });
}

class TwoOrgansTest : public ::testing::TestWithParam<std::string> {};

// The scene's hands press one after the other, then both at the same time, then one after the other again.
TEST_P(TwoOrgansTest, EachHandMovesItsOwnOrganAloneAndBothMoveTogether) {
  const ScratchFolder folder;
  const std::string scene = prepare_scene(kScene, {}, folder.path());
  ASSERT_FALSE(scene.empty());
  SessionOnTrial session(scene, all_on(GetParam()));
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  MovedOrgans organs(session.domain());
  session.start_all({"haptic_node", "deform_node", "virtual_device"});
  for (const std::array<bool, 2> who : {std::array{true, false}, {true, true}, {false, true}}) {
    EXPECT_TRUE(comes_true([&] { return moved_for_a_while(organs.together(), who); }))
        << "liver " << who[0] << ", gallbladder " << who[1] << ", in " << organs.together().size()
        << " states: " << session["haptic_node"].messages() << session["deform_node"].messages();
  }
  EXPECT_TRUE(comes_true([&] { return observer.force_n(0) > kFelt_n && observer.force_n(1) > kFelt_n; }));
  for (const msg::Contact& contact : observer.contacts())
    EXPECT_TRUE(contact.nodes.empty() || contact.organ == contact.tool) << "a hand touches the other's organ";
}

INSTANTIATE_TEST_SUITE_P(Vendors, TwoOrgansTest, ::testing::Values("fast", "cyclone"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace omentum::test
