// A beam that is held at one end, as an organ with masses.
#pragma once

#include "deform_node/dynamic_model.h"

#include "geometry/surface.h"
#include "tests/deform_node/rates.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace omentum::deform {

inline constexpr double kLength_m = 0.12, kThick_m = 0.04;
inline constexpr physics::Material kTissue{.young_pa = 20000, .poisson = 0.4, .density_kg_m3 = 1000};

/// A beam that is held at x = 0, and its model.
class DynamicModelTest : public testing::Test {
 protected:
  DynamicModelTest() {
    for (const Vec3& x : mesh_.positions) {
      fixed_.push_back(x.x() < 1e-9 ? physics::kPinned : 0);
      pinned_.push_back(fixed_.back() != 0);
    }
    surface_ = geometry::extract_surface(mesh_, pinned_);
  }

  DynamicParts parts(double step_s = 0.005) {
    const SteppedBody body{mesh_,
                           material_,
                           {.mass = physics::lumped_masses(mesh_, material_),
                            .fixed = fixed_,
                            .mass_damping_per_s = 5,
                            .stiffness_damping_s = 0.01}};
    return {.body = body,
            .uncut_surface = surface_.node,
            .stepper = make_implicit_stepper(body, step_s),
            .tears = std::vector<physics::TearLimits>(mesh_.tetrahedra.size()),
            .cut_delay_s = 0,
            .cut_rate_per_s = 1e6};
  }
  NodeId nearest(const Vec3& x) const {
    const auto less = [&](const Vec3& a, const Vec3& b) { return (a - x).norm() < (b - x).norm(); };
    const auto found = std::min_element(mesh_.positions.begin(), mesh_.positions.end(), less);
    return NodeId(static_cast<std::size_t>(found - mesh_.positions.begin()));
  }
  static void pass(DynamicModel& model, double seconds, const TickLoads& loads = {}) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) model.step(loads, kTick_s);
  }
  /// Right through the beam at `x`.
  static CutStroke stroke_at(double x) {
    return {.tool = 0,
            .cut = 1,
            .from = {Vec3(x, -1, -1), Vec3(x, -1, 1)},
            .to = {Vec3(x, 1, -1), Vec3(x, 1, 1)}};
  }
  Vec3 shown(const DynamicModel& model, NodeId n) const {
    return Eigen::Map<const Eigen::Vector3f>(model.view().values.data() + 3 * surface_.of_node[n])
        .cast<double>();
  }
  static int count_bits(std::span<const std::uint8_t> bits) {
    return std::accumulate(bits.begin(), bits.end(), 0,
                           [](int sum, std::uint8_t b) { return sum + std::popcount(b); });
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(6, 2, 2, Vec3(kLength_m, kThick_m, kThick_m));
  physics::MaterialMap material_{kTissue};
  physics::FixedComponents fixed_;
  std::vector<bool> pinned_;
  geometry::Surface surface_;
};

}  // namespace omentum::deform
