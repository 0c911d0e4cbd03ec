// Strokes on their way from contacts to the organs: each part of a cut once, whatever the wire loses.
#include "deform_node/contact_book.h"

#include "tests/deform_node/deform_fixtures.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace omentum::deform {
namespace {

using deform_test::contact_on;
using deform_test::kNs_per_s;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kSample_s = 0.004;

msg::Edge edge_at(double x_m) {
  return {.begin = {.x = x_m, .y = 0, .z = 0}, .end = {.x = x_m, .y = 0.01, .z = 0}};
}

/// One tool that cuts along x, told in samples of which some are lost.
class CutBookTest : public ::testing::Test {
 protected:
  /// The next sample: the blade went on to x. `heard`: it comes.
  void sample(double x_m, bool cutting, bool heard = true) {
    const bool begins = cutting && !cutting_;
    if (begins) ++cut_count_;
    msg::Contact contact = contact_on(0, {}, {});
    contact.seq = ++seq_;
    contact.cutting = cutting;
    contact.cut_count = cut_count_;
    contact.edge_before = edge_at(cutting ? (begins ? x_m : x_m_) : x_m);
    contact.edge = edge_at(x_m);
    cutting_ = cutting;
    x_m_ = x_m;
    now_s_ += kSample_s;
    newest_ = contact;
    if (heard) take(contact);
  }
  void take(const msg::Contact& contact) { book_.take(contact, now_ns()); }
  std::int64_t now_ns() const { return static_cast<std::int64_t>(now_s_ * kNs_per_s); }
  std::vector<CutStroke> tick() {
    book_.advance(now_ns());
    const auto strokes = book_.cuts(0);
    return {strokes.begin(), strokes.end()};
  }
  /// The strokes follow one another from `from_m` to `to_m`.
  static void expect_way(const std::vector<CutStroke>& strokes, double from_m, double to_m) {
    ASSERT_FALSE(strokes.empty());
    EXPECT_EQ(strokes.front().from[0].x(), from_m);
    EXPECT_EQ(strokes.back().to[0].x(), to_m);
    for (std::size_t i = 1; i < strokes.size(); ++i) EXPECT_EQ(strokes[i].from, strokes[i - 1].to);
  }

  runtime::FaultList faults_;
  ContactBook book_{{deform_test::odd_numbers(4, 0)}, {.tools = 1, .max_force_n = 10}, faults_};
  double now_s_ = 1, x_m_ = 0;
  std::uint64_t seq_ = 0, cut_count_ = 0;
  bool cutting_ = false;
  msg::Contact newest_;
};

TEST_F(CutBookTest, ABladeSweepsEachPartOfItsWayOnce) {
  sample(0, true);
  for (int i = 1; i <= 3; ++i) sample(1e-3 * i, true);
  const auto strokes = tick();
  expect_way(strokes, 0, 3e-3);
  EXPECT_THAT(strokes, SizeIs(3));
  sample(4e-3, true);
  expect_way(tick(), 3e-3, 4e-3);
  sample(4e-3, false);
  EXPECT_THAT(tick(), IsEmpty());
}

TEST_F(CutBookTest, ABladeThatRestsGoesOnBurningWhereItIsUntilItsSenderFallsSilent) {
  sample(2e-3, true);
  for (int i = 0; i < 3; ++i) {
    sample(2e-3, true);
    const auto strokes = tick();
    ASSERT_THAT(strokes, SizeIs(1));
    EXPECT_EQ(strokes[0].from, strokes[0].to);
  }
  now_s_ += kCutSilence_s + kSample_s;
  EXPECT_THAT(tick(), IsEmpty());
}

TEST_F(CutBookTest, ALostSampleLosesNoCut) {
  sample(0, true);
  sample(1e-3, true, false);
  sample(2e-3, true, false);
  sample(3e-3, true);
  expect_way(tick(), 0, 3e-3);
  sample(4e-3, true, false);
  sample(4e-3, false);
  expect_way(tick(), 3e-3, 4e-3);
}

TEST_F(CutBookTest, ALostBeginningIsSweptFromWhereTheNextSampleKnowsIt) {
  sample(0, true, false);
  sample(1e-3, true);
  expect_way(tick(), 0, 1e-3);
}

TEST_F(CutBookTest, TwoCutsAreNotJoined) {
  sample(0, true);
  sample(0, false, false);
  sample(5e-3, true, false);
  sample(6e-3, true);
  const auto strokes = tick();
  ASSERT_THAT(strokes, SizeIs(1));
  expect_way(strokes, 5e-3, 6e-3);
  EXPECT_EQ(strokes[0].cut, 2u);
}

TEST_F(CutBookTest, ARepeatedOrOldSampleCutsNothing) {
  sample(0, true);
  sample(1e-3, true);
  const msg::Contact old = newest_;
  sample(2e-3, true);
  tick();
  take(old);
  take(newest_);
  const auto strokes = tick();
  ASSERT_THAT(strokes, SizeIs(1)) << "it rests";
  EXPECT_EQ(strokes[0].from, strokes[0].to);
  EXPECT_EQ(strokes[0].to[0].x(), 2e-3);
}

TEST_F(CutBookTest, ASenderThatBeginsAgainIsHeard) {
  for (int i = 0; i < 20; ++i) sample(1e-3 * i, true);
  tick();
  now_s_ += 2 * kCutSilence_s;
  seq_ = cut_count_ = 0;
  cutting_ = false;
  sample(0.5, true);
  sample(0.501, true);
  expect_way(tick(), 0.5, 0.501);
}

TEST_F(CutBookTest, WhatFoundNoRoomIsSweptByTheNextSample) {
  sample(0, true);
  for (int i = 1; i <= 500; ++i) sample(1e-4 * i, true);
  const auto first = tick();
  expect_way(first, 0, first.back().to[0].x());
  sample(0.0501, true);
  expect_way(tick(), first.back().to[0].x(), 0.0501);
}

TEST_F(CutBookTest, AfterAResetNothingOfBeforeCuts) {
  sample(0, true);
  sample(1e-3, true);
  book_.forget(now_ns());
  EXPECT_THAT(tick(), IsEmpty());
  sample(2e-3, true);
  expect_way(tick(), 1e-3, 2e-3);
}

TEST_F(CutBookTest, AnEdgeThatIsNoneIsDroppedAndCounted) {
  msg::Contact contact = contact_on(0, {}, {});
  contact.seq = 1;
  contact.cutting = true;
  contact.edge.end.y = std::numeric_limits<double>::quiet_NaN();
  take(contact);
  contact.edge = edge_at(1e6);
  take(contact);
  EXPECT_THAT(tick(), IsEmpty());
  ASSERT_THAT(faults_.list(), SizeIs(1));
  EXPECT_EQ(faults_.list()[0].count, 2u);
}

TEST_F(CutBookTest, ItTakesNoMemory) {
  sample(0, true);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 1000; ++i) {
    msg::Contact& next = newest_;
    next.seq = ++seq_;
    next.edge_before = next.edge;
    next.edge.begin.x += 1e-4;
    take(next);
    if (i % 3 == 0) book_.advance(now_ns());
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

// ---- versions of what is cut

class CutVersionsTest : public CutBookTest {
 protected:
  double push_with(std::uint64_t version) {
    msg::Contact contact = contact_on(0, {1}, {Vec3(0, 0, -1)});
    contact.seq = ++seq_;
    contact.topology_version = version;
    take(contact);
    book_.advance(now_ns());
    const auto loads = book_.loads(0);
    return loads.empty() ? 0 : -loads[0].forces[0].z();
  }
};

TEST_F(CutVersionsTest, AContactMayBeSomeCutsBehindButNotAheadNorBeforeAReset) {
  book_.now_at(0, 5);
  EXPECT_EQ(push_with(6), 0);
  EXPECT_EQ(push_with(3), 1);
  book_.begins_at(0, 7);
  book_.forget(now_ns());
  now_s_ += kSample_s;
  EXPECT_EQ(push_with(5), 0) << "of the organ before the reset";
  EXPECT_EQ(push_with(7), 1);
  EXPECT_EQ(faults_.list()[0].count, 1u) << "of the one ahead";
}

TEST_F(CutVersionsTest, OneThatWasSentBeforeAResetIsAFaultOnlyWhereTheyGoOn) {
  for (const std::uint64_t reset : {7u, 9u}) {
    book_.begins_at(0, reset);
    EXPECT_EQ(push_with(reset - 2), 0);
    now_s_ += 0.9 * kContactStale_s;
    EXPECT_EQ(push_with(reset - 1), 0);
    EXPECT_FALSE(faults_.any()) << "on its way when the organ was reset";
    now_s_ += 0.1 * kContactStale_s;
  }
  now_s_ += kSample_s;
  EXPECT_EQ(push_with(8), 0);
  ASSERT_TRUE(faults_.any()) << "who sends it does not know of the reset";
  EXPECT_EQ(faults_.list()[0].count, 1u);
}

TEST_F(CutVersionsTest, WhoLetsGoSaysNothingOfAVersion) {
  ASSERT_EQ(push_with(0), 1);
  book_.begins_at(0, 9);
  msg::Contact none = contact_on(0, {}, {});
  none.seq = ++seq_;
  take(none);
  book_.advance(now_ns());
  EXPECT_THAT(book_.loads(0), IsEmpty());
  EXPECT_FALSE(faults_.any());
}

TEST_F(CutVersionsTest, AnotherVersionsContactStillCuts) {
  book_.begins_at(0, 9);
  sample(0, true, false);
  newest_.nodes = {deform_test::file_node(1)};
  newest_.forces.resize(1);
  newest_.displacements.resize(1);
  newest_.edge = edge_at(1e-3);
  take(newest_);
  expect_way(tick(), 0, 1e-3);
}

}  // namespace
}  // namespace omentum::deform
