#include "physics/static_factor.h"

#include "physics/direct_solve.h"
#include "physics/unheld_pieces.h"
#include "tests/physics/held_bar.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <functional>

namespace omentum::physics {
namespace {

using geometry::MeshEditor;
using geometry::NodeId;
using geometry::TetId;
using test::held_bar;
using test::HeldBody;
using test::slice;

// A patch as large as a hand's.
constexpr std::size_t kPatch = 24;
// What a hand may be told wrong (the corrected compliance against a fresh precomputation), and what a solve
// that is refined once keeps.
constexpr double kTold = 1e-5, kSolved = 1e-8;

// A mesh, the body on it, what was cut of it, and its factor.
struct CutBody {
  HeldBody body;
  MeshEditor editor;
  UnheldPieces unheld;
  StaticFactor factor;
  std::vector<TetId> gone;  // all so far

  explicit CutBody(HeldBody of)
      : body(std::move(of)),
        editor(body.mesh),
        unheld(body.mesh, body.inertia.fixed),
        factor(body.mesh, test::kTissue, body.inertia.fixed) {}

  // With what then hangs on a node or an edge, and with what would float.
  bool cut(std::span<const TetId> tetrahedra) {
    std::vector<TetId> now = take(tetrahedra);
    const auto floating = unheld.find(editor);
    const std::vector<TetId> also = take(std::vector<TetId>(floating.begin(), floating.end()));
    now.insert(now.end(), also.begin(), also.end());
    gone.insert(gone.end(), now.begin(), now.end());
    return factor.remove(now);
  }

  std::vector<TetId> take(std::span<const TetId> tetrahedra) {
    const geometry::Removal removal = editor.remove(tetrahedra);
    std::vector<TetId> taken(removal.asked.begin(), removal.asked.end());
    taken.insert(taken.end(), removal.repaired.begin(), removal.repaired.end());
    taken.insert(taken.end(), removal.dropped.begin(), removal.dropped.end());
    return taken;
  }

  // Supports, and nodes that lost everything.
  FixedComponents fixed() const {
    FixedComponents fixed = body.inertia.fixed;
    for (std::size_t n = 0; n < fixed.size(); ++n)
      if (editor.uses(NodeId(n)) == 0) fixed[n] = kPinned;
    return fixed;
  }

  std::vector<NodeId> nodes_around(const Vec3& place, std::size_t count) const {
    const FixedComponents held = fixed();
    std::vector<NodeId> nodes;
    for (std::size_t n = 0; n < held.size(); ++n)
      if (held[n] != kPinned) nodes.emplace_back(n);
    const auto distance = [&](NodeId n) { return (body.mesh.positions[n] - place).norm(); };
    std::ranges::sort(nodes, {}, distance);
    nodes.resize(std::min(nodes.size(), count));
    return nodes;
  }

  // The compliance that a precomputation of the cut mesh would give, by a new factorization.
  Eigen::MatrixXd fresh_compliance(std::span<const NodeId> nodes) const {
    const FreeDofs free = free_dofs(fixed());
    const StiffnessFactor anew(body.stiffness_without(gone), free);
    const auto width = static_cast<Eigen::Index>(3 * nodes.size());
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(free.count, width);
    const auto dof = [&](Eigen::Index i) { return free.of(nodes[static_cast<std::size_t>(i / 3)], i % 3); };
    for (Eigen::Index i = 0; i < width; ++i)
      if (dof(i) >= 0) f(dof(i), i) = 1;
    const Eigen::MatrixXd u = anew.solve(f);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(width, width);
    for (Eigen::Index i = 0; i < width; ++i)
      if (dof(i) >= 0) block.row(i) = u.row(dof(i));
    return block;
  }

  Eigen::MatrixXf told_compliance(std::span<const NodeId> nodes) {
    const auto width = static_cast<Eigen::Index>(3 * nodes.size());
    Eigen::MatrixXf block(width, width);
    factor.compliance(nodes, {block.data(), static_cast<std::size_t>(block.size())});
    return block;
  }

  double error_around(const Vec3& place) {
    const std::vector<NodeId> nodes = nodes_around(place, kPatch);
    const Eigen::MatrixXd fresh = fresh_compliance(nodes);
    return (told_compliance(nodes).cast<double>() - fresh).cwiseAbs().maxCoeff() /
           fresh.cwiseAbs().maxCoeff();
  }

  Vec3 place_of(TetId t) const { return body.mesh.positions[body.mesh.tetrahedra[t][0]]; }
};

std::vector<TetId> near(const geometry::TetraMesh& mesh, const Vec3& place, std::size_t count) {
  std::vector<TetId> all;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) all.emplace_back(t);
  std::ranges::sort(all, {}, [&](TetId t) { return (mesh.positions[mesh.tetrahedra[t][0]] - place).norm(); });
  all.resize(count);
  return all;
}

TEST(StaticFactorTest, TheComplianceOfACutBodyIsThatOfAFreshPrecomputation) {
  CutBody cut(test::held_box());
  const std::vector<TetId> order = cut.body.any_order();
  for (const std::size_t count : {0, 1, 30, 200}) {
    while (cut.gone.size() < count) {
      const auto next = std::ranges::find_if(order, [&](TetId t) { return !cut.editor.is_removed(t); });
      ASSERT_TRUE(cut.cut({&*next, 1}));
    }
    EXPECT_LE(cut.error_around(cut.place_of(order[count])), kTold) << count << " removed";
  }
}

TEST(StaticFactorTest, OrderDoesNotMatter) {
  const HeldBody body = test::held_box();
  std::vector<TetId> away = near(body.mesh, body.mesh.positions[body.mesh.positions.size() / 2], 60);
  const std::array<std::function<void()>, 3> orders{[] {}, [&] { std::ranges::reverse(away); },
                                                    [&] { std::ranges::shuffle(away, std::mt19937(3)); }};
  std::vector<std::vector<TetId>> removed;
  Eigen::MatrixXf first;
  std::vector<NodeId> nodes;
  for (const auto& reorder : orders) {
    reorder();
    CutBody cut(test::held_box());
    ASSERT_TRUE(cut.cut(away));
    if (first.size() == 0) {
      nodes = cut.nodes_around(cut.place_of(away[0]), kPatch);
      first = cut.told_compliance(nodes);
    }
    EXPECT_LE((cut.told_compliance(nodes) - first).cwiseAbs().maxCoeff(), kTold * first.maxCoeff());
  }
}

TEST(StaticFactorTest, ARealLiverCutInOnePlaceIsExact) {
  const auto file = test::data_file("tet/openhelp_liver_7k.msh");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  CutBody cut(HeldBody(geometry::check_mesh(geometry::read_mesh(file), 1e-3).mesh));
  const Vec3 place = cut.body.mesh.positions[cut.body.mesh.positions.size() / 2];
  for (const TetId t : near(cut.body.mesh, place, 300)) ASSERT_TRUE(cut.cut({&t, 1}));
  EXPECT_LE(cut.error_around(place), kTold);
}

TEST(StaticFactorTest, APieceThatIsCutOffGoesAtOnceAndTheRestIsExact) {
  CutBody cut(held_bar());
  ASSERT_TRUE(cut.cut(slice(cut.body.mesh, 0.05, 0.06)));
  for (const NodeId n : {NodeId(0), NodeId(cut.body.mesh.positions.size() - 1)})
    EXPECT_EQ(cut.editor.uses(n) > 0, cut.body.mesh.positions[n].x() < 0.055);
  EXPECT_LE(cut.error_around({0.05, 0, 0}), kTold);
  // and on from there
  ASSERT_TRUE(cut.cut(slice(cut.body.mesh, 0.03, 0.035)));
  EXPECT_LE(cut.error_around({0.03, 0, 0}), kTold);
}

TEST(StaticFactorTest, UntilNothingIsLeft) {
  CutBody cut(held_bar());
  for (const TetId t : cut.body.any_order()) ASSERT_TRUE(cut.cut({&t, 1}));
  EXPECT_EQ(cut.editor.removed_count(), static_cast<std::int32_t>(cut.body.mesh.tetrahedra.size()));
  std::vector<double> f(cut.body.components()), u(f.size());
  cut.factor.solve(f, u);
  EXPECT_EQ(u, f);
}

TEST(StaticFactorTest, AllAtOnceIsAsOneAfterTheOther) {
  CutBody slow(held_bar()), fast(held_bar());
  const std::vector<TetId> first = slice(slow.body.mesh, 0.08, 0.09),
                           second = slice(slow.body.mesh, 0.04, 0.05);
  ASSERT_TRUE(slow.cut(first));
  ASSERT_TRUE(slow.cut(second));
  fast.editor.set_removed(slow.editor.removed_bits());
  ASSERT_TRUE(fast.factor.remove(slow.gone));
  fast.gone = slow.gone;
  EXPECT_LE(fast.error_around({0.04, 0, 0}), kTold);
}

TEST(StaticFactorTest, SolvesAreEquilibrium) {
  CutBody cut(test::held_box());
  const std::vector<TetId> order = cut.body.any_order();
  ASSERT_TRUE(cut.cut({order.data(), 40}));
  const FixedComponents fixed = cut.fixed();
  std::vector<double> f(cut.body.components()), u(f.size()), back(f.size());
  for (std::size_t c = 0; c < f.size(); ++c)
    if (!is_fixed(fixed[c / 3], static_cast<int>(c % 3))) f[c] = std::sin(static_cast<double>(c));
  cut.factor.solve(f, u);
  cut.factor.holding_forces(u, back);
  for (std::size_t c = 0; c < f.size(); ++c) {
    if (is_fixed(fixed[c / 3], static_cast<int>(c % 3))) continue;
    EXPECT_NEAR(back[c], f[c], kSolved) << c;
  }
}

TEST(StaticFactorTest, RestoringIsExact) {
  CutBody cut(held_bar());
  const std::vector<NodeId> nodes = cut.nodes_around({0.06, 0, 0}, kPatch);
  const Eigen::MatrixXf before = cut.told_compliance(nodes);
  ASSERT_TRUE(cut.cut(slice(cut.body.mesh, 0.05, 0.06)));
  cut.factor.restore();
  EXPECT_EQ(cut.told_compliance(nodes), before);
}

TEST(StaticFactorTest, ABodyThatFloatsIsRefused) {
  HeldBody body = test::held_box();
  std::ranges::fill(body.inertia.fixed, 0);
  EXPECT_THROW(StaticFactor(body.mesh, test::kTissue, body.inertia.fixed), FloatingError);
}

TEST(StaticFactorTest, NothingIsTakenFromTheHeap) {
  CutBody cut(held_bar());
  const std::vector<TetId> away = slice(cut.body.mesh, 0.05, 0.06);
  const std::array nodes{NodeId(8), NodeId(77)};
  std::array<float, 36> block{};
  std::vector<double> f(cut.body.components(), 1), u(f.size());
  const std::size_t before = test::heap_allocations();
  const geometry::Removal removal = cut.editor.remove(away);
  const bool is_known = cut.factor.remove(removal.asked);
  const std::size_t floating = cut.unheld.find(cut.editor).size();
  cut.factor.compliance(nodes, block);
  cut.factor.solve(f, u);
  cut.factor.restore();
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(floating, 0U);
  EXPECT_FALSE(is_known);  // the end of the bar floats
}

}  // namespace
}  // namespace omentum::physics
