// Which organs touch which, from the collision to the wire.
#include "deform_node/touch_publisher.h"

#include "tests/deform_node/gut_stage.h"
#include "tests/deform_node/read_stress.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>

#include <random>

namespace omentum::deform {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kTouchTick_s = 0.01;

/// Spheres that go where they are pushed, without friction, each second tick or in each.
class Marbles final : public OrganModel {
 public:
  Marbles(std::vector<CollisionSphere> marbles, bool rests, int ticks_per_step = 1)
      : spheres(std::move(marbles)), rests_(rests), ticks_per_step_(ticks_per_step) {}
  ModelSizes sizes() const override { return {.spheres = spheres.size(), .keeps_pushes = rests_}; }
  void step(const TickLoads&, double) noexcept override { steps_ += ++ticks_ % ticks_per_step_ == 0; }
  void reset() noexcept override {}
  OrganView view() const noexcept override { return {}; }
  ModelStatus status() const noexcept override { return {.steps = steps_}; }
  std::span<const CollisionSphere> collidable() const noexcept override { return spheres; }
  void respond(std::span<const OrganContact> contacts) noexcept override {
    for (const OrganContact& contact : contacts)
      spheres[static_cast<std::size_t>(contact.sphere)].velocity +=
          contact.share * contact.push_m_s * contact.normal;
  }
  std::size_t touches_itself(std::span<physics::Touch> found) const noexcept override {
    const std::size_t count = std::min(found.size(), own_touches.size());
    std::copy_n(own_touches.begin(), count, found.begin());
    return count;
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const CollisionSphere& sphere : spheres) sum += sphere.mass_kg * sphere.velocity;
    return sum;
  }

  std::vector<CollisionSphere> spheres;
  std::vector<physics::Touch> own_touches;

 private:
  bool rests_;
  int ticks_per_step_, ticks_ = 0;
  std::uint64_t steps_ = 1;
};

CollisionSphere marble(const Vec3& centre, double radius_m, double mass_kg) {
  return {.centre = centre, .velocity = Vec3::Zero(), .radius_m = radius_m, .mass_kg = mass_kg};
}

std::vector<CollisionSphere> heap_of_marbles(unsigned seed, const Vec3& about) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.05, 0.05), size(0.008, 0.015), mass(0.01, 0.1);
  std::vector<CollisionSphere> heap;
  for (int i = 0; i < 40; ++i) {
    const Vec3 off(place(random), place(random), place(random));
    heap.push_back(marble(about + off, size(random), mass(random)));
  }
  return heap;
}

TEST(OrganTouches, AreThePairsThatOverlapAndPushEachSideAsHard) {
  Marbles one(heap_of_marbles(1, Vec3::Zero()), false), other(heap_of_marbles(2, Vec3(0.05, 0, 0)), false);
  const auto still_one = one.spheres, still_other = other.spheres;
  OrganCollision collision({&one, &other});
  ASSERT_TRUE(collision.run());
  collision.note_touches(kTouchTick_s);
  ASSERT_EQ(collision.couple_count(), 1U);
  const OrganCollision::Met met = collision.met(0);
  std::vector<std::pair<Vec3, Vec3>> told;
  Vec3 on_one = Vec3::Zero();
  double pushes_n = 0;
  for (const physics::Touch& touch : met.touches) {
    EXPECT_TRUE(touch.overlap_m() > 0 || touch.push_n > 0);
    EXPECT_GT(touch.overlap_m(), -kNear_m);
    told.emplace_back(touch.one, touch.other);
    on_one += touch.push_n * (touch.one - touch.other).normalized();
    pushes_n += touch.push_n;
  }
  EXPECT_GT(pushes_n, 1);
  // by trying all
  const auto& [of_one, of_other] =
      met.one == 0 ? std::tie(still_one, still_other) : std::tie(still_other, still_one);
  std::size_t overlapping = 0;
  for (const CollisionSphere& a : of_one)
    for (const CollisionSphere& b : of_other)
      if ((a.centre - b.centre).norm() < a.radius_m + b.radius_m) {
        ++overlapping;
        EXPECT_THAT(told, ::testing::Contains(std::pair(a.centre, b.centre)));
      }
  EXPECT_GT(overlapping, 8U);
  // each side's momentum, which was none, is the forces' over the tick
  const Marbles &first = met.one == 0 ? one : other, &second = met.one == 0 ? other : one;
  const double rounding = 1e-12 * pushes_n;
  EXPECT_LT((first.momentum() - kTouchTick_s * on_one).norm(), rounding);
  EXPECT_LT((second.momentum() + kTouchTick_s * on_one).norm(), rounding);
}

TEST(OrganTouches, OfTwoThatWaitForAStepAreThoseOfTheLastOneOverAllThatTime) {
  constexpr double kMarble_kg = 0.1;
  Marbles one({marble(Vec3::Zero(), 0.01, kMarble_kg)}, true, 2);
  Marbles other({marble(Vec3(0.015, 0, 0), 0.01, kMarble_kg)}, true, 2);
  OrganCollision collision({&one, &other});
  // the push that is told, and the momentum that it was
  const auto tick = [&] {
    one.spheres[0].velocity = other.spheres[0].velocity = Vec3::Zero();
    one.step({}, kTouchTick_s);
    other.step({}, kTouchTick_s);
    EXPECT_TRUE(collision.run());
    collision.note_touches(kTouchTick_s);
    const auto touches = collision.met(0).touches;
    return std::pair(touches.empty() ? -1 : touches[0].push_n, kMarble_kg * one.spheres[0].velocity.norm());
  };
  tick();
  const auto [stepped_n, of_step] = tick();
  EXPECT_NEAR(stepped_n, of_step / kTouchTick_s, 1e-9 * stepped_n);
  const auto [waiting_n, of_waiting] = tick();
  EXPECT_EQ(of_waiting, 0);
  EXPECT_EQ(waiting_n, stepped_n);
  const auto [next_n, of_next] = tick();
  EXPECT_GT(of_next, 0);
  EXPECT_NEAR(next_n, of_next / (2 * kTouchTick_s), 1e-9 * next_n);
}

TEST(HardestPushed, AreAllWhereTheyFitAndElseNoneIsSofterThanOneLeftOut) {
  std::vector<TouchingPart> parts(msg::MAX_TOUCHING_PAIRS + 500);
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].touch.push_n = static_cast<double>((i * 7919) % parts.size());
  EXPECT_EQ(hardest_pushed(std::span(parts).first(30)).size(), 30U);
  const auto hardest = hardest_pushed(parts);
  ASSERT_EQ(hardest.size(), msg::MAX_TOUCHING_PAIRS);
  for (const TouchingPart& part : hardest) EXPECT_GE(part.touch.push_n, 500);
}

/// Two heaps of marbles and a publisher of what they do.
class TouchPublisherTest : public testing::Test {
 protected:
  TouchPublisherTest() {
    for (const auto& heap : {heap_of_marbles(1, Vec3::Zero()), heap_of_marbles(2, Vec3(0.05, 0, 0))})
      served_.emplace_back().model = std::make_unique<Marbles>(heap, false);
    auto& first = static_cast<Marbles&>(*served_[0].model);
    first.own_touches.assign(
        3, {.one = Vec3(0.01, 0, 0), .radius_one_m = 0.01, .radius_other_m = 0.01, .push_n = 0.5});
  }
  static std::vector<OrganModel*> models(const std::vector<ServedOrgan>& organs) {
    std::vector<OrganModel*> all;
    for (const ServedOrgan& organ : organs) all.push_back(organ.model.get());
    return all;
  }

  std::vector<ServedOrgan> served_;
  runtime::FaultList faults_;
  ReadSamples<msg::TouchingPairs> written_;
};

TEST_F(TouchPublisherTest, TellsAMomentInBlocksOnlyToWhoReads) {
  OrganGroup organs(std::move(served_), faults_, 1);
  ContactBook book({{}, {}}, {}, faults_);
  TouchPublisher publisher(written_, organs, 10, 20, work_at_once);  // each tick is due
  const auto tick = [&](std::uint64_t seq) {
    organs.step(book, kTouchTick_s);
    publisher.offer({.seq = seq, .stamp_ns = 10 * static_cast<std::int64_t>(seq)});
  };
  tick(1);
  EXPECT_THAT(written_.all(), IsEmpty());
  written_.readers = 1;
  tick(2);
  EXPECT_THAT(written_.all(), IsEmpty()) << "only now it is known that somebody reads";
  tick(3);
  const std::size_t heap = test::heap_allocations();
  TouchingParts parts(4000);
  const std::size_t of_room = test::heap_allocations() - heap;
  parts.take(organs);
  EXPECT_EQ(test::heap_allocations() - heap, of_room);
  const std::vector<msg::TouchingPairs>& blocks = written_.all();
  ASSERT_GT(blocks.size(), 1U);
  std::size_t pairs = 0, of_one_organ = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    EXPECT_EQ(blocks[b].block, b);
    EXPECT_EQ(blocks[b].block_count, blocks.size());
    EXPECT_EQ(blocks[b].seq, 3U);
    EXPECT_EQ(blocks[b].stamp_ns, 30);
    EXPECT_EQ(blocks[b].touching, parts.all().size());
    EXPECT_LE(blocks[b].pairs.size(), 10U);
    pairs += blocks[b].pairs.size();
    for (const msg::TouchingPair& pair : blocks[b].pairs) of_one_organ += pair.organ_one == pair.organ_other;
  }
  EXPECT_EQ(pairs, parts.all().size());
  EXPECT_EQ(of_one_organ, 3U);
  EXPECT_EQ(publisher.told(), 1U);
  written_.readers = 0;
  tick(5);
  const std::size_t last = written_.all().size();
  tick(6);
  EXPECT_EQ(written_.all().size(), last);
}

TEST_F(TouchPublisherTest, WhereNothingTouchesOneBlockSaysSo) {
  served_.resize(1);
  static_cast<Marbles&>(*served_[0].model).own_touches.clear();
  OrganGroup organs(std::move(served_), faults_, 1);
  TouchPublisher publisher(written_, organs, 10, 20, work_at_once);
  written_.readers = 1;
  for (std::uint64_t seq = 1; seq < 3; ++seq) publisher.offer({.seq = seq});
  ASSERT_THAT(written_.all(), SizeIs(1));
  EXPECT_EQ(written_.all()[0].block_count, 1U);
  EXPECT_THAT(written_.all()[0].pairs, IsEmpty());
}

TEST(GutTouchesItself, AsItsSystemDoes) {
  GutModel gut = gut_model({.gravity_m_s2 = Vec3(0, 0, -9.81), .obstacles = {{.centre = Vec3(0, 0, -0.06)}}});
  for (int tick = 0; tick < 100; ++tick) gut.step({}, kGutTick_s);
  std::vector<physics::Touch> touches(500);
  touches.resize(gut.touches_itself(touches));
  EXPECT_FALSE(touches.empty());
  double hardest_n = 0;
  for (const physics::Touch& touch : touches) hardest_n = std::max(hardest_n, touch.push_n);
  EXPECT_GT(hardest_n, 0);
  EXPECT_LT(hardest_n, 10) << "this gut weighs a few newtons";
}

}  // namespace
}  // namespace omentum::deform
