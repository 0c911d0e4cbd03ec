#include "physics/dynamics/kept_factor.h"

#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/physics/dynamics/kept_factor_fixtures.h"
#include "tests/support/heap_count.h"

#include <Eigen/Eigenvalues>

#include <limits>

namespace omentum::physics {
namespace {

using geometry::TetId;
using test::HeldBody;
using test::Values;

// dt = 5 ms, a = 1/s
constexpr SystemWeights kStep{1.005, 25e-6};

KeptFactor kept(const HeldBody& body, const SystemWeights& weights = kStep) {
  return {body.mesh, test::kTissue, body.inertia.fixed, body.inertia.mass, weights};
}

Values free_load(const HeldBody& body, unsigned seed) {
  Values b = test::random_values(body.components(), 1, seed);
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (body.held(c)) b[c] = 0;
  }
  return b;
}

// By a new factorization of the body as it is after the removals.
Values by_cholmod(const HeldBody& body, std::span<const TetId> removed, const Values& b) {
  const FreeDofs free = free_dofs(body.inertia.fixed);
  const StiffnessFactor factor(body.system_without(removed, kStep), free);
  Eigen::MatrixXd f(free.count, 1);
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (free.index[c] >= 0) f(free.index[c]) = b[c];
  }
  const Eigen::MatrixXd u = factor.solve(f);
  Values x(b.size());
  for (std::size_t c = 0; c < b.size(); ++c) x[c] = free.index[c] >= 0 ? u(free.index[c]) : 0;
  return x;
}

double difference(const Values& a, const Values& b) {
  return test::norm(test::sum(a, -1, b)) / test::norm(b);
}

// Refined once, a float solve is wrong by the square of (2^-24 times the condition of A, about 1e3 here);
// roughly, by that itself. A downdate keeps 48 bits, of which a node that loses everything costs ten.
constexpr double kRefined = 1e-8, kRough = 1e-3;

void expect_equals_cholmod(const HeldBody& body, std::span<const std::size_t> counts) {
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  std::size_t removed = 0;
  for (const std::size_t count : counts) {
    for (; removed < count; ++removed) ASSERT_TRUE(factor.remove({&order[removed], 1})) << removed;
    const Values b = free_load(body, 11);
    Values x(b.size()), rough(b.size());
    factor.solve(b, x);
    factor.solve_roughly(b, rough);
    const Values exact = by_cholmod(body, {order.data(), removed}, b);
    EXPECT_LE(difference(x, exact), kRefined) << removed << " removed";
    EXPECT_LE(difference(rough, exact), kRough) << removed << " removed";
  }
}

TEST(KeptFactorTest, SolvesAsANewFactorizationUntilNothingIsLeft) {
  const HeldBody body = test::held_box();
  expect_equals_cholmod(
      body, std::array{std::size_t{0}, std::size_t{1}, std::size_t{300}, body.mesh.tetrahedra.size()});
}

TEST(KeptFactorTest, SolvesAsANewFactorizationOnARealLiver) {
  const auto file = test::data_file("tet/openhelp_liver_7k.msh");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const HeldBody body(geometry::check_mesh(geometry::read_mesh(file), 1e-3).mesh);
  expect_equals_cholmod(body, std::array<std::size_t, 3>{0, 1, 300});
}

TEST(KeptFactorTest, ManyRemovalsAtOnceAreThoseOneByOne) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  ASSERT_TRUE(factor.remove({order.data(), 100}));
  const Values b = free_load(body, 5);
  Values x(b.size());
  factor.solve(b, x);
  EXPECT_LE(difference(x, by_cholmod(body, {order.data(), 100}, b)), kRefined);
}

TEST(KeptFactorTest, ASolveLeavesNothingOfItsEquation) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  ASSERT_TRUE(factor.remove({order.data(), 300}));
  const Values b = free_load(body, 5);
  Values x(b.size()), Ax(b.size());
  factor.solve(b, x);
  factor.multiply(x, Ax);
  EXPECT_LE(difference(Ax, b), 1e-11);  // (2^-24 times some tens)^2, and rounding
}

TEST(KeptFactorTest, RestoringIsExact) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const Values b = free_load(body, 5);
  Values before(b.size()), after(b.size());
  factor.solve(b, before);
  ASSERT_TRUE(factor.remove(body.any_order()));
  factor.restore();
  factor.solve(b, after);
  EXPECT_EQ(after, before);
}

TEST(KeptFactorTest, ABlockOfTheInverseIsWhatSolvesSay) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  ASSERT_TRUE(factor.remove({order.data(), 20}));
  // the last node is partly held
  const std::vector<NodeId> nodes{NodeId(40), NodeId(200), NodeId(body.mesh.positions.size() - 1),
                                  NodeId(41)};
  const auto width = static_cast<Eigen::Index>(3 * nodes.size());
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(width, width);
  factor.inverse_block(nodes, {block.data(), static_cast<std::size_t>(block.size())});

  Eigen::MatrixXd expected(width, width);
  for (Eigen::Index column = 0; column < width; ++column) {
    const auto component = [&](Eigen::Index i) { return static_cast<std::size_t>(3 * nodes[i / 3] + i % 3); };
    Values b(body.components()), x(body.components());
    if (!body.held(component(column))) b[component(column)] = 1;
    factor.solve(b, x);
    for (Eigen::Index row = 0; row < width; ++row) expected(row, column) = x[component(row)];
  }
  EXPECT_LE((block.cast<double>() - expected).norm(), kRough * 1e-2 * expected.norm());
  EXPECT_EQ(block, block.transpose());
}

TEST(KeptFactorTest, AKnownBlockFollowsItsNodesAndIsForgottenAfterACut) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body), fresh = kept(body);
  const std::vector<TetId> order = body.any_order();
  const std::vector<NodeId> nodes{NodeId(40), NodeId(200), NodeId(41)},
      turned{NodeId(41), NodeId(40), NodeId(200)};
  std::vector<float> first(81), again(81), expected(81);
  factor.inverse_block(nodes, first);
  factor.inverse_block(turned, again);
  fresh.inverse_block(turned, expected);
  for (std::size_t i = 0; i < 81; ++i) EXPECT_NEAR(again[i], expected[i], 1e-6 * expected[0]) << i;

  for (KeptFactor* each : {&factor, &fresh}) ASSERT_TRUE(each->remove({order.data(), 200}));
  factor.inverse_block(turned, again);
  KeptFactor cut = kept(body);
  ASSERT_TRUE(cut.remove({order.data(), 200}));
  cut.inverse_block(turned, expected);
  EXPECT_EQ(again, expected);
  factor.restore();
  factor.inverse_block(nodes, again);
  EXPECT_EQ(again, first);
}

TEST(KeptFactorTest, WhatIsLeftStaysPositiveDefinite) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  ASSERT_TRUE(factor.remove(body.any_order()));
  // masses alone: each node's own inverse mass, whatever was taken off before
  const NodeId n(100);
  std::array<float, 9> block{};
  factor.inverse_block({&n, 1}, block);
  const double expected = 1 / (kStep.mass * body.inertia.mass[n]);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(block[i], i % 4 == 0 ? expected : 0, 1e-6 * expected) << i;
}

TEST(KeptFactorTest, MassThatIsAddedIsAsIfItHadBeenThere) {
  const HeldBody body = test::held_box();
  HeldBody heavier = body;
  const std::vector<NodeId> nodes{NodeId(5), NodeId(100), NodeId(41)};
  constexpr double kMore_kg = 0.02;
  for (const NodeId n : nodes) heavier.inertia.mass[n] += kMore_kg;
  KeptFactor factor = kept(body), expected = kept(heavier);
  ASSERT_TRUE(factor.add_mass(nodes, kMore_kg));
  const Values b = free_load(body, 5);
  Values x(b.size()), y(b.size()), Ax(b.size());
  factor.solve(b, x);
  expected.solve(b, y);
  EXPECT_LE(difference(x, y), kRefined);
  factor.multiply(x, Ax);
  EXPECT_LE(difference(Ax, b), 1e-11);
  factor.restore();
  factor.solve(b, x);
  kept(body).solve(b, y);
  EXPECT_EQ(x, y);
}

TEST(KeptFactorTest, MassThatIsTakenIsAsIfItHadNeverBeenThere) {
  const HeldBody body = test::held_box();
  HeldBody lighter = body;
  const std::vector<NodeId> nodes{NodeId(5), NodeId(100), NodeId(41)};
  std::vector<double> taken_kg;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    taken_kg.push_back((0.3 + 0.3 * static_cast<double>(i)) * body.inertia.mass[nodes[i]]);
    lighter.inertia.mass[nodes[i]] -= taken_kg.back();
  }
  KeptFactor factor = kept(body), expected = kept(lighter);
  ASSERT_TRUE(factor.take_mass(nodes, taken_kg));
  const Values b = free_load(body, 5);
  Values x(b.size()), y(b.size());
  factor.solve(b, x);
  expected.solve(b, y);
  EXPECT_LE(difference(x, y), kRefined);
  factor.restore();
  factor.solve(b, x);
  kept(body).solve(b, y);
  EXPECT_EQ(x, y);
}

TEST(KeptFactorTest, WhatWouldFloatWithoutMassIsSaid) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body, {0, 1});
  EXPECT_FALSE(factor.remove(body.any_order()));
  factor.restore();
  const std::vector<TetId> order = body.any_order();
  EXPECT_TRUE(factor.remove({order.data(), 1}));
}

TEST(KeptFactorTest, WhatIsNoNumberIsSaid) {
  HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  body.mesh.positions[body.mesh.tetrahedra[order[0]][2]].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor.remove({order.data(), 1}));
}

TEST(KeptFactorTest, WhereEverythingIsHeldNothingMoves) {
  HeldBody body = test::held_box();
  std::ranges::fill(body.inertia.fixed, kPinned);
  KeptFactor factor = kept(body);
  EXPECT_TRUE(factor.remove(body.any_order()));
  Values x(body.components(), 1);
  factor.solve(Values(x.size(), 1), x);
  EXPECT_EQ(x, Values(x.size(), 0));
  factor.restore();
}

TEST(KeptFactorTest, NothingIsTakenFromTheHeap) {
  const HeldBody body = test::held_box();
  KeptFactor factor = kept(body);
  const std::vector<TetId> order = body.any_order();
  const std::array nodes{NodeId(3), NodeId(77)};
  Values b(body.components(), 1), x(body.components());
  std::array<float, 36> block{};
  const std::size_t before = test::heap_allocations();
  const bool definite = factor.remove({order.data(), 50});
  factor.solve(b, x);
  factor.inverse_block(nodes, block);
  factor.restore();
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(definite);
}

}  // namespace
}  // namespace omentum::physics
