#include "physics/intestine/gut_response.h"

#include "physics/intestine/gut_parts.h"
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

/// The passes as they are written in gut_response.h, mass by mass.
class PlainPasses {
 public:
  PlainPasses(std::span<const GutContact> contacts, std::span<const Vec3> warm, double step_s,
              double friction, const MovingMasses& masses)
      : contacts_(contacts), friction_(friction), masses_(masses) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Vec3& u = contacts[c].normal;
      const double f = warm[c].dot(u);
      const Vec3 rubbed = warm[c] - f * u;
      of_.push_back({f * step_s, f, rubbed * step_s, rubbed, between(contacts[c], masses.before)});
    }
  }
  void pass() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) correct(contacts_[c], of_[c]);
  }
  Vec3 impulse(std::size_t c) const { return of_[c].f * contacts_[c].normal + of_[c].rubbed_speed; }

 private:
  struct Given {
    double g, f;
    Vec3 rubbed_way, rubbed_speed, before;
  };
  static Vec3 between(const GutContact& contact, std::span<const Vec3> of) {
    return place_of(contact.one, of) - place_of(contact.other, of);
  }
  double D(const GutContact& contact) const {
    double sum = 0;
    for (const GutPoint* point : {&contact.one, &contact.other})
      for (std::size_t k = 0; k < 3 && point->mass[k].valid(); ++k)
        sum += point->weight[k] * point->weight[k] * masses_.inverse_mass[point->mass[k]];
    return sum;
  }
  void add(const GutContact& contact, const Vec3& impulse, std::span<Vec3> to) {
    for (const auto& [point, sign] : {std::pair(&contact.one, 1.0), std::pair(&contact.other, -1.0)})
      for (std::size_t k = 0; k < 3 && point->mass[k].valid(); ++k)
        to[point->mass[k]] += sign * point->weight[k] * masses_.inverse_mass[point->mass[k]] * impulse;
  }
  void rub(const GutContact& contact, const Vec3& gone, double most, Vec3& rubbed, std::span<Vec3> of) {
    Vec3 wish = rubbed - (gone - gone.dot(contact.normal) * contact.normal) / D(contact);
    if (wish.norm() > most) wish *= most / wish.norm();
    add(contact, wish - rubbed, of);
    rubbed = wish;
  }
  void correct(const GutContact& contact, Given& given) {
    const auto push = [&](double gone, double& sum, std::span<Vec3> of) {
      const double now = std::max(0.0, sum - gone / D(contact));
      add(contact, (now - sum) * contact.normal, of);
      sum = now;
    };
    push(between(contact, masses_.x).dot(contact.normal) - contact.reach_m, given.g, masses_.x);
    if (given.g > 0 || given.f > 0) push(between(contact, masses_.v).dot(contact.normal), given.f, masses_.v);
    if (given.g > 0 || !given.rubbed_way.isZero(0))
      rub(contact, between(contact, masses_.x) - given.before, friction_ * given.g, given.rubbed_way,
          masses_.x);
    if (given.f > 0 || !given.rubbed_speed.isZero(0))
      rub(contact, between(contact, masses_.v), friction_ * given.f, given.rubbed_speed, masses_.v);
  }

  std::span<const GutContact> contacts_;
  double friction_;
  MovingMasses masses_;
  std::vector<Given> of_;
};

// Rounding over two passes of numbers up to 1.
constexpr double kOfPasses = 1e-12;

TEST(GutResponse, CorrectsAsThePlainPassesDo) {
  const double step_s = 5e-3, friction = 0.3;
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    Pair fast = random_pair(random, true);
    // of the same five masses: each waits for the others
    std::vector<GutContact> contacts(4, fast.contact);
    contacts[1].other = {{MassId(3), MassId(2), MassId()}, {0.6, 0.4, 0}};
    contacts[2].one = {{MassId(1), MassId(), MassId()}, {1, 0, 0}};
    contacts[3].one = {{MassId(0), MassId(3), MassId()}, {0.5, 0.5, 0}};
    contacts[3].other = {{MassId(4), MassId(), MassId()}, {1, 0, 0}};
    std::vector<Vec3> warm;
    for (GutContact& contact : contacts) {
      contact.normal = (contact.normal + test::random_vector(random, 0.5)).normalized();
      warm.push_back(0.01 * contact.normal + test::random_vector(random, 0.001));
    }
    Pair plain = fast;
    GutResponse response(4, 2, friction);
    response.solve(contacts, warm, step_s, fast.masses());
    PlainPasses passes(contacts, warm, step_s, friction, plain.masses());
    for (int pass = 0; pass < 2; ++pass) passes.pass();
    for (std::size_t m = 0; m < 5; ++m) {
      EXPECT_LT((fast.x[m] - plain.x[m]).norm(), kOfPasses);
      EXPECT_LT((fast.v[m] - plain.v[m]).norm(), kOfPasses);
    }
    for (std::size_t c = 0; c < contacts.size(); ++c)
      EXPECT_LT((response.impulse(c) - passes.impulse(c)).norm(), kOfPasses);
  }
}

TEST(GutResponse, PassesEndWhereOneCorrectsNothing) {
  std::mt19937_64 random(5);
  Pair few = random_pair(random, true), many = few;
  GutResponse(1, 100, 0).solve(std::span(&few.contact, 1), few.masses());
  GutResponse(1, 1000000000, 0).solve(std::span(&many.contact, 1), many.masses());
  EXPECT_EQ(few.x, many.x);
  EXPECT_EQ(few.v, many.v);
}

}  // namespace
}  // namespace omentum::physics
