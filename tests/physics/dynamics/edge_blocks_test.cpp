#include "physics/dynamics/edge_blocks.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

using kernels::kNodeFloats;

const Material kMaterial{5000, 0.45, 1000};
constexpr double kFloatRounding = 2e-6;  // relative: sums of some twenty products in float

// In double, from the books: f_a -= K_ab (u_b - u_a), f_b += K_ab^T (u_b - u_a).
std::vector<Vec3> expected_forces(const TensorBooks& books, const AlignedFloats& u) {
  const auto at = [&](NodeId n) {
    return Eigen::Map<const Eigen::Vector3f>(u.data() + kNodeFloats * n).cast<double>();
  };
  std::vector<Vec3> f(books.node_count(), Vec3::Zero());
  for (std::size_t e = 0; e < books.edges().size(); ++e) {
    const auto [a, b] = books.edges()[e];
    f[a] -= books.edge(e) * (at(b) - at(a));
    f[b] += books.edge(e).transpose() * (at(b) - at(a));
  }
  return f;
}

AlignedFloats random_displacements(std::size_t node_count) {
  std::mt19937 generator(3);
  std::normal_distribution<float> normal(0, 1e-3f);
  AlignedFloats u(kNodeFloats * node_count);
  for (std::size_t i = 0; i < u.size(); ++i) u.data()[i] = i % kNodeFloats < 3 ? normal(generator) : 0;
  return u;
}

void refresh_all(EdgeBlocks& blocks, const TensorBooks& books) {
  for (std::size_t e = 0; e < books.edges().size(); ++e) blocks.refresh(books, static_cast<std::int32_t>(e));
}

// Meshes whose numbers of nodes leave 0 to 3 lanes of the last slice empty.
class EdgeKernelsTest : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Boxes, EdgeKernelsTest, testing::Values(2, 3, 4, 6));

TEST_P(EdgeKernelsTest, EachAgreesWithBooks) {
  const geometry::TetraMesh mesh = test::make_box_mesh(GetParam(), 4, 2, {0.03, 0.02, 0.05});
  const TensorBooks books(mesh, kMaterial);
  EdgeBlocks blocks(books);
  refresh_all(blocks, books);
  const AlignedFloats u = random_displacements(books.node_count());
  const std::vector<Vec3> expected = expected_forces(books, u);
  ASSERT_STREQ(kernels::edge_kernels().back().name, "plain");
  for (const kernels::EdgeKernel& kernel : kernels::edge_kernels()) {
    AlignedFloats f(u.size());
    kernel.forces(blocks.slices(), u.data(), f.data());
    for (std::size_t n = 0; n < expected.size(); ++n) {
      const Eigen::Map<const Eigen::Vector3f> own(f.data() + kNodeFloats * n);
      EXPECT_LE((own.cast<double>() - expected[n]).norm(), kFloatRounding * expected[n].norm())
          << kernel.name << ", node " << n;
      EXPECT_EQ(f.data()[kNodeFloats * n + 3], 0) << kernel.name << ", node " << n;
    }
  }
}

TEST(EdgeBlocks, HoldWhatWasRefreshedOnly) {
  const geometry::TetraMesh mesh = test::make_box_mesh(3, 3, 3, {0.03, 0.03, 0.03});
  const TensorBooks books(mesh, kMaterial);
  EdgeBlocks blocks(books);
  const AlignedFloats u = random_displacements(books.node_count());
  AlignedFloats f(u.size());
  kernels::edge_forces_plain(blocks.slices(), u.data(), f.data());
  EXPECT_EQ(std::count(f.data(), f.data() + f.size(), 0.f), static_cast<std::ptrdiff_t>(f.size()));

  blocks.refresh(books, 5);
  kernels::edge_forces_plain(blocks.slices(), u.data(), f.data());

  for (std::size_t n = 0; n < books.node_count(); ++n) {
    const bool touched = books.edges()[5].a == NodeId(n) || books.edges()[5].b == NodeId(n);
    EXPECT_EQ(f.data()[kNodeFloats * n] != 0, touched) << n;
  }
}

TEST(EdgeBlocks, ShareEdgesOutSoThatFewLanesAreEmpty) {
  const geometry::TetraMesh mesh = test::make_box_mesh(8, 8, 8, {0.03, 0.03, 0.03});
  const TensorBooks books(mesh, kMaterial);
  const EdgeBlocks blocks(books);
  const std::size_t lanes = kernels::kEdgeLanes * blocks.steps();
  EXPECT_LE(lanes, books.edges().size() * 1.05);
}

}  // namespace
}  // namespace omentum::physics
