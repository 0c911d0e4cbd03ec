#include "physics/intestine/gut_response.h"

#include "tests/physics/intestine/restless_gut.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Two segments of random places, speeds and masses, or a segment and a triangle, that overlap.
struct Pair {
  std::vector<Vec3> before, x, v;
  std::vector<double> inverse_mass;
  GutContact contact;
  MovingMasses masses() { return {before, x, v, inverse_mass}; }
};

Pair random_pair(std::mt19937_64& random, bool triangle) {
  Pair pair;
  for (int m = 0; m < 5; ++m) {
    pair.x.push_back(test::random_vector(random, 0.05));
    pair.v.push_back(test::random_vector(random, 1));
    pair.inverse_mass.push_back(100 + 10 * test::random_vector(random, 1).x());
  }
  pair.before = pair.x;
  pair.contact.one = {{MassId(0), MassId(1), MassId()}, {0.3, 0.7, 0}};
  pair.contact.other = {{MassId(2), MassId(3), triangle ? MassId(4) : MassId()}, {0.2, 0.8, 0}};
  if (triangle) pair.contact.other.weight = {0.2, 0.3, 0.5};
  const auto place = [&](const GutPoint& point) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i)
      sum += point.weight[i] * pair.x[point.mass[i]];
    return sum;
  };
  const Vec3 between = place(pair.contact.one) - place(pair.contact.other);
  pair.contact.normal = between.normalized();
  pair.contact.reach_m = between.norm() + 0.01;
  return pair;
}

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

// Of what moves with `way` ([n], m/s, or m for a correction of places) about the origin, at places `x`.
Momentum momentum(std::span<const Vec3> x, std::span<const Vec3> way, std::span<const double> inverse_mass) {
  Momentum sum;
  for (std::size_t m = 0; m < x.size(); ++m) {
    sum.linear += way[m] / inverse_mass[m];
    sum.angular += x[m].cross(way[m]) / inverse_mass[m];
  }
  return sum;
}

double separation(const Pair& pair) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (pair.contact.one.mass[i].valid())
      sum += pair.contact.one.weight[i] * pair.x[pair.contact.one.mass[i]].dot(pair.contact.normal);
    if (pair.contact.other.mass[i].valid())
      sum -= pair.contact.other.weight[i] * pair.x[pair.contact.other.mass[i]].dot(pair.contact.normal);
  }
  return sum;
}

// Of sums of a few products of numbers around 1.
constexpr double kRounding = 1e-13;

TEST(GutResponse, EveryCorrectionKeepsLinearAndAngularMomentum) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Pair pair = random_pair(random, trial % 2 == 1);
    const std::vector<Vec3> x = pair.x, v = pair.v;
    GutResponse(1, 1, 0).solve(std::span(&pair.contact, 1), pair.masses());
    const Momentum was = momentum(x, v, pair.inverse_mass), is = momentum(x, pair.v, pair.inverse_mass);
    EXPECT_LT((is.linear - was.linear).norm(), kRounding);
    EXPECT_LT((is.angular - was.angular).norm(), kRounding);
    std::vector<Vec3> way(x.size());
    for (std::size_t m = 0; m < x.size(); ++m) way[m] = pair.x[m] - x[m];
    const Momentum moved = momentum(x, way, pair.inverse_mass);
    EXPECT_LT(moved.linear.norm(), kRounding);
    EXPECT_LT(moved.angular.norm(), kRounding);
  }
}

TEST(GutResponse, OneContactIsApartAndStillAfterOnePass) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    Pair pair = random_pair(random, trial % 2 == 1);
    GutResponse response(1, 1, 0);
    response.solve(std::span(&pair.contact, 1), pair.masses());
    EXPECT_NEAR(separation(pair), pair.contact.reach_m, kRounding);
    EXPECT_LT(response.deepest_m(pair.masses()), kRounding);
  }
}

TEST(GutResponse, PartsThatSeparateAreNotHeldTogether) {
  std::mt19937_64 random(3);
  Pair pair = random_pair(random, false);
  for (int m = 0; m < 2; ++m) pair.v[m] = pair.contact.normal;
  for (int m = 2; m < 5; ++m) pair.v[m] = -pair.contact.normal;
  const std::vector<Vec3> v = pair.v;
  GutResponse response(1, 4, 0);
  response.solve(std::span(&pair.contact, 1), pair.masses());
  EXPECT_EQ(pair.v, v);
  EXPECT_EQ(response.impulse(0).norm(), 0);
}

TEST(GutResponse, HeldMassesStayAndTheOthersGiveWay) {
  std::mt19937_64 random(4);
  Pair pair = random_pair(random, false);
  pair.inverse_mass[2] = pair.inverse_mass[3] = 0;
  const std::vector<Vec3> x = pair.x;
  GutResponse(1, 1, 0).solve(std::span(&pair.contact, 1), pair.masses());
  EXPECT_EQ(pair.x[2], x[2]);
  EXPECT_EQ(pair.x[3], x[3]);
  EXPECT_NEAR(separation(pair), pair.contact.reach_m, kRounding);
  pair.inverse_mass[0] = pair.inverse_mass[1] = 0;
  const std::vector<Vec3> held = pair.x;
  GutResponse(1, 1, 0).solve(std::span(&pair.contact, 1), pair.masses());
  EXPECT_EQ(pair.x, held);
}

TEST(GutResponse, FrictionStopsWhatSlowlySlidesAndSlowsWhatIsFast) {
  // a mass on the floor, pressed down by 1 mm and 1 m/s in the step, and moved along it
  for (const double along : {0.3, 3.0}) {
    std::vector<Vec3> before{Vec3(0, 0, 0.02)}, x{Vec3(0.001 * along, 0, 0.019)}, v{Vec3(along, 0, -1)};
    const std::vector<double> inverse_mass{50};
    GutContact contact;
    contact.one = {{MassId(0), MassId(), MassId()}, {1, 0, 0}};
    contact.reach_m = 0.02;
    GutResponse(1, 4, 0.5).solve(std::span(&contact, 1), {before, x, v, inverse_mass});
    const double left = std::max(0.0, along - 0.5);
    EXPECT_NEAR(v[0].x(), left, kRounding);
    EXPECT_NEAR(x[0].x(), 0.001 * left, kRounding);
    EXPECT_NEAR(v[0].z(), 0, kRounding);
    EXPECT_NEAR(x[0].z(), 0.02, kRounding);
  }
}

}  // namespace
}  // namespace omentum::physics
