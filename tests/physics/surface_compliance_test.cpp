#include "physics/surface_compliance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omentum::physics {
namespace {

constexpr int kMobile = 75;  // five clusters, the last one not full
constexpr int kClusters = 5;
// Relative to the sum of magnitudes: float rounding of up to 3 * 40 terms.
constexpr double kFloatSum = 1e-5;

struct Aligned {
  alignas(64) float tiles[kMobile * kClusters * SurfaceCompliance::kTileFloats];
  float bounds[kMobile * kClusters];
};

class SurfaceComplianceTest : public testing::Test {
 protected:
  SurfaceComplianceTest() : memory(std::make_shared<Aligned>()) {
    std::normal_distribution<float> normal;
    for (float& v : memory->tiles) v = normal(generator);
    compliance.emplace(kMobile, memory->tiles, memory->bounds, memory);
  }

  // p different nodes and forces on them.
  void choose(int p) {
    std::vector<int> all(kMobile);
    for (int n = 0; n < kMobile; ++n) all[n] = n;
    std::shuffle(all.begin(), all.end(), generator);
    std::normal_distribution<double> normal;
    for (int q = 0; q < p; ++q) {
      nodes.emplace_back(all[q]);
      forces.push_back(Vec3::NullaryExpr([&] { return normal(generator); }));
    }
  }

  // Plainly: one block at a time, in double.
  Vec3 expected(int n) const {
    Vec3 u = Vec3::Zero();
    for (std::size_t q = 0; q < nodes.size(); ++q) u += compliance->block(SurfaceId(n), nodes[q]) * forces[q];
    return u;
  }

  void expect_equal(const float* u, int cluster) const {
    const double tolerance = kFloatSum * 3 * (static_cast<double>(nodes.size()) + 1);
    for (int lane = 0; lane < 16 && 16 * cluster + lane < kMobile; ++lane) {
      const Vec3 plain = expected(16 * cluster + lane);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(u[16 * i + lane], plain[i], tolerance) << cluster << " " << lane;
    }
  }

  std::mt19937 generator{11};
  std::shared_ptr<Aligned> memory;
  std::optional<SurfaceCompliance> compliance;
  std::vector<SurfaceId> nodes;
  std::vector<Vec3> forces;
};

TEST_F(SurfaceComplianceTest, BlockReadsComponentsOfTile) {
  const float* tile = compliance->tile(SurfaceId(7), 2);
  const Eigen::Matrix3d C = compliance->block(SurfaceId(35), SurfaceId(7));
  EXPECT_EQ(C(1, 2), tile[(3 * 1 + 2) * 16 + 3]);
  EXPECT_TRUE(compliance->block(SurfaceId(kMobile), SurfaceId(0)).isZero(0)) << "pinned nodes do not move";
  EXPECT_TRUE(compliance->block(SurfaceId(0), SurfaceId()).isZero(0));
}

class SuperposeTest : public SurfaceComplianceTest, public testing::WithParamInterface<int> {};

// none, one, a full batch, one more, and several batches
INSTANTIATE_TEST_SUITE_P(Counts, SuperposeTest, testing::Values(0, 1, 5, 16, 17, 40));

TEST_P(SuperposeTest, ClusterEqualsPlainSum) {
  choose(GetParam());
  for (int cluster = 0; cluster < kClusters; ++cluster) {
    std::vector<float> u(48, 99.0f);
    superpose_cluster(*compliance, cluster, nodes, forces, u.data());
    expect_equal(u.data(), cluster);
  }
}

TEST_P(SuperposeTest, SurfaceEqualsPlainSumAtAnyAlignment) {
  choose(GetParam());
  std::vector<float> u(48 * kClusters + 1, 99.0f);
  superpose_surface(*compliance, nodes, forces, std::span(u).subspan(1));
  for (int cluster = 0; cluster < kClusters; ++cluster) expect_equal(u.data() + 1 + 48 * cluster, cluster);
}

using SurfaceComplianceDeathTest = SurfaceComplianceTest;

// Its column would be read past the end of the tensors.
TEST_F(SurfaceComplianceDeathTest, ANodeThatDoesNotMoveEndsTheProcess) {
  std::vector<float> u(48 * kClusters);
  const std::vector<Vec3> push{Vec3::UnitX()};
  for (const SurfaceId wrong : {SurfaceId(kMobile), SurfaceId()}) {
    const std::vector<SurfaceId> node{wrong};
    EXPECT_DEATH(superpose_cluster(*compliance, 0, node, push, u.data()), "mobile nodes");
    EXPECT_DEATH(superpose_surface(*compliance, node, push, u), "mobile nodes");
  }
}

}  // namespace
}  // namespace omentum::physics
