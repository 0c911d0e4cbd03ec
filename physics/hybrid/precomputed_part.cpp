#include "physics/hybrid/precomputed_part.h"

#include "physics/hybrid/condensed_stiffness.h"

namespace omentum::physics {

namespace {

constexpr std::int32_t kLanes = SurfaceCompliance::kLanes;

Eigen::MatrixXd stiffness_of(const SurfaceCompliance& compliance, std::span<const SurfaceId> connection) {
  const ComplianceTiles<const float> tiles{compliance.mobile_count(), compliance.tile(SurfaceId(0), 0)};
  return condensed_stiffness(compliance_among(tiles, connection));
}

std::span<double> components(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

Eigen::Index row(std::size_t node) {
  return static_cast<Eigen::Index>(3 * node);
}

}  // namespace

PrecomputedPart::PrecomputedPart(const SurfaceCompliance& compliance, std::vector<SurfaceId> connection,
                                 std::vector<Vec3> sag)
    : compliance_(compliance),
      connection_(std::move(connection)),
      sag_(std::move(sag)),
      stiffness_(stiffness_of(compliance, connection_)),
      hold_(stiffness_),
      sag_force_(Eigen::VectorXd::Zero(stiffness_.rows())),
      lifted_(stiffness_.rows()),
      reaction_(stiffness_.rows()),
      tiled_(static_cast<std::size_t>(3 * kLanes * compliance.cluster_count())) {
  const auto most = static_cast<std::size_t>(compliance.mobile_count()) + connection_.size();
  pushed_.reserve(most);
  pushes_.reserve(most);
  if (sag_.empty()) return;
  for (std::size_t k = 0; k < connection_.size(); ++k)
    lifted_.segment<3>(row(k)) = sag_[static_cast<std::size_t>(connection_[k])];
  sag_force_ = stiffness_ * lifted_;
}

void PrecomputedPart::condense(const Loads& loads, Sag sag, std::span<double> f_c) noexcept {
  Eigen::Map<Eigen::VectorXd> force(f_c.data(), stiffness_.rows());
  force.setZero();
  if (sags(sag)) force = sag_force_;
  if (loads.nodes.empty()) return;
  for (std::size_t k = 0; k < connection_.size(); ++k) {
    Vec3 u = Vec3::Zero();
    for (std::size_t q = 0; q < loads.nodes.size(); ++q)
      u += compliance_.block(connection_[k], loads.nodes[q]) * loads.forces[q];
    lifted_.segment<3>(row(k)) = u;
  }
  hold_.product(components(lifted_), components(reaction_));
  force += reaction_;
}

void PrecomputedPart::follow(std::span<const double> w_c, const Loads& loads, Sag sag,
                             std::span<const double> f_c, std::span<double> w) noexcept {
  hold_.product(w_c, components(reaction_));
  reaction_ -= Eigen::Map<const Eigen::VectorXd>(f_c.data(), stiffness_.rows());
  pushed_.assign(loads.nodes.begin(), loads.nodes.end());
  pushes_.assign(loads.forces.begin(), loads.forces.end());
  for (std::size_t k = 0; k < connection_.size(); ++k) {
    pushed_.push_back(connection_[k]);
    pushes_.emplace_back(reaction_.segment<3>(row(k)));
  }
  superpose_surface(compliance_, pushed_, pushes_, tiled_);
  for (std::int32_t n = 0; n < mobile_count(); ++n) {
    const float* lane = tiled_.data() + static_cast<std::ptrdiff_t>(3 * kLanes * (n / kLanes)) + n % kLanes;
    for (int i = 0; i < 3; ++i)
      w[static_cast<std::size_t>(3 * n + i)] =
          static_cast<double>(lane[i * kLanes]) + (sags(sag) ? sag_[static_cast<std::size_t>(n)][i] : 0.0);
  }
}

void PrecomputedPart::passed_on(std::span<const SurfaceId> nodes, Eigen::Ref<Eigen::MatrixXd> B) noexcept {
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < connection_.size(); ++k)
        lifted_.segment<3>(row(k)) = compliance_.block(connection_[k], nodes[p]).col(axis);
      hold_.product(components(lifted_), {B.col(row(p) + axis).data(), hold_.size()});
    }
  }
}

void PrecomputedPart::yield_held(std::span<const SurfaceId> nodes, const Eigen::Ref<const Eigen::MatrixXd>& B,
                                 Eigen::Ref<Eigen::MatrixXd> yield) noexcept {
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    for (std::size_t q = 0; q <= p; ++q) {
      Eigen::Matrix3d C = compliance_.block(nodes[p], nodes[q]);
      for (std::size_t k = 0; k < connection_.size(); ++k)
        C -= compliance_.block(nodes[p], connection_[k]) * B.block<3, 3>(row(k), row(q));
      yield.block<3, 3>(row(p), row(q)) = C;
      yield.block<3, 3>(row(q), row(p)) = C.transpose();
    }
  }
}

}  // namespace omentum::physics
