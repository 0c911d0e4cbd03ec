#include "tests/deform_node/gut_stage.h"
#include "tests/support/heap_count.h"

#include <Eigen/Eigenvalues>

#include <map>
#include <numbers>

namespace omentum::deform {
namespace {

std::vector<float> values_of(const GutModel& model) {
  return {model.view().values.begin(), model.view().values.end()};
}

TEST(GutModel, ShowsTheMassesPlaces) {
  const GutModel model = gut_model();
  const OrganView view = model.view();
  EXPECT_EQ(view.kind, StateKind::kTube);
  ASSERT_EQ(view.values.size(), 3 * small_gut().positions.size());
  EXPECT_EQ(view.values[3], static_cast<float>(small_gut().positions[1].x()));
  EXPECT_EQ(model.sizes().values, view.values.size());
  EXPECT_EQ(model.sizes().spheres, model.collidable().size());
}

TEST(GutModel, GoesOnByItsOwnStepsAsTheClockDoes) {
  GutModel model = gut_model({.step_s = 0.004});
  for (int tick = 0; tick < 100; ++tick) model.step({}, kGutTick_s);
  EXPECT_EQ(model.status().steps, 250u);
  EXPECT_NEAR(model.status().simulated_s, 1, 1e-12);
}

TEST(GutModel, AResetIsTheStartAgainAndTheSameRun) {
  GutModel model = gut_model({.gravity_m_s2 = {0, 0, -9.81}});
  const std::vector<float> start = values_of(model);
  for (int tick = 0; tick < 30; ++tick) model.step({}, kGutTick_s);
  const std::vector<float> moved = values_of(model);
  EXPECT_NE(moved, start);
  model.reset();
  EXPECT_EQ(values_of(model), start);
  for (int tick = 0; tick < 30; ++tick) model.step({}, kGutTick_s);
  EXPECT_EQ(values_of(model), moved);
}

TEST(GutModel, WhatLiesStillIsToldToLieStill) {
  const physics::GutObstacle plane{.centre = Vec3(0, 0, -0.2)};
  GutModel model = gut_model({.step_s = 0.0025, .gravity_m_s2 = {0, 0, -9.81}, .obstacles = {plane}});
  for (int tick = 0; tick < 1500; ++tick) model.step({}, kGutTick_s);
  const std::vector<Vec3> places = skin_places(model);
  LocalPatch patch(GutModel::kPatchNodes);
  std::map<std::uint32_t, Vec3> told_m_s;
  for (std::size_t n = 0; n < places.size(); n += 60) {
    if (!model.local_model({0, places[n], 0.02}, patch)) continue;
    for (std::size_t i = 0; i < patch.node_count; ++i) told_m_s[patch.nodes[i]] = patch.velocities[i];
  }
  model.step({}, kGutTick_s);
  const std::vector<Vec3> after = skin_places(model);
  double mean_m_s = 0, worst_m_s = 0;  // of what is told, and how wrong that is
  for (const auto& [n, v] : told_m_s) {
    mean_m_s += v.norm() / static_cast<double>(told_m_s.size());
    worst_m_s = std::max(worst_m_s, (v - (after[n] - places[n]) / kGutTick_s).norm());
  }
  EXPECT_LT(mean_m_s, 1e-3);
  EXPECT_LT(worst_m_s, 1e-3);
}

// ---- touch

/// What a patch says of one of its nodes.
struct ToldNode {
  Vec3 place, speed, force;
  double yields_m_n;

  Vec3 after(double t_s, const Vec3& other_force) const {
    return place + t_s * speed + yields_m_n * (other_force - force);
  }
};

ToldNode told_of(const GutModel& model, NodeId node, const Vec3& around) {
  LocalPatch patch(GutModel::kPatchNodes);
  EXPECT_TRUE(model.local_model({0, around, 0.015}, patch));
  const auto number = static_cast<std::uint32_t>(std::int32_t{node});
  const auto at = static_cast<std::size_t>(std::ranges::find(patch.nodes, number) - patch.nodes.begin());
  EXPECT_LT(at, patch.node_count);
  const std::size_t row = 3 * at, rows = 3 * patch.node_count;
  return {patch.positions[at], patch.velocities[at], patch.forces[at],
          patch.compliance[row * rows - row * (row - 1) / 2]};
}

// A press that has just begun moves the gut faster and faster, and a hand that goes along has to know.
TEST(GutModel, ALocalModelForetellsWhereItsOwnPressTakesTheGut) {
  GutModel model = gut_model({.step_s = 0.0025});
  const NodeId node = highest_node();
  const Vec3 begin = skin_places(model)[static_cast<std::size_t>(std::int32_t{node})], pull(0, 0.3, 0.5);
  ToldNode told = told_of(model, node, begin);
  for (int tick = 0; tick < 10; ++tick) {
    const Vec3 hand = told.after(kGutTick_s, pull), way = hand - begin;
    const ToolLoad load{.tool = 0, .nodes = {&node, 1}, .displacements = {&way, 1}, .forces = {&pull, 1}};
    model.step({.presses = {&load, 1}, .cuts = {}}, kGutTick_s);
    const ToldNode now = told_of(model, node, hand);
    const double went_m = (now.place - told.place).norm();
    // at first the gut yields more than the constant matrix of a step says
    if (tick > 1) {
      EXPECT_LT((now.place - told.after(kGutTick_s, now.force)).norm(), 0.05 * went_m) << tick;
    }
    told = now;
  }
}

// Jaws that hurry ahead across what they pull take the gut along; a press goes by its force there.
TEST(GutModel, AGraspHoldsAcrossItsForceToo) {
  const NodeId node = highest_node();
  const auto lacking_m = [&](bool grasps) {
    GutModel model = gut_model({.step_s = 0.0025});
    const Vec3 begin = skin_places(model)[static_cast<std::size_t>(std::int32_t{node})], pull(0, 0, 0.5);
    ToldNode told = told_of(model, node, begin);
    Vec3 hand = begin;
    for (int tick = 0; tick < 10; ++tick) {
      hand = told.after(kGutTick_s, pull) + Vec3(0.0005, 0.0005, 0);
      const Vec3 way = hand - begin;
      const ToolLoad load{
          .tool = 0, .nodes = {&node, 1}, .displacements = {&way, 1}, .forces = {&pull, 1}, .grasps = grasps};
      model.step({.presses = {&load, 1}, .cuts = {}}, kGutTick_s);
      told = told_of(model, node, hand);
    }
    const Vec3 apart = told.place - hand;
    return Vec3(apart.x(), apart.y(), 0).norm();
  };
  EXPECT_LT(lacking_m(true), 0.5 * lacking_m(false));
}

struct Rates {
  double step_s, hand_hz;
};

struct Held {
  double force_n = 0, stiffest_n = 0;
  double given_j = 0, put_in_j = 0;  // to the hand while it goes up and down, and by it until then
};

// Up within half a second, still until 2 s, then up and down by 4 mm twice a second, and back to the start.
double height_at(double t, double most_m) {
  if (t < 2) return most_m * std::clamp((t - 0.1) / 0.5, 0.0, 1.0);
  if (t < 4) return most_m + 0.004 * std::sin(2 * std::numbers::pi * 2 * (t - 2));
  return most_m * std::clamp((4.5 - t) / 0.5, 0.0, 1.0);
}

Held hold(const Rates& rates, GutStageOptions options, double most_m) {
  options.step_s = rates.step_s;
  GutModel model = gut_model(options);
  const NodeId node = highest_node();
  const Vec3 begin = skin_places(model)[static_cast<std::size_t>(std::int32_t{node})];
  HoldingHand hand(node, begin);
  Held held;
  int count = 0;
  const double period_s = 1 / rates.hand_hz;
  double organ_s = 0;
  hand.learn(model);
  for (double t = 0; t < 4.5; t += period_s) {
    const double height = height_at(t, most_m), force = hand.hold({0, 0, height}, period_s).z();
    const double work_j = force * (height_at(t + period_s, most_m) - height);
    if (t < 2) held.put_in_j += work_j;
    held.given_j -= work_j;
    if (t > 1.5 && t < 2) held.force_n += (force - held.force_n) / ++count;
    if (t < organ_s) continue;
    organ_s += kGutTick_s;
    const ToolLoad load = hand.load();
    model.step({.presses = {&load, 1}, .cuts = {}}, kGutTick_s);
    EXPECT_FALSE(model.status().diverged);
    hand.learn(model);
  }
  return held;
}

TEST(GutModel, AHoldForceIsTheSameAtEveryStepAndRateAndNoEnergyComesBack) {
  const Held expected = hold({0.01, 1000}, {}, 0.03);
  EXPECT_GT(expected.force_n, 0.1);
  for (const double step_s : {0.0025, 0.005, 0.01}) {
    for (const double hand_hz : {300.0, 1000.0}) {
      const Held held = hold({step_s, hand_hz}, {}, 0.03);
      EXPECT_NEAR(held.force_n, expected.force_n, 0.03 * expected.force_n) << step_s << " " << hand_hz;
      EXPECT_LT(held.given_j, 0.02 * held.put_in_j) << step_s << " " << hand_hz;
    }
  }
}

TEST(GutModel, AHoldForceIsTheSameInExplicitSteps) {
  const Held expected = hold({0.01, 1000}, {}, 0.03);
  const Held held = hold({0.00005, 1000}, {.method = physics::GutMethod::kExplicit}, 0.03);
  EXPECT_NEAR(held.force_n, expected.force_n, 0.03 * expected.force_n);
  EXPECT_LT(held.given_j, 0.05 * held.put_in_j);
}

TEST(GutModel, AGutThatCannotMoveAnswersWithItsWallAloneAtEveryStep) {
  const NodeId node = highest_node();
  const Vec3 top = skin_places(gut_model())[static_cast<std::size_t>(std::int32_t{node})];
  physics::GutObstacle ceiling;
  ceiling.centre = top;
  ceiling.axes = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  constexpr double kPulled_m = 0.006, kSagitta_m = 0.0015, kWall_n_m = 300;
  const GutStageOptions below{.obstacles = {ceiling}};
  const double expected = hold({0.01, 1000}, below, kPulled_m).force_n;
  // masses lie on a polygon, the skin on a curve that reaches over it by its sagitta
  EXPECT_GT(expected, 0.97 * kWall_n_m * (kPulled_m - kSagitta_m));
  EXPECT_LT(expected, 1.03 * kWall_n_m * kPulled_m);
  for (const double step_s : {0.0025, 0.005})
    EXPECT_NEAR(hold({step_s, 1000}, below, kPulled_m).force_n, expected, 0.03 * expected) << step_s;
}

TEST(GutModel, TheMesenteryTightensUnderAPull) {
  const double near_n = hold({0.01, 1000}, {}, 0.02).force_n, far_n = hold({0.01, 1000}, {}, 0.04).force_n;
  EXPECT_GT(far_n, 1.5 * near_n);
}

TEST(GutModel, APatchIsOneThatAHandCanTake) {
  GutModel model = gut_model({.gravity_m_s2 = {0, 0, -9.81}});
  for (int tick = 0; tick < 50; ++tick) model.step({}, kGutTick_s);
  LocalPatch patch(GutModel::kPatchNodes);
  int patches = 0;
  for (const Vec3& place : skin_places(model)) {
    if (!model.local_model({0, place, 0.015}, patch)) continue;
    ++patches;
    ASSERT_GE(patch.node_count, 3u);
    std::vector<bool> is_corner(patch.node_count);
    for (std::size_t t = 0; t < patch.triangle_count; ++t)
      for (const std::uint8_t corner : patch.triangles[t]) is_corner.at(corner) = true;
    ASSERT_TRUE(std::ranges::all_of(is_corner, std::identity{}));
    const auto rows = static_cast<Eigen::Index>(3 * patch.node_count);
    Eigen::MatrixXd C(rows, rows);
    const float* upper = patch.compliance.data();
    for (Eigen::Index r = 0; r < rows; ++r)
      for (Eigen::Index c = r; c < rows; ++c) C(r, c) = C(c, r) = static_cast<double>(*upper++);
    ASSERT_GT(C.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.9 / 300);
    if (patches > 200) break;
  }
  EXPECT_GT(patches, 100);
}

/// The face of the tube that lies lowest, where a loop is highest.
std::array<NodeId, 3> lower_face() {
  const geometry::GutSkin skin(small_gut());
  const std::vector<Vec3> places = skin_places(gut_model());
  const auto place = [&](NodeId n) { return places[static_cast<std::size_t>(std::int32_t{n})]; };
  const Vec3 below = place(highest_node()) - Vec3(0, 0, 2 * small_gut().tube_radius_m);
  return *std::ranges::min_element(skin.triangles(), {}, [&](const auto& face) {
    return (place(face[0]) + place(face[1]) + place(face[2]) - 3 * below).norm();
  });
}

bool has_face(const LocalPatch& patch, const std::array<NodeId, 3>& face) {
  const auto is_it = [&](const auto& corners) {
    for (std::size_t k = 0; k < 3; ++k)
      if (patch.nodes[corners[k]] != static_cast<std::uint32_t>(std::int32_t{face[k]})) return false;
    return true;
  };
  return std::any_of(patch.triangles.begin(),
                     patch.triangles.begin() + static_cast<std::ptrdiff_t>(patch.triangle_count), is_it);
}

/// Draws a loop up by its lower face, which is then inside its bend, and says whether a hand is told of that
/// face to the end.
bool is_told_of_what_it_draws(bool grasping) {
  GutModel model = gut_model({.step_s = 0.0025});
  const std::array<NodeId, 3> face = lower_face();
  LocalPatch patch(GutModel::kPatchNodes);
  bool told = true;
  for (int tick = 0; tick < 100 && told; ++tick) {
    const Vec3 way(0, 0, 0.0015 * tick), share(0, 0, 4);
    const std::array<Vec3, 3> ways{way, way, way}, shares{share, share, share};
    const ToolLoad load{
        .tool = 0, .nodes = face, .displacements = ways, .forces = shares, .grasps = grasping};
    model.step({.presses = {&load, 1}, .cuts = {}}, kGutTick_s);
    const Vec3 place = skin_places(model)[static_cast<std::size_t>(std::int32_t{face[0]})];
    told = model.local_model({0, place, 0.015}, patch) && has_face(patch, face);
  }
  return told;
}

TEST(GutModel, JawsAreToldOfWhatTheyHoldHoweverTheLoopBendsThere) {
  EXPECT_FALSE(is_told_of_what_it_draws(false)) << "a face that folds up is no place to touch";
  EXPECT_TRUE(is_told_of_what_it_draws(true));
}

TEST(GutModel, NothingInAStepOrAPatchTakesMemory) {
  GutModel model = gut_model({.gravity_m_s2 = {0, 0, -9.81}});
  const NodeId node = highest_node();
  const Vec3 begin = skin_places(model)[static_cast<std::size_t>(std::int32_t{node})];
  const Vec3 way(0, 0, 0.005), force(0, 0, 0.5);
  const ToolLoad load{.tool = 0, .nodes = {&node, 1}, .displacements = {&way, 1}, .forces = {&force, 1}};
  const OrganContact contact{.sphere = 3, .share = 0.5, .push_m_s = 0.1};
  LocalPatch patch(GutModel::kPatchNodes);
  model.step({}, kGutTick_s);
  const std::size_t before = test::heap_allocations();
  for (int tick = 0; tick < 5; ++tick) {
    model.step({.presses = {&load, 1}, .cuts = {}}, kGutTick_s);
    model.local_model({0, begin, 0.02}, patch);
    model.respond({&contact, 1});
  }
  model.reset();
  EXPECT_EQ(test::heap_allocations(), before);
}

// ---- other organs

TEST(GutModel, SpheresFollowTheAxisWithoutGaps) {
  const GutModel model = gut_model();
  const auto spheres = model.collidable();
  double mass_kg = 0;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    mass_kg += spheres[s].mass_kg;
    EXPECT_EQ(spheres[s].radius_m, small_gut().tube_radius_m);
    if (s == 0) continue;
    EXPECT_LT((spheres[s].centre - spheres[s - 1].centre).norm(), 1.5 * small_gut().tube_radius_m);
  }
  EXPECT_GT(mass_kg, 0.5);
}

TEST(GutModel, APushIsSeenInWhatItShowsAndInTheNextStep) {
  GutModel model = gut_model();
  const std::size_t sphere = model.collidable().size() / 2;
  const Vec3 before = model.collidable()[sphere].centre;
  OrganContact contact{
      .sphere = static_cast<std::int32_t>(sphere), .normal = Vec3::UnitY(), .share = 0.5, .push_m_s = 0.4};
  model.respond({&contact, 1});
  const double foreseen_m_s = model.collidable()[sphere].velocity.y();
  EXPECT_GT(foreseen_m_s, 0.01);
  EXPECT_LT(foreseen_m_s, 0.2) << "a push moves the neighbours along";
  model.respond({&contact, 1});
  EXPECT_NEAR(model.collidable()[sphere].velocity.y(), 2 * foreseen_m_s, 0.1 * foreseen_m_s)
      << "calls add up";
  contact.push_m_s = -0.4;
  model.respond({&contact, 1});
  model.step({}, kGutTick_s);
  EXPECT_NEAR((model.collidable()[sphere].centre - before).y(), kGutTick_s * foreseen_m_s,
              0.1 * kGutTick_s * foreseen_m_s);
}

}  // namespace
}  // namespace omentum::deform
