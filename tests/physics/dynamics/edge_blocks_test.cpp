#include "physics/dynamics/edge_blocks.h"

#include "tests/physics/dynamics/tensor_tissue.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

// In double, from the books: f_a -= K_ab (u_b - u_a), f_b += K_ab^T (u_b - u_a).
std::vector<Vec3> expected_forces(const TensorBooks& books, const std::vector<double>& u) {
  const auto at = [&](NodeId n) { return Eigen::Map<const Vec3>(u.data() + 3 * n); };
  std::vector<Vec3> f(books.node_count(), Vec3::Zero());
  for (std::size_t e = 0; e < books.edges().size(); ++e) {
    const auto [a, b] = books.edges()[e];
    f[a] -= books.edge(e) * (at(b) - at(a));
    f[b] += books.edge(e).transpose() * (at(b) - at(a));
  }
  return f;
}

std::vector<double> computed_forces(const kernels::EdgeKernel& kernel, const EdgeBlocks& blocks,
                                    const std::vector<double>& u) {
  AlignedFloats scratch(u.size() / 3 * kernels::kNodeStride);
  std::vector<double> f(u.size(), -1);
  kernel.forces(blocks.slices(), u.data(), scratch.data(), f.data());
  return f;
}

std::vector<double> random_displacements(std::size_t node_count) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 1e-3);
  std::vector<double> u(3 * node_count);
  std::ranges::generate(u, [&] { return normal(generator); });
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
  const std::vector<double> u = random_displacements(books.node_count());
  const std::vector<Vec3> expected = expected_forces(books, u);
  ASSERT_STREQ(kernels::edge_kernels().back().name, "plain");
  for (const kernels::EdgeKernel& kernel : kernels::edge_kernels()) {
    const std::vector<double> f = computed_forces(kernel, blocks, u);
    for (std::size_t n = 0; n < expected.size(); ++n) {
      const Eigen::Map<const Vec3> own(f.data() + 3 * n);
      EXPECT_LE((own - expected[n]).norm(), kFloatRounding * expected[n].norm())
          << kernel.name << ", node " << n;
    }
  }
}

TEST(EdgeBlocks, HoldWhatWasRefreshedOnly) {
  const geometry::TetraMesh mesh = test::make_box_mesh(3, 3, 3, {0.03, 0.03, 0.03});
  const TensorBooks books(mesh, kMaterial);
  EdgeBlocks blocks(books);
  const std::vector<double> u = random_displacements(books.node_count());
  const kernels::EdgeKernel& kernel = kernels::edge_kernels().front();
  for (const double component : computed_forces(kernel, blocks, u)) EXPECT_EQ(component, 0);

  blocks.refresh(books, 5);
  const std::vector<double> f = computed_forces(kernel, blocks, u);

  for (std::size_t n = 0; n < books.node_count(); ++n) {
    const bool touched = books.edges()[5].a == NodeId(n) || books.edges()[5].b == NodeId(n);
    EXPECT_EQ(f[3 * n] != 0, touched) << n;
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
