// Organs for the haptic node's tests: small elastic bodies with real force tensors.
#pragma once

#include "haptic_node/haptic_step.h"
#include "physics/stiffness.h"
#include "tests/support/meshes.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::haptic_test {

using geometry::SurfaceId;
using geometry::TriangleId;
using geometry::Vec3;

/// Soft tissue, a little compressible.
inline constexpr physics::Material kTissue{10e3, 0.4, 1000};

/// A meshed organ with its tensors, and what a reference solution of it needs.
struct TestOrgan {
  geometry::TetraMesh mesh;
  physics::FixedComponents fixed;
  physics::Stiffness stiffness;
  geometry::Surface surface;
  std::vector<Vec3> rest;
  physics::SurfaceCompliance compliance;
};

/// `held(p)`: which nodes are pinned.
template <class Held>
TestOrgan make_organ(geometry::TetraMesh mesh, Held&& held) {
  TestOrgan organ{std::move(mesh), {}, {}, {}, {}, {0, nullptr, nullptr, nullptr}};
  for (const Vec3& p : organ.mesh.positions) organ.fixed.push_back(held(p) ? physics::kPinned : 0);
  organ.stiffness = physics::assemble_stiffness(organ.mesh, kTissue);
  organ.surface = geometry::extract_surface(organ.mesh, physics::pinned_nodes(organ.fixed));
  organ.rest = geometry::surface_positions(organ.mesh, organ.surface);
  organ.compliance = test::tensors_of(organ.stiffness, organ.fixed, organ.surface);
  return organ;
}

/// A block of 10 x 10 x 4 cm on a table, 1 cm elements. Its top is at z = 0.04.
inline const TestOrgan& block() {
  static const TestOrgan organ = make_organ(test::make_box_mesh(10, 10, 4, {0.1, 0.1, 0.04}),
                                            [](const Vec3& p) { return p.z() < 1e-9; });
  return organ;
}

/// A plate of 12 x 12 cm, 2 mm thick, held at its rim. Its top is at z = 0.002.
inline const TestOrgan& plate() {
  static const TestOrgan organ =
      make_organ(test::make_box_mesh(12, 12, 1, {0.12, 0.12, 0.002}), [](const Vec3& p) {
        return p.x() < 1e-9 || p.y() < 1e-9 || p.x() > 0.12 - 1e-9 || p.y() > 0.12 - 1e-9;
      });
  return organ;
}

/// A hemisphere of 4 mm radius, its pole at the tip: eight points.
inline haptic::ToolModel round_tool() {
  constexpr double kRadius = 0.004;
  haptic::ToolModel tool;
  tool.points.push_back(Vec3::Zero());
  for (int i = 0; i < 7; ++i) {
    const double polar = i < 3 ? 0.7 : 1.4, turn = i < 3 ? 2.094 * i : 1.571 * i;
    tool.points.emplace_back(kRadius * std::sin(polar) * std::cos(turn),
                             kRadius * std::sin(polar) * std::sin(turn), kRadius * (1 - std::cos(polar)));
  }
  return tool;
}

inline haptic::ToolModel needle() {
  haptic::ToolModel tool;
  tool.points.push_back(Vec3::Zero());
  return tool;
}

inline haptic::ElasticSurface elastic_surface(const TestOrgan& organ) {
  haptic::ElasticSurface surface{organ.surface, organ.rest, organ.compliance, {}};
  for (const geometry::NodeId n : organ.surface.node)
    surface.file_node.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[n]));
  return surface;
}

inline haptic::HapticModel make_model(const TestOrgan& organ, std::vector<haptic::ToolModel> tools,
                                      double friction = 0) {
  haptic::HapticModel model{{elastic_surface(organ)}, std::move(tools), friction};
  return model;
}

/// For one body more than the model's organs.
inline haptic::HapticModel with_spare_place(haptic::HapticModel model) {
  model.spare_places = 1;
  return model;
}

/// A step with its model, state and scratch, driven by tip positions (tools upright: shaft along +z).
class Bench {
 public:
  explicit Bench(haptic::HapticModel model)
      : model_(std::move(model)),
        state_(model_),
        work_(std::make_unique<haptic::HapticWorkspace>(model_)),
        inputs_(model_.tools.size()),
        outputs_(model_.tools.size()) {}

  /// Where tool `tool` is in the next tick.
  Bench& place(std::size_t tool, const Vec3& tip, double grip = 0) {
    inputs_[tool].engaged = true;
    inputs_[tool].frame.p_WT = tip;
    inputs_[tool].grip = grip;
    return *this;
  }
  haptic::ToolInput& input(std::size_t tool = 0) { return inputs_[tool]; }

  const haptic::StepResult& step() {
    result_ = haptic::haptic_step(model_, inputs_, state_, *work_, outputs_);
    return result_;
  }
  /// One tool's tip moves; the force on the hand.
  Vec3 step_to(const Vec3& tip, std::size_t tool = 0) {
    place(tool, tip).step();
    return outputs_[tool].force;
  }
  /// In a straight line, `ticks` steps.
  Vec3 move_to(const Vec3& tip, int ticks, std::size_t tool = 0) {
    const Vec3 from = inputs_[tool].frame.p_WT;
    Vec3 force = Vec3::Zero();
    for (int i = 1; i <= ticks; ++i) force = step_to(from + (tip - from) * i / ticks, tool);
    return force;
  }

  const haptic::HapticModel& model() const { return model_; }
  haptic::HapticState& state() { return state_; }
  haptic::HapticWorkspace& work() { return *work_; }
  /// Of the model's first organ.
  haptic::DeformedSurface& surface() {
    return static_cast<haptic::DeformedSurface&>(work_->bodies[haptic::BodyId(0)]);
  }
  const haptic::ToolOutput& output(std::size_t tool = 0) const { return outputs_[tool]; }
  const haptic::StepResult& result() const { return result_; }

 private:
  haptic::HapticModel model_;
  haptic::HapticState state_;
  std::unique_ptr<haptic::HapticWorkspace> work_;
  std::vector<haptic::ToolInput> inputs_;
  std::vector<haptic::ToolOutput> outputs_;
  haptic::StepResult result_;
};

}  // namespace omentum::haptic_test
