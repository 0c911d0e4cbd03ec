// Two real deform_nodes with the same organ: one serves, the other one stands by. How they agree is asked of
// their loops (deform_loop_test.cpp); here one is killed.
#include "tests/support/block_scene.h"
#include "transport/bus.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>

namespace omentum {
namespace {

// Who still serves beside another one tells as often as that: so many statuses alone are one that serves
// alone.
constexpr int kAlone = 5;

class DeformPairTest : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<std::string> arguments() const {
    return {"--scene", block_.scene(), "--dds", GetParam(), "--domain", std::to_string(domain_)};
  }
  /// Waits until one node alone tells statuses and states come; its instance, 0 when none does.
  std::uint64_t who_serves_alone() {
    std::uint64_t alone = 0;
    {
      const std::lock_guard lock(mutex_);
      in_a_row_ = 0;
      states_ = 0;
    }
    test::comes_true([&] {
      const std::lock_guard lock(mutex_);
      alone = in_a_row_ >= kAlone && states_ > 0 ? newest_ : 0;
      return alone != 0;
    });
    return alone;
  }

 private:
  void take(const msg::NodeStatus& status) {
    if (status.kind != msg::NODE_DEFORM) return;
    const std::lock_guard lock(mutex_);
    in_a_row_ = status.instance == newest_ ? in_a_row_ + 1 : 1;
    newest_ = status.instance;
  }
  void count_state() {
    const std::lock_guard lock(mutex_);
    ++states_;
  }

  test::BlockScene block_{4};
  int domain_ = test::domain_of_test();
  std::mutex mutex_;
  std::uint64_t newest_ = 0;
  int in_a_row_ = 0, states_ = 0;
  std::unique_ptr<transport::Bus> bus_ = transport::Bus::open(
      {.vendor = transport::parse_vendor(GetParam()), .domain = domain_, .name = "test"});
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_ =
      bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& status) { take(status); });
  std::unique_ptr<transport::Reader<msg::OrganState>> organ_states_ =
      bus_->reader<msg::OrganState>([this](const msg::OrganState&) { count_state(); });
};

TEST_P(DeformPairTest, TheSecondStandsByAndTakesOverFromAKilledOne) {
  test::Process first("deform_node", arguments());
  const std::uint64_t served = who_serves_alone();
  ASSERT_NE(served, 0u) << first.messages();
  test::Process second("deform_node", arguments());
  EXPECT_TRUE(test::comes_true(
      [&] { return second.messages().find("stands by") != std::string::npos || !second.running(); }));
  EXPECT_EQ(who_serves_alone(), served) << second.messages();
  EXPECT_TRUE(second.running());

  first.end(SIGKILL);
  EXPECT_TRUE(test::comes_true([&] { return who_serves_alone() != served; })) << second.messages();
  EXPECT_NE(who_serves_alone(), 0u);
  EXPECT_EQ(second.terminate(), 0) << second.messages();
}

INSTANTIATE_TEST_SUITE_P(Vendors, DeformPairTest, ::testing::Values("fast", "cyclone"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace omentum
