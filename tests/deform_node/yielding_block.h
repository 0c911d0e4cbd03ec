// A toy organ that changes by itself and can be felt: tissue that yields at once and creeps on.
#pragma once

#include "deform_node/served_organ.h"

#include "tests/support/organ_patch.h"

#include <algorithm>

namespace omentum::deform_test {

/// Of what its tensors say, it yields kAtOnce as soon as it is pressed, and comes to all of it by e-folds of
/// kCreep_s (a standard linear solid, which is passive). A hand is told the quick part alone. A stroke raises
/// its version and removes a tetrahedron of no importance.
class YieldingBlock final : public deform::OrganModel {
 public:
  static constexpr double kAtOnce = 0.4, kCreep_s = 0.05;
  static constexpr std::size_t kPatchNodes = 24;

  explicit YieldingBlock(const node::OrganSource& source)
      : organ_(source.organ),
        rest_(source.rest),
        creep_(rest_.size(), geometry::Vec3::Zero()),
        rate_(rest_.size(), geometry::Vec3::Zero()),
        removed_(organ_.mesh.tetrahedra.size() / 8 + 1, 0),
        values_(3 * rest_.size()) {}

  deform::ModelSizes sizes() const override {
    return {.values = values_.size(), .removed_bytes = removed_.size(), .local_nodes = kPatchNodes};
  }
  void step(const deform::TickLoads& loads, double dt_s) noexcept override {
    loads_.clear();
    for (const deform::ToolLoad& load : loads.presses) {
      for (std::size_t i = 0; i < load.nodes.size(); ++i)
        loads_.push_back({load.tool, organ_.surface.of_node[load.nodes[i]], load.forces[i]});
    }
    strokes_.insert(strokes_.end(), loads.cuts.begin(), loads.cuts.end());
    for (const deform::CutStroke& stroke : loads.cuts) {
      if (stroke.from != stroke.to) remove_next();
    }
    for (std::int32_t n = 0; n < organ_.surface.mobile_count; ++n) {
      const geometry::Vec3 before = creep_[n], all = displacement(geometry::SurfaceId(n));
      creep_[n] += (1 - std::exp(-dt_s / kCreep_s)) * ((1 - kAtOnce) * all - creep_[n]);
      rate_[n] = (creep_[n] - before) / dt_s;
      const geometry::Vec3 u = creep_[n] + kAtOnce * all;
      for (int c = 0; c < 3; ++c) values_[3 * static_cast<std::size_t>(n) + c] = static_cast<float>(u[c]);
    }
    ++status_.steps;
  }
  void reset() noexcept override {
    std::ranges::fill(creep_, geometry::Vec3::Zero());
    std::ranges::fill(rate_, geometry::Vec3::Zero());
    std::ranges::fill(values_, 0.0f);
    std::ranges::fill(removed_, 0);
    loads_.clear();
    if (std::exchange(status_.removed_tetrahedra, 0) > 0) ++version_;
  }
  deform::OrganView view() const noexcept override {
    return {.kind = deform::StateKind::kSurface,
            .topology_version = version_,
            .values = values_,
            .removed_bits = removed_};
  }
  deform::ModelStatus status() const noexcept override { return status_; }

  bool local_model(const deform::PatchPlace& place, deform::LocalPatch& patch) const noexcept override {
    const auto around = test::nearest_patch(organ_.surface, rest_, place.centre, kPatchNodes);
    patch.topology_version = version_;
    patch.node_count = around.nodes.size();
    patch.triangle_count = around.triangles.size();
    std::ranges::copy(around.triangles, patch.triangles.begin());
    std::size_t at = 0;
    for (std::size_t i = 0; i < around.nodes.size(); ++i) {
      const geometry::SurfaceId n = around.nodes[i];
      patch.nodes[i] = static_cast<std::uint32_t>(organ_.mesh.file_node[organ_.surface.node[n]]);
      patch.positions[i] = rest_[n] + creep_[n] + kAtOnce * displacement(n);
      patch.velocities[i] = rate_[n];
      patch.forces[i] = force_of(place.tool, n);
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t j = 3 * i + row; j < 3 * around.nodes.size(); ++j)
          patch.compliance[at++] =
              static_cast<float>(kAtOnce * organ_.compliance->block(n, around.nodes[j / 3])(row, j % 3));
      }
    }
    return true;
  }

  const std::vector<deform::CutStroke>& strokes() const { return strokes_; }

 private:
  struct Load {
    std::uint32_t tool;
    geometry::SurfaceId node;
    geometry::Vec3 force;
  };

  geometry::Vec3 displacement(geometry::SurfaceId n) const {
    geometry::Vec3 u = geometry::Vec3::Zero();
    for (const Load& load : loads_) u += organ_.compliance->block(n, load.node) * load.force;
    return u;
  }
  geometry::Vec3 force_of(std::uint32_t tool, geometry::SurfaceId n) const {
    geometry::Vec3 force = geometry::Vec3::Zero();
    for (const Load& load : loads_) {
      if (load.tool == tool && load.node == n) force += load.force;
    }
    return force;
  }
  void remove_next() noexcept {
    const std::uint32_t t = status_.removed_tetrahedra++ % organ_.mesh.tetrahedra.size();
    removed_[t / 8] = static_cast<std::uint8_t>(removed_[t / 8] | 1u << t % 8);
    ++version_;
  }

  const organ::Organ& organ_;
  const std::vector<geometry::Vec3>& rest_;
  std::vector<geometry::Vec3> creep_, rate_;  // [S] m, m/s
  std::vector<std::uint8_t> removed_;
  std::vector<float> values_;
  std::vector<Load> loads_;
  std::vector<deform::CutStroke> strokes_;
  std::uint64_t version_ = 0;
  deform::ModelStatus status_;
};

inline std::unique_ptr<deform::OrganModel> make_yielding_block(const node::OrganSource& source,
                                                               const scene::OrganSpec&) {
  return std::make_unique<YieldingBlock>(source);
}
/// Under the name of what the scenes of tests choose.
inline constexpr deform::ModelEntry kYieldingBlock{"quasi-static", organ::Load::kWithTensors,
                                                   make_yielding_block};

}  // namespace omentum::deform_test
