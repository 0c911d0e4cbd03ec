#include "deform_node/body_loads.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::deform {
namespace {

using geometry::TetId;

constexpr double kVolume_m3 = 1e-3, kDensity = 1000, kGravity = 9.81;
constexpr double kRounding = 1e-12;

class BodyLoadsTest : public testing::Test {
 protected:
  Vec3 sum() const {
    Vec3 total = Vec3::Zero();
    for (std::size_t n = 0; n < mesh_.positions.size(); ++n)
      total += Eigen::Map<const Vec3>(loads_.external().data() + 3 * n);
    return total;
  }
  Vec3 at(NodeId n) const { return Eigen::Map<const Vec3>(loads_.external().data() + 3 * n); }

  geometry::TetraMesh mesh_ = test::make_box_mesh(2, 2, 2, Vec3::Constant(0.1));
  physics::MaterialMap material_{physics::Material{1000, 0.4, kDensity}};
  geometry::MeshEditor editor_{mesh_};
  BodyLoads loads_{mesh_, material_, Vec3(0, 0, -kGravity)};
};

TEST_F(BodyLoadsTest, ItsWeightIsThatOfTheTissueThatIsLeft) {
  EXPECT_NEAR(sum().z(), -kVolume_m3 * kDensity * kGravity, kRounding);
  std::vector<TetId> half;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size() / 2; ++t) half.emplace_back(t);
  const auto gone = editor_.remove(half);
  std::vector<TetId> all(gone.asked.begin(), gone.asked.end());
  all.insert(all.end(), gone.repaired.begin(), gone.repaired.end());
  loads_.lighten(all, editor_);
  const double left = 1 - static_cast<double>(all.size()) / static_cast<double>(mesh_.tetrahedra.size());
  EXPECT_NEAR(sum().z(), -left * kVolume_m3 * kDensity * kGravity, kRounding);
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n) {
    if (editor_.uses(NodeId(n)) == 0) {
      EXPECT_EQ(at(NodeId(n)), Vec3(Vec3::Zero()));
    }
  }
  loads_.restore();
  EXPECT_NEAR(sum().z(), -kVolume_m3 * kDensity * kGravity, kRounding);
}

TEST_F(BodyLoadsTest, ToolsPressTogetherAndEachIsTold) {
  const double weight = sum().z();
  const std::array<NodeId, 2> nodes{NodeId(3), NodeId(7)};
  const std::array<Vec3, 2> first{Vec3(1, 0, 0), Vec3(0, 2, 0)}, second{Vec3(0, 0, -4), Vec3(0, 0, 0)};
  const std::array<ToolLoad, 2> both{
      ToolLoad{.tool = 1, .nodes = nodes, .displacements = first, .forces = first},
      ToolLoad{.tool = 5, .nodes = nodes, .displacements = second, .forces = second}};
  loads_.press(both, editor_);
  EXPECT_NEAR((sum() - Vec3(1, 2, weight - 4)).norm(), 0, 1e-9);
  EXPECT_EQ(loads_.of_tool(1, NodeId(3)), Vec3(1, 0, 0));
  EXPECT_EQ(loads_.of_tool(5, NodeId(3)), Vec3(0, 0, -4));
  EXPECT_EQ(loads_.of_tool(2, NodeId(3)), Vec3(Vec3::Zero()));
  loads_.press({}, editor_);
  EXPECT_NEAR((sum() - Vec3(0, 0, weight)).norm(), 0, 1e-9) << "what is let go of does not push on";
}

}  // namespace
}  // namespace omentum::deform
