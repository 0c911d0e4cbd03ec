#include "physics/supports.h"

#include "physics/stiffness_factor.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace omentum::physics {
namespace {

constexpr std::uint8_t kX = 1, kY = 2, kZ = 4;

class SupportsTest : public testing::Test {
 protected:
  // node (i, j, k) has number i + 3 j + 9 k
  const geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 2, {0.1, 0.1, 0.1});
  FixedComponents fixed = FixedComponents(mesh.positions.size(), 0);

  void expect_floating(int motions) const {
    try {
      require_held(mesh, fixed);
      FAIL() << "expected " << motions << " rigid motions to be left";
    } catch (const FloatingError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(std::to_string(motions) + " of its 6"));
    }
  }
};

TEST_F(SupportsTest, NothingHeldLeavesSixMotions) {
  expect_floating(6);
}

TEST_F(SupportsTest, OnePinnedNodeLeavesThreeRotations) {
  fixed[0] = kPinned;
  expect_floating(3);
}

TEST_F(SupportsTest, TwoPinnedNodesLeaveRotationAboutTheirLine) {
  fixed[0] = fixed[26] = kPinned;
  expect_floating(1);
}

TEST_F(SupportsTest, CollinearPinnedNodesLeaveRotation) {
  fixed[0] = fixed[1] = fixed[2] = kPinned;
  expect_floating(1);
}

TEST_F(SupportsTest, ThreePinnedNodesHold) {
  fixed[0] = fixed[2] = fixed[6] = kPinned;
  EXPECT_NO_THROW(require_held(mesh, fixed));
}

TEST_F(SupportsTest, AFaceHeldAlongItsNormalLeavesPlaneMotions) {
  for (int n = 0; n < 9; ++n) fixed[n] = kZ;
  expect_floating(3);
}

TEST_F(SupportsTest, SixWellChosenComponentsHold) {
  fixed[0] = kX | kY | kZ;
  fixed[2] = kY | kZ;
  fixed[6] = kZ;
  EXPECT_NO_THROW(require_held(mesh, fixed));
}

TEST_F(SupportsTest, FreeDofsSkipHeldComponents) {
  fixed[1] = kY;
  fixed[3] = kPinned;
  const FreeDofs free = free_dofs(fixed);
  EXPECT_EQ(free.count, 3 * static_cast<int>(mesh.positions.size()) - 4);
  EXPECT_EQ(free.of(geometry::NodeId(1), 0), 3);
  EXPECT_EQ(free.of(geometry::NodeId(1), 1), -1);
  EXPECT_EQ(free.of(geometry::NodeId(1), 2), 4);
  EXPECT_EQ(free.of(geometry::NodeId(4), 0), 8);
}

TEST_F(SupportsTest, FactorOfFloatingStiffnessIsRefused) {
  // a stiffness of springs to nowhere: exactly singular, so that the factorization itself must say it
  Stiffness none{{0, 1}, {NodeId(0)}, {Eigen::Matrix3d::Zero()}};
  EXPECT_THROW(StiffnessFactor(none, free_dofs({0})), FloatingError);
}

}  // namespace
}  // namespace omentum::physics
