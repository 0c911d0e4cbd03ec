#include "physics/intestine/pair_batch.h"

#include "tests/physics/intestine/gut_shapes.h"
#include "tests/physics/intestine/restless_gut.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::Vec3;

struct Asked {
  std::int32_t segment, part;
  double farthest_m;
};

// Pairs of both kinds in turns, more than a vector unit has lanes.
std::vector<Asked> some_pairs(const GutParts& parts, std::mt19937_64& random) {
  std::uniform_int_distribution<std::int32_t> segments(0, parts.layout.segment_count() - 1),
      all(0, parts.count() - 1);
  std::vector<Asked> pairs;
  while (pairs.size() < 101) {
    const Asked pair{segments(random), all(random), pairs.size() % 3 == 0 ? 0.01 : 10};
    if (pair.part != pair.segment) pairs.push_back(pair);
  }
  return pairs;
}

// Places without a third dimension, without length and without area among them.
std::vector<Vec3> crumpled(const GutParts& parts, std::mt19937_64& random) {
  std::vector<Vec3> x;
  for (std::int32_t m = 0; m < parts.gut.mass_count(); ++m) {
    x.push_back(test::random_vector(random, 0.05));
    if (m % 13 == 12) x.back() = x[x.size() - 2];
    if (m % 7 == 6) x.back() = x[x.size() - 2] + (x[1] - x[0]);
    if (m % 2 == 1) x.back().z() = 0;
  }
  return x;
}

// Of coordinates of 0.05 m.
constexpr double kRounding_m = 1e-9;

// Where several places are equally near, either may be the answer.
void expect_same(const GutParts& parts, std::span<const Vec3> x, const Asked& pair,
                 const PairPlaces& places) {
  const PairPlaces plain = measure(parts, x, pair.segment, pair.part, pair.farthest_m);
  if (plain.distance_m > pair.farthest_m) {
    EXPECT_GT(places.distance_m, pair.farthest_m);
    EXPECT_LE(places.distance_m, measure(parts, x, pair.segment, pair.part, 10).distance_m + kRounding_m);
    return;
  }
  EXPECT_NEAR(places.distance_m, plain.distance_m, kRounding_m) << pair.segment << " " << pair.part;
  const auto [p, q, none] = parts.masses[pair.segment];
  const GutPoint other{parts.masses[pair.part], {places.other[0], places.other[1], places.other[2]}};
  const Vec3 one = x[p] + places.s * (x[q] - x[p]);
  EXPECT_NEAR((one - place_of(other, x)).norm(), places.distance_m, kRounding_m);
  EXPECT_NEAR(places.other.sum(), 1, 1e-9);
}

TEST(PairBatch, SaysWhatThePlainMeasurementSays) {
  std::mt19937_64 random(7);
  const GutParts parts(test::curtain({4, 20}));
  PairBatch batch;
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Vec3> x = crumpled(parts, random);
    const std::vector<Asked> pairs = some_pairs(parts, random);
    batch.clear();
    for (const Asked& pair : pairs) batch.ask(parts, pair.segment, pair.part, pair.farthest_m);
    batch.measure(x);
    EXPECT_EQ(batch.size(), pairs.size());
    for (const Asked& pair : pairs) expect_same(parts, x, pair, batch.next(parts, pair.part));
  }
}

TEST(PairBatch, APairsAnswerDoesNotDependOnWhoIsAskedBesideIt) {
  std::mt19937_64 random(8);
  const GutParts parts(test::curtain({4, 20}));
  const std::vector<Vec3> x = crumpled(parts, random);
  PairBatch together, alone;
  const std::vector<Asked> pairs = some_pairs(parts, random);
  for (const Asked& pair : pairs) together.ask(parts, pair.segment, pair.part, pair.farthest_m);
  together.measure(x);
  for (const Asked& pair : pairs) {
    alone.clear();
    alone.ask(parts, pair.segment, pair.part, pair.farthest_m);
    alone.measure(x);
    const PairPlaces one = alone.next(parts, pair.part), other = together.next(parts, pair.part);
    EXPECT_EQ(one.distance_m, other.distance_m);
    EXPECT_EQ(one.s, other.s);
    EXPECT_EQ(one.other, other.other);
  }
}

TEST(PairBatch, TakesNoMemory) {
  std::mt19937_64 random(9);
  const GutParts parts(test::curtain({4, 20}));
  const std::vector<Vec3> x = crumpled(parts, random);
  const std::vector<Asked> pairs = some_pairs(parts, random);
  PairBatch batch;
  const std::size_t before = test::heap_allocations();
  for (const Asked& pair : pairs) batch.ask(parts, pair.segment, pair.part, pair.farthest_m);
  batch.measure(x);
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::physics
