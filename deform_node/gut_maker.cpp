#include "deform_node/gut_maker.h"

#include "deform_node/gut_model.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace omentum::deform {

namespace {

using physics::GutMethod;

// Four in each tick at deform_node's own rate: loops that lie on each other tremble in longer ones.
constexpr double kProjectiveStep_s = 0.0025;
// A hand goes by a local model until the next one comes, a tick later.
constexpr double kFeltStep_s = 0.01;
// Of the largest step that is stable: contacts come between.
constexpr double kShareOfGutStable = 0.5;

physics::GutMaterial material_of(const scene::GutMaterialSpec& spec) {
  physics::GutMaterial material;
  const auto take = [](double& value, const std::optional<double>& said) { value = said.value_or(value); };
  take(material.gut_mass_kg_m, spec.gut_mass_kg_m);
  take(material.gut_stretch_n, spec.gut_stretch_n);
  take(material.gut_bending_n_m2, spec.gut_bending_n_m2);
  take(material.mesentery_mass_kg_m2, spec.mesentery_mass_kg_m2);
  take(material.mesentery_stretch_n_m, spec.mesentery_stretch_n_m);
  take(material.spring_damping_s, spec.spring_damping_s);
  take(material.calming_time_s, spec.calming_time_s);
  return material;
}

physics::GutCollisionSettings collisions_of(const scene::IntestineSpec& spec) {
  physics::GutCollisionSettings settings;
  settings.method = spec.collision == "stochastic" ? physics::GutPairMethod::kStochastic
                                                   : physics::GutPairMethod::kComplete;
  settings.friction = spec.friction;
  settings.seed = spec.seed;
  return settings;
}

physics::GutObstacle obstacle_of(const scene::ObstacleSpec& spec) {
  physics::GutObstacle obstacle;
  obstacle.centre = spec.centre;
  if (spec.shape == "plane") {
    obstacle.axes = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), spec.normal).toRotationMatrix();
    return obstacle;
  }
  obstacle.kind = spec.shape == "box" ? physics::GutObstacle::Kind::kInsideBox
                                      : physics::GutObstacle::Kind::kInsideEllipsoid;
  obstacle.half_axes_m = spec.half_axes_m;
  return obstacle;
}

std::vector<physics::GutObstacle> obstacles_of(const scene::IntestineSpec& spec) {
  std::vector<physics::GutObstacle> obstacles;
  for (const scene::ObstacleSpec& obstacle : spec.obstacles) obstacles.push_back(obstacle_of(obstacle));
  return obstacles;
}

// A wall would throw out what begins in it. Rounding of a scene's numbers is no overlap.
constexpr double kTouches_m = 1e-6;

void refuse_start_in(const physics::GutObstacle& obstacle, const scene::ObstacleSpec& spec,
                     const geometry::GutShape& gut) {
  const physics::WallClearance least = physics::clearance(gut, obstacle);
  if (least.free_m > -kTouches_m) return;
  const Vec3& p = gut.positions[static_cast<std::size_t>(least.mass)];
  char text[160];
  std::snprintf(text, sizeof text,
                "starts %.4f m in the %s, near [%.3f, %.3f, %.3f]; expected it to start clear of it",
                -least.free_m, spec.shape.c_str(), p.x(), p.y(), p.z());
  throw std::invalid_argument(text + (spec.where.empty() ? "" : " (" + spec.where + ")"));
}

void refuse_start_in_obstacles(const geometry::GutShape& gut, const scene::IntestineSpec& spec) {
  for (const scene::ObstacleSpec& obstacle : spec.obstacles)
    refuse_start_in(obstacle_of(obstacle), obstacle, gut);
}

double step_of(const geometry::GutShape& gut, const physics::GutMaterial& material,
               const scene::IntestineSpec& spec) {
  if (spec.step_s) return *spec.step_s;
  if (spec.method == "projective") return kProjectiveStep_s;
  return kShareOfGutStable * physics::stable_step_s(physics::GutSprings(gut, material));
}

std::unique_ptr<GutModel> make(const geometry::GutShape& gut, const scene::IntestineSpec& spec) {
  refuse_start_in_obstacles(gut, spec);
  const physics::GutMaterial material = material_of(spec.material);
  const physics::GutCollisionSettings collisions = collisions_of(spec);
  physics::GutStepSettings step;
  step.method = spec.method == "explicit" ? GutMethod::kExplicit : GutMethod::kProjective;
  step.step_s = step_of(gut, material, spec);
  step.gravity_m_s2 = spec.gravity_m_s2;
  physics::GutStepSettings felt = step;
  felt.method = GutMethod::kProjective;
  felt.step_s = std::max(step.step_s, kFeltStep_s);
  physics::GutStepSettings ahead = felt;
  ahead.step_s = std::max(step.step_s, kProjectiveStep_s);
  const auto system = [&](const physics::GutStepSettings& settings) {
    return std::make_unique<physics::GutSystem>(gut, material, collisions, settings);
  };
  return std::make_unique<GutModel>(GutPhysics{.system = system(step),
                                               .felt = system(felt),
                                               .ahead = ahead.step_s < felt.step_s ? system(ahead) : nullptr,
                                               .obstacles = obstacles_of(spec),
                                               .wall_m_n = 1 / spec.wall_stiffness_n_m});
}

}  // namespace

std::unique_ptr<OrganModel> make_intestine(const node::OrganSource& source, const scene::OrganSpec& spec) {
  try {
    return make(*source.gut, *spec.intestine);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(spec.intestine->where + ": organ " + spec.name + ": " + error.what());
  }
}

}  // namespace omentum::deform
