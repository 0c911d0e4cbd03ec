#include "deform_node/gut_maker.h"

#include "deform_node/served_organ.h"
#include "geometry/gut_skin.h"

#include <gmock/gmock.h>

namespace omentum::deform {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

scene::OrganSpec spec() {
  scene::OrganSpec spec;
  spec.name = "gut";
  spec.model = "intestine";
  spec.kind = scene::OrganKind::kTube;
  scene::IntestineSpec& intestine = spec.intestine.emplace();
  intestine.where = "scene.toml:4";
  intestine.anatomy.length_m = 1.6;
  intestine.anatomy.legs = 3;
  intestine.anatomy.columns = 40;
  return spec;
}

std::unique_ptr<OrganModel> made(const scene::OrganSpec& spec) {
  return make_intestine(node::load_organ_source({}, spec, organ::Load::kMeshOnly), spec);
}

struct ObstacleTrial {
  const char* shape;
  double half_m;
  bool fits;
};

std::string refusal_of(const scene::OrganSpec& spec) {
  try {
    made(spec);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "made";
}

TEST(GutMaker, AnIntestineNeedsNothingBesideItsNumbers) {
  const auto model = made(spec());
  EXPECT_EQ(model->view().kind, StateKind::kTube);
  EXPECT_EQ(model->sizes().values, 3u * 4 * 40);
  for (int tick = 0; tick < 5; ++tick) model->step({}, 0.01);
  EXPECT_EQ(model->status().steps, 20u) << "four in a tick of deform_node";
  EXPECT_FALSE(model->status().diverged);
}

TEST(GutMaker, AnExplicitOneTakesHalfOfTheLargestStableStep) {
  scene::OrganSpec small_steps = spec();
  small_steps.intestine->method = "explicit";
  const auto model = made(small_steps);
  model->step({}, 0.01);
  EXPECT_GT(model->status().steps, 2u);
  EXPECT_FALSE(model->status().diverged);
}

TEST(GutMaker, AnExplicitStepBeyondTheStableOneIsRefusedWithIt) {
  scene::OrganSpec wrong = spec();
  wrong.intestine->method = "explicit";
  wrong.intestine->step_s = 0.02;
  EXPECT_THAT(refusal_of(wrong), AllOf(HasSubstr("scene.toml:4: organ gut: "), HasSubstr("step_s")));
}

TEST(GutMaker, AMaterialWithoutMassIsRefusedByItsName) {
  scene::OrganSpec wrong = spec();
  wrong.intestine->material.gut_mass_kg_m = 0;
  EXPECT_THAT(refusal_of(wrong), AllOf(HasSubstr("scene.toml:4: organ gut: "), HasSubstr("gut_mass_kg_m")));
}

TEST(GutMaker, AStartInAnObstacleIsRefusedByBothLines) {
  scene::OrganSpec wrong = spec();
  wrong.intestine->obstacles = {
      {.shape = "plane", .centre = {0, 0, -0.02}, .normal = Vec3::UnitZ(), .where = "scene.toml:17"}};
  EXPECT_THAT(refusal_of(wrong), AllOf(HasSubstr("scene.toml:4: organ gut: starts 0.0"),
                                       HasSubstr(" m in the plane, near ["), HasSubstr("scene.toml:17")));
  const ObstacleTrial trials[] = {
      {"box", 0.3, true}, {"box", 0.1, false}, {"ellipsoid", 0.4, true}, {"ellipsoid", 0.15, false}};
  for (const auto& [shape, half_m, fits] : trials) {
    wrong.intestine->obstacles = {{.shape = shape, .half_axes_m = Vec3::Constant(half_m)}};
    EXPECT_EQ(refusal_of(wrong) == "made", fits) << shape << " " << half_m;
  }
}

TEST(GutMaker, AHandsNodesAreThoseOfTheSkin) {
  const node::OrganSource source = node::load_organ_source({}, spec(), organ::Load::kMeshOnly);
  const OrganNumbers numbers = numbers_of(source);
  const geometry::GutSkin skin(*source.gut);
  ASSERT_EQ(numbers.node_of_file.size(), skin.node_count());
  EXPECT_EQ(numbers.node_of_file[17], NodeId(17));
  EXPECT_TRUE(numbers.pinned[0]) << "the ring at the held end";
  EXPECT_FALSE(numbers.pinned[200]);
  EXPECT_GT(numbers.reach_m, 0.5);
}

TEST(GutMaker, APlaneHoldsItUp) {
  scene::OrganSpec lying = spec();
  lying.intestine->obstacles = {{.shape = "plane", .centre = {0, 0, -0.085}, .normal = Vec3::UnitZ()}};
  const auto model = made(lying);
  for (int tick = 0; tick < 200; ++tick) model->step({}, 0.01);
  float lowest = 1;
  for (std::size_t i = 2; i < 3u * 40; i += 3) lowest = std::min(lowest, model->view().values[i]);
  EXPECT_GT(lowest, -0.085 + 0.9 * 0.02) << "the axis stays nearly a radius above it";
  EXPECT_LT(lowest, -0.03);
  const auto collisions = model->status().collisions;
  ASSERT_TRUE(collisions);
  EXPECT_GT(collisions->contacts, 800u) << "one in each step at least, once it lies";
  EXPECT_LT(collisions->deepest_m, 0.02);
  const std::uint64_t contacts = collisions->contacts;
  model->reset();
  EXPECT_EQ(model->status().collisions->contacts, contacts) << "over resets";
}

}  // namespace
}  // namespace omentum::deform
