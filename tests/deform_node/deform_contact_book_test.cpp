#include "deform_node/contact_book.h"

#include "node_common/contact_bounds.h"
#include "tests/deform_node/deform_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace omentum::deform {
namespace {

using deform_test::contact_on;
using deform_test::file_node;
using deform_test::kNs_per_s;
using deform_test::node_of;
using deform_test::odd_numbers;

constexpr std::int32_t kSurfaceNodes = 20;
constexpr std::int32_t kPinned = 4;
constexpr std::uint32_t kTools = 0b11011;  // of the scene
constexpr double kMaxForce_n = 10, kReach_m = 0.05;
const Vec3 kPush(0, 0, -1);

class ContactBookTest : public ::testing::Test {
 protected:
  runtime::FaultList faults_;
  const physics::SurfaceCompliance compliance_ = deform_test::random_compliance(kSurfaceNodes - kPinned, 3);
  ContactBook book_{{organ()}, {.tools = kTools, .max_force_n = kMaxForce_n}, faults_};

  OrganNumbers organ() const {
    OrganNumbers numbers = odd_numbers(kSurfaceNodes, kPinned);
    numbers.reach_m = kReach_m;
    numbers.compliance = &compliance_;
    return numbers;
  }
  /// How often contacts were dropped, and for how many reasons.
  std::pair<std::uint64_t, std::size_t> dropped() const {
    std::uint64_t counted = 0;
    for (const runtime::Fault& fault : faults_.list()) counted += fault.count;
    return {counted, faults_.list().size()};
  }

  double push_at(double seconds) {
    book_.advance(static_cast<std::int64_t>(seconds * kNs_per_s));
    const auto loads = book_.loads(0);
    return loads.empty() ? 0 : -loads.front().forces.front().z();
  }
};

TEST(StalenessGain, IsOneWhileFreshThenFallsLinearlyToZero) {
  EXPECT_EQ(staleness_gain(0), 1);
  EXPECT_EQ(staleness_gain(kContactStale_s), 1);
  EXPECT_NEAR(staleness_gain(kContactStale_s + kContactFade_s / 2), 0.5, 1e-12);
  EXPECT_EQ(staleness_gain(kContactStale_s + kContactFade_s), 0);
  EXPECT_EQ(staleness_gain(1e6), 0);
}

TEST_F(ContactBookTest, SilentSenderFadesToNothingAndANewContactCountsInFull) {
  book_.take(contact_on(0, {3}, {kPush}), kNs_per_s);
  EXPECT_DOUBLE_EQ(push_at(1.05), 1);
  double last = 1;
  for (double t = 1 + kContactStale_s; t < 1 + kContactStale_s + kContactFade_s; t += 0.01) {
    const double now = push_at(t);
    EXPECT_LE(now, last);
    EXPECT_LE(last - now, 0.01 / kContactFade_s + 1e-6) << "a jump at " << t;
    last = now;
  }
  push_at(1 + kContactStale_s + kContactFade_s / 2);
  EXPECT_NEAR(book_.loads(0)[0].gain, 0.5, 1e-9) << "models are told";
  EXPECT_EQ(push_at(1 + kContactStale_s + kContactFade_s), 0);
  book_.take(contact_on(0, {3}, {kPush}), 2 * kNs_per_s);
  EXPECT_DOUBLE_EQ(push_at(2), 1);
}

TEST_F(ContactBookTest, NewestContactOfEachToolCounts) {
  book_.take(contact_on(0, {1, 2}, {kPush, kPush}), kNs_per_s);
  book_.take(contact_on(0, {5}, {2 * kPush}), kNs_per_s);
  msg::Contact grasp = contact_on(3, {6}, {3 * kPush});
  grasp.grasping = true;
  book_.take(grasp, kNs_per_s);
  book_.advance(kNs_per_s);
  const auto loads = book_.loads(0);
  ASSERT_EQ(loads.size(), 2U);
  EXPECT_FALSE(loads[0].grasps);
  EXPECT_TRUE(loads[1].grasps);
  EXPECT_THAT(loads[0].nodes, ::testing::ElementsAre(node_of(5)));
  EXPECT_EQ(loads[0].forces[0], 2 * kPush);
  EXPECT_EQ(loads[1].tool, 3U);
  EXPECT_THAT(loads[1].nodes, ::testing::ElementsAre(node_of(6)));
}

// Two organs, tools 0 and 3: what a tool does to one is nobody else's.
class TwoOrgansTest : public ContactBookTest {
 protected:
  ContactBook both_{{organ(), organ()}, {.tools = kTools, .max_force_n = kMaxForce_n}, faults_};

  void take(std::uint32_t organ, msg::Contact contact, double seconds) {
    contact.organ = organ;
    both_.take(contact, static_cast<std::int64_t>(seconds * kNs_per_s));
  }
  /// Of tool 0 on the organ, N; and how many tools load it.
  std::pair<double, std::size_t> load(std::uint32_t organ, double seconds) {
    both_.advance(static_cast<std::int64_t>(seconds * kNs_per_s));
    const auto loads = both_.loads(organ);
    return {loads.empty() ? 0 : -loads.front().forces.front().z(), loads.size()};
  }
};

TEST_F(TwoOrgansTest, AToolMayPressBothAtOnce) {
  take(0, contact_on(0, {3}, {kPush}), 1);
  take(1, contact_on(0, {3}, {2 * kPush}), 1);
  take(1, contact_on(3, {3}, {3 * kPush}), 1);
  EXPECT_EQ(load(0, 1), std::pair(1.0, std::size_t{1}));
  EXPECT_EQ(load(1, 1), std::pair(2.0, std::size_t{2}));
}

TEST_F(TwoOrgansTest, AToolThatGoesToAnotherLeavesNoLoadBehind) {
  take(0, contact_on(0, {3}, {kPush}), 1);
  take(0, contact_on(0, {}, {}), 1.004);
  take(1, contact_on(0, {5}, {kPush}), 1.004);
  EXPECT_EQ(load(0, 1.005).second, 0u);
  EXPECT_EQ(load(1, 1.005).second, 1u);
}

TEST_F(TwoOrgansTest, WithoutAnEmptyContactWhatWasLeftFades) {
  take(0, contact_on(0, {3}, {kPush}), 1);
  const double gone_s = 1 + kContactStale_s + kContactFade_s;
  take(1, contact_on(0, {5}, {kPush}), gone_s);
  EXPECT_EQ(load(0, gone_s).second, 0u);
  EXPECT_EQ(load(1, gone_s).second, 1u);
}

TEST_F(TwoOrgansTest, TheEchoIsTheNewestOfAllOrgans) {
  msg::Contact later = contact_on(0, {}, {});
  later.cause.seq = 500;
  take(1, later, 2);
  take(0, contact_on(0, {3}, {kPush}), 1);
  load(0, 2);
  ASSERT_EQ(both_.echoes().size(), 1u);
  EXPECT_EQ(both_.echoes()[0].seq, 500u);
}

TEST_F(ContactBookTest, EchoesTheNewestPoseOfEachTool) {
  book_.take(contact_on(1, {}, {}), kNs_per_s);
  book_.take(contact_on(4, {2}, {kPush}), kNs_per_s);
  book_.advance(kNs_per_s);
  ASSERT_EQ(book_.echoes().size(), 2U);
  EXPECT_EQ(book_.echoes()[0].seq, 101U);
  EXPECT_EQ(book_.echoes()[1].tool, 4U);
}

TEST_F(ContactBookTest, ForgottenContactsComeBackOnlyWithANewSample) {
  book_.take(contact_on(0, {3}, {kPush}), kNs_per_s);
  book_.forget(kNs_per_s);
  EXPECT_EQ(push_at(1.01), 0);
  book_.take(contact_on(0, {3}, {kPush}), kNs_per_s + 1);
  EXPECT_EQ(push_at(1.01), 1);
}

TEST_F(ContactBookTest, PinnedNodesAreLeftOutWithoutFault) {
  book_.take(contact_on(0, {kSurfaceNodes - 1, 3}, {kPush, 2 * kPush}), kNs_per_s);
  book_.advance(kNs_per_s);
  ASSERT_EQ(book_.loads(0).size(), 1U);
  EXPECT_THAT(book_.loads(0)[0].nodes, ::testing::ElementsAre(node_of(3)));
  EXPECT_EQ(book_.loads(0)[0].forces[0], 2 * kPush);
  EXPECT_FALSE(faults_.any());
}

TEST_F(ContactBookTest, BadContactsAreDroppedAndCountedAndTheLastGoodOneStays) {
  const msg::Contact good = contact_on(0, {3}, {kPush});
  std::vector<msg::Contact> bad(8, good);
  bad[0].tool = msg::MAX_TOOLS;
  bad[1].organ = 1;
  bad[2].topology_version = 1;
  bad[3].forces.clear();
  bad[4].displacements.resize(2);
  bad[5].nodes[0] = 2 * kSurfaceNodes + 1;  // beyond the file
  bad[6].nodes[0] = file_node(3) + 1;       // inside the organ
  bad[7].forces[0].y = std::numeric_limits<double>::quiet_NaN();
  book_.take(good, kNs_per_s);
  for (const msg::Contact& contact : bad) book_.take(contact, kNs_per_s + 1);
  EXPECT_EQ(push_at(1.01), 1);
  EXPECT_EQ(dropped(), std::pair(std::uint64_t{bad.size()}, std::size_t{6})) << "one line per kind";
}

TEST_F(ContactBookTest, OnlyTheScenesToolsPress) {
  book_.take(contact_on(2, {3}, {kPush}), kNs_per_s);
  msg::Contact for_another = contact_on(0, {3}, {kPush});
  for_another.cause.tool = 1;  // its echo would be another tool's
  book_.take(for_another, kNs_per_s);
  EXPECT_EQ(push_at(1.01), 0);
  EXPECT_TRUE(book_.echoes().empty());
  EXPECT_EQ(dropped(), std::pair(std::uint64_t{2}, std::size_t{1}));
}

TEST_F(ContactBookTest, ForcesBeyondTheScenesAreDropped) {
  const double most = node::kTissueHeadRoom * kMaxForce_n;
  for (const double force_n : {1.001 * most, 1e30, 1e300}) {
    book_.take(contact_on(0, {3}, {force_n * kPush}), kNs_per_s);
    book_.take(contact_on(0, {3, 4}, {force_n / 2 * kPush, -force_n / 2 * kPush}), kNs_per_s);  // in sum 0
  }
  EXPECT_EQ(push_at(1.01), 0);
  EXPECT_EQ(dropped(), std::pair(std::uint64_t{6}, std::size_t{1}));
}

// C has entries of up to 1e-4 m/N here: what is within the force's bound may still be a displacement of none.
TEST_F(ContactBookTest, WhatWouldMoveTheOrganBeyondItsSizeIsDropped) {
  const double column_m_n = (compliance_.block(SurfaceId(3), SurfaceId(3)) * kPush).norm();
  book_.take(contact_on(0, {3}, {1.01 * kReach_m / column_m_n * kPush}), kNs_per_s);
  EXPECT_EQ(push_at(1.01), 0);
  EXPECT_EQ(dropped(), std::pair(std::uint64_t{1}, std::size_t{1}));
  book_.take(contact_on(0, {3}, {0.99 * kReach_m / column_m_n * kPush}), kNs_per_s);
  EXPECT_GT(push_at(1.01), 0);
  msg::Contact claims = contact_on(0, {3}, {kPush});
  claims.displacements[0].x = 1e30;
  book_.take(claims, kNs_per_s);
  EXPECT_EQ(dropped().first, 2u);
}

}  // namespace
}  // namespace omentum::deform
