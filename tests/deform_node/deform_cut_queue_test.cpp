#include "deform_node/cut_queue.h"

#include "tests/deform_node/rates.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using geometry::TetId;

constexpr double kPlenty = 1e6;  // tetrahedra a second: no bound

class CutQueueTest : public testing::Test {
 protected:
  static std::vector<TetId> tets(std::initializer_list<int> numbers) {
    std::vector<TetId> all;
    for (const int t : numbers) all.emplace_back(t);
    return all;
  }
  std::vector<TetId> burn(CutQueue& queue) {
    const auto burnt = queue.burn(kTick_s, editor_);
    return {burnt.begin(), burnt.end()};
  }
  CutQueue queue(double delay_s, double rate_per_s) const {
    return {mesh_.tetrahedra.size(), delay_s, rate_per_s};
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(2, 2, 2, geometry::Vec3::Constant(0.1));
  geometry::MeshEditor editor_{mesh_};
};

TEST_F(CutQueueTest, WithoutADelayWhatIsMetGoesAtOnceInItsOrder) {
  CutQueue queue = this->queue(0, kPlenty);
  queue.meet(tets({7, 2, 30}), editor_);
  EXPECT_EQ(burn(queue), tets({7, 2, 30}));
  EXPECT_TRUE(burn(queue).empty());
}

TEST_F(CutQueueTest, EachWaitsFromWhenItWasFirstMet) {
  CutQueue queue = this->queue(0.025, kPlenty);
  queue.meet(tets({7}), editor_);
  EXPECT_TRUE(burn(queue).empty());
  queue.meet(tets({7, 3}), editor_);
  EXPECT_TRUE(burn(queue).empty());
  EXPECT_EQ(burn(queue), tets({7}));
  EXPECT_EQ(burn(queue), tets({3}));
}

TEST_F(CutQueueTest, SoManyGoInASecondAndTheRestLater) {
  CutQueue queue = this->queue(0, 1.5 / kTick_s);
  queue.meet(tets({0, 1, 2, 3, 4, 5}), editor_);
  EXPECT_EQ(burn(queue), tets({0}));
  EXPECT_EQ(burn(queue), tets({1, 2}));
  EXPECT_EQ(burn(queue), tets({3}));
  EXPECT_EQ(burn(queue), tets({4, 5}));
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(burn(queue).empty());
  queue.meet(tets({6, 7, 8, 9}), editor_);
  EXPECT_LE(burn(queue).size(), 2u) << "a pause is no credit";
}

TEST_F(CutQueueTest, WhatIsGoneIsPassedOver) {
  CutQueue queue = this->queue(0.005, kPlenty);
  queue.meet(tets({4, 5}), editor_);
  editor_.remove(tets({4}));
  queue.meet(tets({4}), editor_);
  EXPECT_EQ(burn(queue), tets({5}));
}

TEST_F(CutQueueTest, ClearedNothingWaitsAndAllCanBeMetAgain) {
  CutQueue queue = this->queue(0.005, kPlenty);
  queue.meet(tets({4, 5}), editor_);
  queue.clear();
  EXPECT_TRUE(burn(queue).empty());
  queue.meet(tets({5}), editor_);
  EXPECT_EQ(burn(queue), tets({5}));
}

TEST_F(CutQueueTest, TheWholeMeshFitsRoundAndRoundWithoutMemory) {
  CutQueue queue = this->queue(0, kPlenty);
  std::vector<TetId> all;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) all.emplace_back(t);
  const std::size_t before = test::heap_allocations();
  std::size_t burnt = 0;
  for (int i = 0; i < 5; ++i) {
    queue.meet(all, editor_);
    burnt += queue.burn(kTick_s, editor_).size();
  }
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_EQ(burnt, 5 * all.size());
}

}  // namespace
}  // namespace omentum::deform
