#include "deform_node/quasi_static_model.h"

#include "deform_node/contact_book.h"
#include "deform_node/strain_gauges.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace omentum::deform {

namespace {

constexpr int kLanes = physics::SurfaceCompliance::kLanes;

/// [cluster][3][16] -> x y z per node, for the nodes that carry tensors.
void interleave(const std::vector<float>& tiled, std::int32_t mobile_count, std::vector<float>& xyz) {
  for (std::int32_t n = 0; n < mobile_count; ++n) {
    const float* lane = tiled.data() + static_cast<std::size_t>(n / kLanes) * 3 * kLanes + n % kLanes;
    for (int i = 0; i < 3; ++i) xyz[3 * static_cast<std::size_t>(n) + i] = lane[i * kLanes];
  }
}

}  // namespace

QuasiStaticModel::QuasiStaticModel(const physics::SurfaceCompliance& compliance,
                                   const geometry::Surface& surface, const std::vector<Vec3>& rest,
                                   geometry::SphereCover cover)
    : compliance_(compliance),
      surface_(surface),
      rest_(rest),
      tiled_(static_cast<std::size_t>(compliance.cluster_count()) * 3 * kLanes),
      displacements_(3 * surface.node.size()),
      cover_(std::move(cover)) {
  for (const geometry::CoverSphere& sphere : cover_.spheres)
    spheres_.push_back({.centre = sphere.centre,
                        .radius_m = sphere.radius_m,
                        .mass_kg = std::numeric_limits<double>::infinity()});
  nodes_.reserve(kMaxLoadedNodes);
  forces_.reserve(kMaxLoadedNodes);
}

void QuasiStaticModel::step(const TickLoads& loads, double dt_s) noexcept {
  dt_s_ = dt_s;
  nodes_.clear();
  forces_.clear();
  for (const ToolLoad& load : loads.presses) {
    for (const NodeId node : load.nodes) nodes_.push_back(surface_.of_node[node]);
    forces_.insert(forces_.end(), load.forces.begin(), load.forces.end());
  }
  physics::superpose_surface(compliance_, nodes_, forces_, tiled_);
  interleave(tiled_, compliance_.mobile_count(), displacements_);
  ++steps_;
}

void QuasiStaticModel::reset() noexcept {
  std::fill(displacements_.begin(), displacements_.end(), 0.0F);
  dt_s_ = 0;
  shown_at_ = steps_ - 1;
}

Vec3 QuasiStaticModel::displacement_above(const geometry::CoverSphere& sphere) const noexcept {
  Vec3 u = Vec3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const SurfaceId s = surface_.triangles[sphere.below][static_cast<std::size_t>(i)];
    u += sphere.place[i] * Eigen::Map<const Eigen::Vector3f>(displacements_.data() + 3 * s).cast<double>();
  }
  return u;
}

std::span<const CollisionSphere> QuasiStaticModel::collidable() const noexcept {
  if (shown_at_ == steps_) return spheres_;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Vec3 centre = cover_.spheres[i].centre + displacement_above(cover_.spheres[i]);
    spheres_[i].velocity = dt_s_ > 0 ? Vec3((centre - spheres_[i].centre) / dt_s_) : Vec3::Zero();
    spheres_[i].centre = centre;
  }
  shown_at_ = steps_;
  return spheres_;
}

// What happens inside is in no tensor: those that are kept are of the surface.
std::unique_ptr<StrainGauge> QuasiStaticModel::strain_gauge() const {
  return std::make_unique<MembraneGauge>(surface_, rest_);
}

}  // namespace omentum::deform
