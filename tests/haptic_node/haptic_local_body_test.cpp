// Local models: pieces of an organ as bodies of their own.
#include "haptic_fixtures.h"
#include "haptic_node/local_body.h"

#include <algorithm>

namespace omentum::haptic_test {
namespace {

constexpr double kTop_m = 0.04;  // of the block

// What presses the block, by its own nodes, whatever patch of it stands there.
std::vector<std::pair<SurfaceId, Vec3>> loads_of(Bench& bench) {
  const std::vector<std::uint32_t>& numbers = bench.model().organs[0].file_node;
  const std::span<const std::uint32_t> of_body = bench.work().bodies[haptic::BodyId(0)].origin().file_node;
  std::vector<std::pair<SurfaceId, Vec3>> loads;
  for (const haptic::NodeForce& entry : bench.state().forces()) {
    const auto at = std::ranges::find(numbers, of_body[static_cast<std::size_t>(entry.node)]);
    loads.emplace_back(static_cast<std::size_t>(at - numbers.begin()), entry.force);
  }
  return loads;
}

// What deform_node would tell of the block around a place, under the forces that press it.
haptic::LocalPatch patch_around(const Vec3& place, double radius_m, Bench& bench) {
  haptic::LocalPatch patch;
  const haptic::ElasticSurface& organ = bench.model().organs[0];
  std::vector<SurfaceId> nodes;
  std::vector<std::int32_t> local(organ.rest.size(), -1);
  const auto add = [&](SurfaceId n) {
    if (local[n] < 0) local[n] = static_cast<std::int32_t>(nodes.size()), nodes.push_back(n);
    return SurfaceId(local[n]);
  };
  for (const geometry::Triangle& t : organ.surface.triangles) {
    const bool near = std::ranges::all_of(t, [&](SurfaceId n) {
      return n < organ.surface.mobile_count && (organ.rest[n] - place).norm() < radius_m;
    });
    if (near) patch.triangles.push_back({add(t[0]), add(t[1]), add(t[2])});
  }
  patch.forces.assign(nodes.size(), Vec3::Zero());
  const auto loads = loads_of(bench);
  for (const auto& [node, force] : loads)
    if (local[node] >= 0) patch.forces[static_cast<std::size_t>(local[node])] += force;
  for (const SurfaceId n : nodes) {
    Vec3 x = organ.rest[n];
    for (const auto& [node, force] : loads) x += organ.compliance.block(n, node).cast<double>() * force;
    patch.positions.push_back(x);
    patch.nodes.push_back(organ.file_node[n]);
  }
  for (std::size_t i = 0; i < 3 * nodes.size(); ++i) {
    for (std::size_t j = i; j < 3 * nodes.size(); ++j)
      patch.compliance.push_back(
          static_cast<float>(organ.compliance.block(nodes[i / 3], nodes[j / 3])(i % 3, j % 3)));
  }
  return patch;
}

TEST(LocalBody, APatchIsFeltLikeTheOrganThatItWasTakenFrom) {
  Bench whole(make_model(block(), {round_tool()})),
      local(with_spare_place(make_model(block(), {round_tool()})));
  const Vec3 over(0.05, 0.05, kTop_m + 0.003), down(0, 0, -0.008);
  local.work().doors[0].post(haptic::make_local_body(patch_around({0.05, 0.05, kTop_m}, 0.035, local)));
  for (int i = 0; i <= 400; ++i) {
    // down, and along once it presses
    const Vec3 tip = over + down * std::min(i, 200) / 200 + Vec3(0.01, 0, 0) * std::max(0, i - 200) / 200;
    const Vec3 expected = whole.step_to(tip), felt = local.step_to(tip);
    EXPECT_LE((felt - expected).norm(), 1e-3 * (0.1 + expected.norm())) << "tick " << i;
  }
  EXPECT_GT(local.output().force.z(), 0.1);
}

TEST(LocalBody, OneThatComesUnderAPressHoldsTheSameForce) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to({0.05, 0.05, kTop_m + 0.003});
  const Vec3 pressed(0.05, 0.05, kTop_m - 0.004);
  const Vec3 before = bench.move_to(pressed, 200);
  bench.work().doors[0].post(haptic::make_local_body(patch_around({0.05, 0.05, kTop_m}, 0.035, bench)));
  for (int i = 0; i < 20; ++i) EXPECT_LE((bench.step_to(pressed) - before).norm(), 2e-3 * before.norm());
}

// Pressed while it is soft and left while it is stiff, tissue would give energy in each round.
TEST(LocalBody, ModelsThatTakeTurnsGiveAHandNothingInSum) {
  Bench bench(with_spare_place(make_model(block(), {round_tool()})));
  const Vec3 over(0.05, 0.05, kTop_m + 0.003), shallow(0.05, 0.05, kTop_m - 0.003),
      deep(0.05, 0.05, kTop_m - 0.006);
  const haptic::LocalPatch soft = patch_around({0.05, 0.05, kTop_m}, 0.035, bench);
  haptic::LocalPatch stiff = soft;
  for (float& c : stiff.compliance) c *= 0.7f;
  double given_j = 0, highest_n = 0;
  Vec3 at = over, force = Vec3::Zero();
  const auto go = [&](const Vec3& to, int ticks) {
    const Vec3 from = at;
    for (int i = 1; i <= ticks; ++i) {
      bench.state().now_ns += 1'000'000;
      const Vec3 next = from + (to - from) * i / ticks, felt = bench.step_to(next);
      given_j += 0.5 * (felt + force).dot(next - at);
      force = felt;
      at = next;
      highest_n = std::max(highest_n, force.norm());
    }
  };
  const auto becomes = [&](const haptic::LocalPatch& patch) {
    bench.work().doors[0].post(haptic::make_local_body(patch));
    go(at, 20);
  };
  becomes(soft);
  go(over, 1);
  go(shallow, 100);
  constexpr int kRounds = 20;
  const double naive_j = 0.3 * highest_n * (shallow - deep).norm() * kRounds;
  for (int i = 0; i < kRounds; ++i) {
    go(deep, 50);
    becomes(stiff);
    go(shallow, 50);
    becomes(soft);
  }
  go(over, 100);
  EXPECT_LT(given_j, 0.05 * naive_j);
  EXPECT_LE(bench.state().tools[0].changes.credited_j, 0);
  EXPECT_GT(bench.state().tools[0].changes.given_j, 0) << "counted";
}

TEST(LocalBody, NobodyIsInsideBeyondItsBorder) {
  Bench bench(make_model(block(), {needle()}));
  bench.work().doors[0].post(haptic::make_local_body(patch_around({0.05, 0.05, kTop_m}, 0.025, bench)));
  // beside the patch, deep below its plane
  bench.step_to({0.085, 0.05, kTop_m - 0.01});
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bench.step_to({0.085, 0.05, kTop_m - 0.01}), Vec3(0, 0, 0));
  EXPECT_EQ(bench.state().contact_count, 0);
}

TEST(LocalBody, WhatIsNoPatchIsRefused) {
  Bench bench(make_model(block(), {needle()}));
  const haptic::LocalPatch good = patch_around({0.05, 0.05, kTop_m}, 0.025, bench);
  ASSERT_EQ(haptic::reason_against(good, 1), std::nullopt);
  const auto refused = [&](auto&& spoil) {
    haptic::LocalPatch patch = good;
    spoil(patch);
    return haptic::reason_against(patch, 1).has_value();
  };
  EXPECT_TRUE(refused([](auto& p) { p.forces.pop_back(); }));
  EXPECT_TRUE(refused([](auto& p) { p.compliance.pop_back(); }));
  EXPECT_TRUE(refused([](auto& p) { p.compliance[0] = -1; })) << "a node that comes towards its push";
  EXPECT_TRUE(refused([](auto& p) { p.compliance[5] *= 1e4f; })) << "a neighbour that goes farther";
  EXPECT_TRUE(refused([](auto& p) {
    // every pair by itself is possible, all of them together are not
    const std::size_t rows = 3 * p.positions.size();
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = i; j < rows; ++j) p.compliance[at++] = i == j ? 1e-3f : -0.9e-3f;
    }
  })) << "a press that gives energy";
  EXPECT_TRUE(refused([](auto& p) { p.organ = 1; }));
  EXPECT_TRUE(refused([](auto& p) { p.triangles[0][1] = p.triangles[0][0]; }));
  EXPECT_TRUE(refused([](auto& p) { std::ranges::fill(p.positions, p.positions[0]); }));
  EXPECT_TRUE(refused([](auto& p) { std::ranges::fill(p.forces, Vec3(0, 0, 1e12)); }));
  EXPECT_TRUE(refused([](auto& p) { p.positions[3].x() = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& p) { p.triangles[0][1] = SurfaceId(4000); }));
  EXPECT_TRUE(refused([](auto& p) { p.triangles[0][1] = SurfaceId(-1); }));
  EXPECT_TRUE(refused([](auto& p) { p.triangles.clear(); }));
  EXPECT_TRUE(refused([](auto& p) { p = {}; }));
}

// Jaws at the border of a patch, and patches that come around other places.
TEST(LocalBody, JawsKeepWhatTheNextPatchHasAndLoseTheRestWithoutGain) {
  haptic::ToolModel grasper = round_tool();
  grasper.grasps = true;
  Bench bench(with_spare_place(make_model(block(), {grasper})));
  const Vec3 border(0.075, 0.05, kTop_m);
  const haptic::LocalPatch here = patch_around({0.05, 0.05, kTop_m}, 0.035, bench);
  bench.work().doors[0].post(haptic::make_local_body(here));
  double given_j = 0, put_in_j = 0;
  const auto go = [&](const Vec3& to, double grip, int ticks) {
    const Vec3 from = bench.input().engaged ? bench.input().frame.p_WT : to;
    const double grip_before = bench.input().grip;
    for (int i = 1; i <= ticks; ++i) {
      bench.state().now_ns += 1'000'000;
      const haptic::ToolInput before = bench.input();
      const haptic::ToolOutput felt = bench.output();
      bench.place(0, from + (to - from) * i / ticks, grip_before + (grip - grip_before) * i / ticks).step();
      given_j += 0.5 * (felt.force + bench.output().force).dot(bench.input().frame.p_WT - before.frame.p_WT) +
                 0.5 * (felt.grip_torque + bench.output().grip_torque) * (bench.input().grip - before.grip);
      put_in_j = std::max(put_in_j, -given_j);
    }
  };
  go(border + Vec3(0, 0, 0.003), 0.5, 1);
  go(border - Vec3(0, 0, 0.002), 0.5, 100);
  go(border - Vec3(0, 0, 0.002), 0.02, 100);
  ASSERT_TRUE(bench.output().grasping);
  go(border + Vec3(0, 0, 0.003), 0.02, 100);
  const Vec3 pulled = bench.output().force;
  ASSERT_LT(pulled.z(), -0.1);
  bench.work().doors[0].post(haptic::make_local_body(patch_around({0.065, 0.05, kTop_m}, 0.03, bench)));
  go(border + Vec3(0, 0, 0.003), 0.02, 20);
  EXPECT_TRUE(bench.output().grasping);
  EXPECT_LE((bench.output().force - pulled).norm(), 0.02 * pulled.norm());
  bench.work().doors[0].post(haptic::make_local_body(patch_around({0.03, 0.05, kTop_m}, 0.025, bench)));
  go(border + Vec3(0, 0, 0.003), 0.02, 20);
  EXPECT_FALSE(bench.output().grasping);
  EXPECT_EQ(bench.output().force, Vec3::Zero());
  EXPECT_EQ(bench.output().grip_torque, 0);
  EXPECT_EQ(bench.state().tools[0].grasps.lost, 1u);
  go(border + Vec3(0, 0, 0.02), 0.5, 100);
  EXPECT_LE(given_j, 0.01 * put_in_j);
}

}  // namespace
}  // namespace omentum::haptic_test
