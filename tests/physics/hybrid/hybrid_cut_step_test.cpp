#include "physics/hybrid/hybrid_cut_step.h"

#include "geometry/mesh_editor.h"
#include "physics/unheld_pieces.h"
#include "tests/physics/hybrid/hybrid_beam.h"
#include "tests/support/heap_count.h"

#include <random>

namespace omentum::physics {
namespace {

using geometry::MeshEditor;
using geometry::NodeId;
using geometry::TetId;
using test::HybridBeam;
using test::Values;

constexpr double kCutStep_s = 0.01;
// What a hand may be told wrong of a cut organ: the corrected compliance against a fresh precomputation.
constexpr double kCutTold = 1e-5;

class HybridCutStepTest : public testing::Test {
 protected:
  explicit HybridCutStepTest(const Vec3& gravity = {0, 0, -9.81}) : beam_(gravity) {
    for (const std::uint8_t is_dynamic : beam_.dynamic) precomputed_.push_back(is_dynamic == 0 ? 1 : 0);
  }

  HybridTissue tissue(DynamicLaw law = DynamicLaw::kLinear) const {
    return {beam_.mesh, beam_.material, beam_.inertia, precomputed_, law};
  }
  HybridCutStep made(double dt = kCutStep_s, DynamicLaw law = DynamicLaw::kLinear) const {
    return {tissue(law), dt, 24};
  }

  // `asked`, what then hangs on a node or an edge, and what floats.
  std::vector<TetId> cut(std::span<const TetId> asked) {
    std::vector<TetId> gone;
    const auto take = [&](const geometry::Removal& removal) {
      for (const auto part : {removal.asked, removal.repaired, removal.dropped})
        gone.insert(gone.end(), part.begin(), part.end());
    };
    take(editor_.remove(asked));
    const auto floating = unheld_.find(editor_);
    take(editor_.remove(std::vector<TetId>(floating.begin(), floating.end())));
    gone_.insert(gone_.end(), gone.begin(), gone.end());
    return gone;
  }
  // So many of all, mixed; half of the beam's are precomputed.
  std::vector<TetId> some(std::size_t count, unsigned seed) const {
    std::vector<TetId> all;
    for (std::size_t t = 0; t < beam_.mesh.tetrahedra.size(); ++t) all.emplace_back(t);
    std::shuffle(all.begin(), all.end(), std::mt19937(seed));
    all.resize(count);
    return all;
  }

  bool is_left(std::size_t n) const { return editor_.uses(NodeId(n)) > 0; }
  // Weights of what is left, and presses on both parts.
  Values loads() const {
    Values f(beam_.components());
    const auto w = body_forces(left(), beam_.material, Vec3(0, 0, -9.81));
    for (std::size_t n = 0; n < w.size(); ++n) Vec3::Map(&f[3 * n]) = w[n];
    for (const Vec3& place : {Vec3(0.03, 0.015, 0.03), Vec3(0.105, 0.015, 0.03)}) {
      const auto n = static_cast<std::size_t>(beam_.nearest(place));
      if (is_left(n)) Vec3::Map(&f[3 * n]) += Vec3(0.01, 0.02, -0.05);
    }
    return f;
  }
  geometry::TetraMesh left() const {
    geometry::TetraMesh left;
    left.positions = beam_.mesh.positions;
    for (std::size_t t = 0; t < beam_.mesh.tetrahedra.size(); ++t) {
      if (editor_.is_removed(TetId(t))) continue;
      left.tetrahedra.push_back(beam_.mesh.tetrahedra[t]);
      left.regions.push_back(beam_.mesh.regions[t]);
    }
    return left;
  }
  Values direct(const Values& loads) const {
    FixedComponents fixed = beam_.inertia.fixed;
    std::vector<Vec3> f;
    for (std::size_t n = 0; n < fixed.size(); ++n) {
      if (!is_left(n)) fixed[n] = kPinned;
      f.emplace_back(loads.data() + 3 * n);
    }
    Values expected;
    for (const Vec3& u : direct_solve(assemble_stiffness(left(), beam_.material), fixed, {}, f).displacements)
      expected.insert(expected.end(), u.begin(), u.end());
    return expected;
  }
  // Of what is left, beyond the largest.
  double off(const Values& found, const Values& expected) const {
    double size = 0, most = 0;
    for (std::size_t c = 0; c < found.size(); ++c) {
      if (!is_left(c / 3)) continue;
      size = std::max(size, std::abs(expected[c]));
      most = std::max(most, std::abs(found[c] - expected[c]));
    }
    return most / size;
  }
  // A long step ends at rest, but for what masses still do.
  Values rest(HybridCutStep& step, const Values& loads) const {
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(step.step(state, loads));
    return state.u;
  }
  double energy_j(HybridCutStep& step, const BodyState& state) const {
    return step.elastic_energy(state.u) + kinetic_energy(step.mass(), state.v);
  }

  HybridBeam beam_;
  std::vector<std::uint8_t> precomputed_;
  MeshEditor editor_{beam_.mesh};
  UnheldPieces unheld_{beam_.mesh, beam_.inertia.fixed};
  std::vector<TetId> gone_;
};

TEST_F(HybridCutStepTest, UncutItIsTheHybridOnStoredTensors) {
  beam_.inertia.mass_damping_per_s = 2;
  beam_.inertia.stiffness_damping_s = 0.01;
  HybridCutStep cut = made();
  HybridStep stored(beam_.body(), kCutStep_s, 24);
  BodyState a = state_at_rest(beam_.mesh.positions.size()), b = a;
  for (int i = 0; i < 40; ++i) {
    const Values& external = i < 10 ? beam_.weights : loads();
    ASSERT_TRUE(cut.step(a, external) && stored.step(b, external));
    ASSERT_LE(beam_.difference(a.u, b.u), 2e-5) << i;  // its tensors are floats
  }
}

TEST_F(HybridCutStepTest, ItRestsWhereADirectSolveOfTheCutMeshDoes) {
  for (const std::size_t count : {1U, 30U, 80U}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      editor_.restore();
      HybridCutStep step = made(10);
      // in turns, as an edge takes them
      for (const TetId t : some(count, seed))
        ASSERT_TRUE(editor_.is_removed(t) || step.remove(cut(std::span(&t, 1))));
      const Values f = loads();
      ASSERT_LE(off(rest(step, f), direct(f)), kCutTold) << count << " removals, seed " << seed;
    }
  }
}

TEST_F(HybridCutStepTest, TheOrderOfRemovalsMakesNoDifference) {
  const std::vector<TetId> asked = some(40, 7);
  const std::vector<TetId> all = cut(asked);
  std::array<Values, 3> found;
  for (std::size_t order = 0; order < found.size(); ++order) {
    HybridCutStep step = made(10);
    std::vector<TetId> now = all;
    std::shuffle(now.begin(), now.end(), std::mt19937(static_cast<unsigned>(order)));
    if (order == 0) {
      ASSERT_TRUE(step.remove(now));
    } else {
      for (const TetId t : now) ASSERT_TRUE(step.remove({&t, 1}));
    }
    found[order] = rest(step, loads());
  }
  EXPECT_LE(off(found[1], found[0]), kCutTold);
  EXPECT_LE(off(found[2], found[0]), kCutTold);
}

TEST_F(HybridCutStepTest, ANodeThatComesToTheSurfaceYieldsAsTheCutMeshDoes) {
  HybridCutStep step = made(1000);  // so long that masses answer nothing
  const NodeId inside = beam_.nearest({0.03, 0.015, 0.015});
  ASSERT_FALSE(beam_.is_known(static_cast<std::size_t>(inside))) << "it has a column before";
  for (std::size_t t = 0; t < beam_.mesh.tetrahedra.size(); ++t) {
    const auto& tet = beam_.mesh.tetrahedra[t];
    if (std::ranges::find(tet, inside) == tet.end() || gone_.size() > 2) continue;
    const TetId id(t);
    ASSERT_TRUE(step.remove(cut({&id, 1})));
  }
  ASSERT_TRUE(is_left(static_cast<std::size_t>(inside)));
  std::vector<float> block(9);
  step.compliance({&inside, 1}, block);
  for (int axis = 0; axis < 3; ++axis) {
    Values f(beam_.components());
    f[3 * static_cast<std::size_t>(inside) + axis] = 1;
    const Values u = direct(f);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(block[3 * i + axis], u[3 * static_cast<std::size_t>(inside) + i], kCutTold * block[0]);
  }
}

TEST_F(HybridCutStepTest, EnergyNeverGrowsByMoreThanTheWorkWhereverItIsCut) {
  for (const DynamicLaw law : {DynamicLaw::kLinear, DynamicLaw::kCorotational}) {
    editor_.restore();
    HybridCutStep step = made(kCutStep_s, law);
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    const std::vector<TetId> order = some(100, 11);
    double largest_j = 0;
    for (std::size_t i = 0; i < 100; ++i) {
      if (i % 2 == 1 && !editor_.is_removed(order[i])) {
        const double before = energy_j(step, state);
        ASSERT_TRUE(step.remove(cut({&order[i], 1})));
        for (std::size_t c = 0; c < state.v.size(); ++c)
          if (!is_left(c / 3)) state.v[c] = 0;
        ASSERT_LE(energy_j(step, state), before * (1 + 1e-9) + 1e-15) << i;
      }
      Values external = i / 30 % 2 == 0 ? loads() : Values(beam_.components());
      if (law == DynamicLaw::kCorotational)  // linearized once a step: exact where little turns within one
        for (double& f : external) f *= 0.1;
      const double before = energy_j(step, state);
      ASSERT_TRUE(step.step(state, external));
      const double work = step.work(external, state.v);
      largest_j = std::max(largest_j, before);
      // what an iteration leaves undone is of its tolerance
      const double undone = law == DynamicLaw::kLinear ? 1e-6 : 1e-3;
      ASSERT_LE(energy_j(step, state), before + work + undone * largest_j) << i;
    }
  }
}

// A slice of the precomputed part goes, and all beyond it hangs on nothing.
TEST_F(HybridCutStepTest, APieceOfBothPartsFallsWithGAndWithoutForcesOfItsOwn) {
  for (const DynamicLaw law : {DynamicLaw::kLinear, DynamicLaw::kCorotational}) {
    HybridCutStep step = made(kCutStep_s, law);
    std::vector<TetId> slice, piece;
    for (std::size_t t = 0; t < beam_.mesh.tetrahedra.size(); ++t) {
      double x = 0;
      for (const NodeId n : beam_.mesh.tetrahedra[t]) x += beam_.mesh.positions[n].x() / 4;
      if (x > 0.015 && x < 0.03) slice.emplace_back(t);
      if (x > 0.03) piece.emplace_back(t);
    }
    step.let_go(piece);
    ASSERT_TRUE(step.remove(slice));
    Values weight(beam_.components());
    std::vector<bool> falls(weight.size() / 3);
    for (const TetId t : piece)
      for (const NodeId n : beam_.mesh.tetrahedra[t]) falls[n] = true;
    double total_kg = 0;
    for (std::size_t n = 0; n < falls.size(); ++n) {
      if (!falls[n]) continue;
      weight[3 * n + 2] = -9.81 * step.mass()[n];
      total_kg += step.mass()[n];
    }
    EXPECT_NEAR(total_kg, 1050 * 0.09 * 0.03 * 0.03, 1e-9 + 1e-3 * total_kg);
    BodyState state = state_at_rest(falls.size());
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(step.step(state, weight));
    for (std::size_t n = 0; n < falls.size(); ++n)
      EXPECT_NEAR(state.v[3 * n + 2], falls[n] ? -9.81 * 0.2 : 0, 2e-3) << n;
    // and what is cut of it afterwards was never without a mass
    const TetId more = piece.front();
    EXPECT_TRUE(step.remove({&more, 1}));
    EXPECT_TRUE(step.step(state, weight));
  }
}

TEST_F(HybridCutStepTest, WithoutADynamicPartsTurningBothLawsAreOneUnderSmallLoads) {
  HybridCutStep linear = made(), turning = made(kCutStep_s, DynamicLaw::kCorotational);
  BodyState a = state_at_rest(beam_.mesh.positions.size()), b = a;
  Values f = loads();
  for (double& value : f) value *= 1e-3;
  const std::vector<TetId> gone = cut(some(20, 5));
  ASSERT_TRUE(linear.remove(gone) && turning.remove(gone));
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(linear.step(a, f) && turning.step(b, f));
  EXPECT_LE(off(b.u, a.u), 5e-3);  // an equation may lack a thousandth
}

TEST_F(HybridCutStepTest, WhatWasCutAndLetGoComesBack) {
  for (const DynamicLaw law : {DynamicLaw::kLinear, DynamicLaw::kCorotational}) {
    HybridCutStep step = made(kCutStep_s, law);
    Values force(beam_.components()), before(force.size()), cut(force.size()), after(force.size());
    force[3 * static_cast<std::size_t>(beam_.nearest({0.12, 0.015, 0.03})) + 2] = 1;
    step.yield_to(force, before);
    const std::vector<TetId> gone = some(10, 3);
    step.let_go(gone);
    ASSERT_TRUE(step.remove(gone));
    step.yield_to(force, cut);
    step.restore();
    step.yield_to(force, after);
    EXPECT_NE(before, cut);
    EXPECT_EQ(before, after);
  }
}

TEST_F(HybridCutStepTest, NothingIsAllocated) {
  for (const DynamicLaw law : {DynamicLaw::kLinear, DynamicLaw::kCorotational}) {
    HybridCutStep step = made(kCutStep_s, law);
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    const Values external = loads();
    const std::vector<TetId> gone = some(6, 3);
    const std::size_t before = test::heap_allocations();
    step.let_go(std::span(gone).first(2));
    bool sound = step.remove(gone) && step.step(state, external);
    step.restore();
    EXPECT_EQ(test::heap_allocations(), before);
    EXPECT_TRUE(sound);
  }
}

}  // namespace
}  // namespace omentum::physics
