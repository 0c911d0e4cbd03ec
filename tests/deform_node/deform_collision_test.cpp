#include "deform_node/organ_collision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace omentum::deform {
namespace {

constexpr double kNeverYields = std::numeric_limits<double>::infinity();

/// Spheres that stay where they are and remember what they met.
class Pebbles final : public OrganModel {
 public:
  explicit Pebbles(std::vector<CollisionSphere> pebbles) : spheres(std::move(pebbles)) {}
  ModelSizes sizes() const override { return {.spheres = spheres.size()}; }
  void step(const TickLoads&, double) noexcept override {}
  void reset() noexcept override {}
  OrganView view() const noexcept override { return {}; }
  ModelStatus status() const noexcept override { return {}; }
  std::span<const CollisionSphere> collidable() const noexcept override { return spheres; }
  void respond(std::span<const OrganContact> contacts) noexcept override {
    met.assign(contacts.begin(), contacts.end());
    ++asked;
  }

  std::vector<CollisionSphere> spheres;
  std::vector<OrganContact> met;
  int asked = 0;
};

/// A quasi-static organ's way: it offers nothing to meet.
class Aloof final : public OrganModel {
 public:
  ModelSizes sizes() const override { return {}; }
  void step(const TickLoads&, double) noexcept override {}
  void reset() noexcept override {}
  OrganView view() const noexcept override { return {}; }
  ModelStatus status() const noexcept override { return {}; }
  void respond(std::span<const OrganContact>) noexcept override { ADD_FAILURE() << "it offers nothing"; }
};

CollisionSphere sphere(const Vec3& centre, double mass_kg, const Vec3& velocity = Vec3::Zero()) {
  return {centre, velocity, 1, mass_kg};
}

TEST(OrganCollision, BothOrgansLearnOfAContactWithOppositeNormals) {
  Pebbles left({sphere({0, 0, 0}, 1, {1, 0, 0}), sphere({0, 9, 0}, 1)}), right({sphere({1.5, 0, 0}, 3)});
  OrganCollision collision({&left, &right});
  EXPECT_TRUE(collision.run());
  ASSERT_EQ(left.met.size(), 1u);
  ASSERT_EQ(right.met.size(), 1u);
  EXPECT_EQ(left.met[0].sphere, 0);
  EXPECT_EQ(left.met[0].normal, Vec3(-1, 0, 0));
  EXPECT_EQ(right.met[0].normal, Vec3(1, 0, 0));
  EXPECT_EQ(right.met[0].velocity, Vec3(1, 0, 0));
  EXPECT_DOUBLE_EQ(left.met[0].depth_m, 0.5);
  EXPECT_DOUBLE_EQ(left.met[0].share, 0.75) << "the lighter one yields more";
  EXPECT_DOUBLE_EQ(left.met[0].share + right.met[0].share, 1);
  EXPECT_EQ(left.met[0].push_m_s, right.met[0].push_m_s);
}

TEST(OrganCollision, WhatNeverYieldsLeavesTheWholeWayToTheOther) {
  Pebbles rock({sphere({0, 0, 0}, kNeverYields)}), soft({sphere({1, 0, 0}, 1)});
  OrganCollision collision({&rock, &soft});
  EXPECT_TRUE(collision.run());
  EXPECT_EQ(rock.met.at(0).share, 0);
  EXPECT_EQ(soft.met.at(0).share, 1);
}

TEST(OrganCollision, WhoDoesNotAnswerIsAskedOnceInATick) {
  Pebbles left({sphere({0, 0, 0}, 1, {1, 0, 0})}), right({sphere({1.5, 0, 0}, 3)});
  OrganCollision collision({&left, &right});
  for (int tick = 1; tick < 5; ++tick) {
    EXPECT_TRUE(collision.run());
    EXPECT_EQ(left.asked, tick);
    EXPECT_EQ(right.asked, tick);
    EXPECT_DOUBLE_EQ(left.met.at(0).share + right.met.at(0).share, 1) << "nothing is learnt of it";
  }
}

TEST(OrganCollision, AnOrganMeetsNeitherItselfNorOneThatOffersNothing) {
  Pebbles heap({sphere({0, 0, 0}, 1), sphere({0.1, 0, 0}, 1)});
  Aloof aloof;
  OrganCollision collision({&heap, &aloof});
  EXPECT_TRUE(collision.run());
  EXPECT_TRUE(heap.met.empty());
}

TEST(OrganCollision, FindsWhatAllPairsFind) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-6, 6);
  const auto heap = [&](double shift) {
    std::vector<CollisionSphere> spheres;
    for (int i = 0; i < 60; ++i)
      spheres.push_back(sphere({place(random) + shift, place(random), place(random)}, 1));
    return spheres;
  };
  for (const double shift : {0.0, 5.0, 11.0, 20.0}) {
    Pebbles one(heap(0)), other(heap(shift));
    std::size_t pairs = 0;
    for (const CollisionSphere& a : one.spheres)
      for (const CollisionSphere& b : other.spheres)
        pairs += (a.centre - b.centre).norm() < 2 + kNear_m ? 1u : 0u;
    OrganCollision collision({&one, &other});
    EXPECT_TRUE(collision.run());
    EXPECT_EQ(one.met.size(), pairs) << shift;
    EXPECT_EQ(other.met.size(), pairs) << shift;
  }
}

TEST(OrganCollision, MoreThanThereIsRoomForIsSaid) {
  Pebbles one({sphere({0, 0, 0}, 1)}), many(std::vector<CollisionSphere>(100, sphere({0.5, 0, 0}, 1)));
  OrganCollision collision({&one, &many});
  EXPECT_FALSE(collision.run());
  EXPECT_FALSE(one.met.empty()) << "what there is room for is met all the same";
}

}  // namespace
}  // namespace omentum::deform
