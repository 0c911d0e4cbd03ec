// An intestine as deform_node moves it, and a hand that knows it by its local models alone.
#pragma once

#include "deform_node/gut_model.h"
#include "geometry/gut_anatomy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace omentum::deform {

inline constexpr double kGutTick_s = 0.01;

inline const geometry::GutShape& small_gut() {
  static const geometry::GutShape shape = [] {
    geometry::GutAnatomy anatomy;
    anatomy.length_m = 1.6;
    anatomy.legs = 3;
    anatomy.columns = 40;
    return geometry::make_gut(anatomy);
  }();
  return shape;
}

struct GutStageOptions {
  double step_s = kGutTick_s;
  physics::GutMethod method = physics::GutMethod::kProjective;
  Vec3 gravity_m_s2 = Vec3::Zero();
  std::vector<physics::GutObstacle> obstacles{};
};

inline GutModel gut_model(const GutStageOptions& options = {}) {
  physics::GutStepSettings step;
  step.method = options.method;
  step.step_s = options.step_s;
  step.gravity_m_s2 = options.gravity_m_s2;
  physics::GutStepSettings felt = step;
  felt.method = physics::GutMethod::kProjective;
  felt.step_s = std::max(step.step_s, kGutTick_s);
  physics::GutStepSettings ahead = felt;
  ahead.step_s = std::max(step.step_s, kGutTick_s / 4);
  const auto make = [](const physics::GutStepSettings& settings) {
    return std::make_unique<physics::GutSystem>(small_gut(), physics::GutMaterial(),
                                                physics::GutCollisionSettings(), settings);
  };
  return GutModel({.system = make(step),
                   .felt = make(felt),
                   .ahead = ahead.step_s < felt.step_s ? make(ahead) : nullptr,
                   .obstacles = options.obstacles});
}

inline std::vector<Vec3> skin_places(const GutModel& model) {
  const geometry::GutSkin skin(small_gut());
  std::vector<Vec3> x, places(skin.node_count());
  const auto values = model.view().values;
  for (std::size_t i = 0; i < values.size(); i += 3) x.emplace_back(values[i], values[i + 1], values[i + 2]);
  skin.place(x, places);
  return places;
}

/// The node of the skin that lies highest at the start.
inline NodeId highest_node() {
  const geometry::GutSkin skin(small_gut());
  std::vector<Vec3> places(skin.node_count());
  skin.place(small_gut().positions, places);
  const auto top = std::ranges::max_element(places, {}, [](const Vec3& p) { return p.z(); });
  return NodeId(static_cast<std::size_t>(top - places.begin()));
}

/// Holds one node of the skin: answers at its own rate what the newest patch says, which yields alike in all
/// directions.
class HoldingHand {
 public:
  HoldingHand(NodeId node, const Vec3& begin) : node_(node), begin_(begin), place_(begin) {}

  void learn(const GutModel& model) {
    LocalPatch patch(GutModel::kPatchNodes);
    if (!model.local_model({0, place_, 0.015}, patch)) return;
    for (std::size_t i = 0; i < patch.node_count; ++i) {
      if (patch.nodes[i] != static_cast<std::uint32_t>(std::int32_t{node_})) continue;
      const std::size_t r = 3 * i, rows = 3 * patch.node_count;
      known_ = Known{patch.positions[i], patch.velocities[i], patch.forces[i],
                     patch.compliance[r * rows - r * (r - 1) / 2]};
      age_s_ = 0;
    }
  }
  /// The force on the tissue with the hand so far from where the node was at the start.
  Vec3 hold(const Vec3& way, double dt_s) {
    place_ = begin_ + way;
    if (!known_) return Vec3::Zero();
    force_ = known_->force + (place_ - known_->place - age_s_ * known_->speed) / known_->compliance;
    age_s_ += dt_s;
    return force_;
  }
  ToolLoad load() {
    way_ = place_ - begin_;
    return {.tool = 0, .nodes = {&node_, 1}, .displacements = {&way_, 1}, .forces = {&force_, 1}};
  }

 private:
  struct Known {
    Vec3 place, speed, force;
    double compliance;
  };
  NodeId node_;
  Vec3 begin_, place_;
  double age_s_ = 0;
  std::optional<Known> known_;
  Vec3 force_ = Vec3::Zero(), way_ = Vec3::Zero();
};

}  // namespace omentum::deform
