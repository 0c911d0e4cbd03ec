// A toy organ for deform_node's seams: one mass on a spring, which has of everything a little.
#pragma once

#include "deform_node/served_organ.h"

#include <algorithm>
#include <utility>

namespace omentum::deform_test {

using deform::CollisionSphere;
using deform::CutStroke;
using deform::LocalPatch;
using deform::OrganContact;
using deform::OrganView;
using deform::PatchPlace;
using geometry::Vec3;

/// m a = f - d v - k x about a place of rest, by symplectic Euler. Each stroke takes away the next of its
/// tetrahedra.
class HangingMass final : public deform::OrganModel {
 public:
  static constexpr double kMass_kg = 0.1, kSpring_n_m = 100, kDamping_n_s_m = 2, kRadius_m = 0.01;
  static constexpr std::size_t kTetrahedra = 20, kBytes = 3;

  explicit HangingMass(const Vec3& rest = Vec3::Zero()) : rest_(rest) { show(); }

  deform::ModelSizes sizes() const override {
    return {.values = 3, .removed_bytes = kBytes, .local_nodes = 1, .spheres = 1};
  }
  void step(const deform::TickLoads& loads, double dt_s) noexcept override {
    Vec3 force = -kDamping_n_s_m * velocity_ - kSpring_n_m * (position() - rest_);
    for (const deform::ToolLoad& load : loads.presses)
      for (const Vec3& on_node : load.forces) force += on_node;
    velocity_ += dt_s / kMass_kg * force;
    offset_ += dt_s * velocity_;
    for (std::size_t i = 0; i < loads.cuts.size(); ++i) remove_next();
    ++status_.steps;
    status_.diverged = !(offset_.norm() < 1);
    status_.fault = offset_.norm() > 0.1 ? "stretched far" : "";
    show();
  }
  void reset() noexcept override {
    offset_ = velocity_ = Vec3::Zero();
    status_.diverged = false;
    status_.fault = {};
    if (std::exchange(status_.removed_tetrahedra, 0) > 0) ++version_;
    removed_.fill(0);
    show();
  }
  OrganView view() const noexcept override {
    return {.kind = deform::StateKind::kTube,
            .topology_version = version_,
            .values = values_,
            .removed_bits = removed_};
  }
  deform::ModelStatus status() const noexcept override { return status_; }
  bool local_model(const PatchPlace& place, LocalPatch& patch) const noexcept override {
    if ((place.centre - position()).norm() > place.radius_m) return false;
    patch.topology_version = version_;
    patch.node_count = 1;
    patch.nodes[0] = 0;
    patch.positions[0] = position();
    patch.velocities[0] = velocity_;
    const float c = 1 / kSpring_n_m;
    const std::array<float, 6> upper{c, 0, 0, c, 0, c};
    std::copy(upper.begin(), upper.end(), patch.compliance.begin());
    return true;
  }
  std::span<const CollisionSphere> collidable() const noexcept override { return {&sphere_, 1}; }
  void respond(std::span<const OrganContact> contacts) noexcept override {
    for (const OrganContact& met : contacts) velocity_ += answer(met, sphere_.velocity);
    show();
  }

  Vec3 position() const { return rest_ + offset_; }
  const Vec3& velocity() const { return velocity_; }
  void push(const Vec3& velocity) {
    velocity_ = velocity;
    show();
  }

 private:
  void remove_next() noexcept {
    if (status_.removed_tetrahedra == kTetrahedra) return;
    const std::uint32_t t = status_.removed_tetrahedra++;
    removed_[t / 8] = static_cast<std::uint8_t>(removed_[t / 8] | 1u << t % 8);
    ++version_;
  }
  void show() noexcept {
    const Vec3 p = position();
    for (int c = 0; c < 3; ++c) values_[static_cast<std::size_t>(c)] = static_cast<float>(p[c]);
    sphere_ = {p, velocity_, kRadius_m, kMass_kg};
  }

  Vec3 rest_, offset_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  std::uint64_t version_ = 0;
  std::array<std::uint8_t, kBytes> removed_{};
  std::array<float, 3> values_{};
  CollisionSphere sphere_;
  deform::ModelStatus status_;
};

/// The toy under a name of its own, beside what deform_node makes.
inline std::unique_ptr<deform::OrganModel> make_hanging_mass(const node::OrganSource& source,
                                                             const scene::OrganSpec&) {
  return std::make_unique<HangingMass>(source.rest.front());
}
inline constexpr deform::ModelEntry kHangingMass{"hanging mass", organ::Load::kMeshOnly, make_hanging_mass};

/// An organ of which there is no file: one surface node, where the mass rests.
inline deform::ServedOrgan hanging_organ(const std::string& name, const Vec3& rest = Vec3::Zero()) {
  auto source = std::make_unique<node::OrganSource>();
  source->organ.name = source->organ.hash = name;
  source->organ.mesh.tetrahedra.resize(HangingMass::kTetrahedra);
  source->rest = {rest};
  return {std::move(source), std::make_unique<HangingMass>(rest)};
}

}  // namespace omentum::deform_test
