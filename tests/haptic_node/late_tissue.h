// Tissue that moves by itself and is told of late, and a hand that presses or pulls it through the real step
// and safety.
#pragma once

#include "haptic_fixtures.h"
#include "haptic_node/force_safety.h"
#include "haptic_node/local_body.h"

#include <deque>
#include <functional>
#include <random>

namespace omentum::haptic_test {

/// A piece of the block's top, of which 40 % yields at once; the rest is a passive oscillator that goes after
/// its load, as creep (over-damped) or as a swing. It moves by the hand's places, as deform_node does
/// (physics/dynamics/imposed_press): the told forces are as strong as makes the told dent.
class LateTissue {
 public:
  static constexpr double kQuick = 0.4, kStep_s = 0.02;

  LateTissue(const Vec3& centre, double radius_m, double swing_hz, double damping)
      : swing_(2 * M_PI * swing_hz), damping_(damping) {
    take(centre, radius_m);
    const auto size = static_cast<Eigen::Index>(3 * patch_.nodes.size());
    own_ = rate_ = load_ = told_u_ = told_f_ = Eigen::VectorXd::Zero(size);
  }

  /// What the hand's contacts are; one that says nothing lets go.
  struct Told {
    Eigen::VectorXd u, f;
  };
  Told told_by(Bench& bench) const {
    const haptic::BodyId id(0);
    Told told{Eigen::VectorXd::Zero(own_.size()), Eigen::VectorXd::Zero(own_.size())};
    for (const haptic::NodeForce& entry : bench.state().forces()) {
      const auto n = 3 * static_cast<Eigen::Index>(entry.node);
      told.f.segment<3>(n) += entry.force;
      told.u.segment<3>(n) = haptic::contact_displacement(id, entry.node, bench.state(), bench.work().bodies);
    }
    return told;
  }
  void hear(Told told) {
    told_u_ = std::move(told.u);
    told_f_ = std::move(told.f);
  }

  /// One step of the organ, and what is told of it then.
  haptic::LocalPatch step() {
    const double yield_j = kQuick * told_f_.dot(compliance_ * told_f_);
    const double s = yield_j > 0 ? std::clamp(told_f_.dot(told_u_ - own_) / yield_j, 0.0, 2.0) : 0;
    load_ = s * told_f_;
    const Eigen::VectorXd goal = (1 - kQuick) * compliance_ * load_;
    constexpr int kParts = 20;
    for (int i = 0; i < kParts; ++i) {
      const double dt_s = kStep_s / kParts;
      rate_ = (rate_ + dt_s * swing_ * swing_ * (goal - own_)) / (1 + 2 * damping_ * swing_ * dt_s);
      own_ += dt_s * rate_;
    }
    const Eigen::VectorXd at = own_ + kQuick * compliance_ * load_;
    haptic::LocalPatch patch = patch_;
    for (std::size_t n = 0; n < patch.nodes.size(); ++n) {
      const auto i = 3 * static_cast<Eigen::Index>(n);
      patch.positions[n] = patch.at_rest[n] + at.segment<3>(i);
      patch.velocities[n] = rate_.segment<3>(i);
      patch.forces[n] = load_.segment<3>(i);
    }
    return patch;
  }

 private:
  void take(const Vec3& centre, double radius_m) {
    const TestOrgan& organ = block();
    std::vector<SurfaceId> nodes;
    std::vector<std::int32_t> place(organ.rest.size(), -1);
    for (const geometry::Triangle& t : organ.surface.triangles) {
      if (!std::ranges::all_of(t, [&](SurfaceId n) { return (organ.rest[n] - centre).norm() < radius_m; }))
        continue;
      for (const SurfaceId n : t) {
        if (place[n] >= 0) continue;
        place[n] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(n);
      }
      patch_.triangles.push_back({SurfaceId(place[t[0]]), SurfaceId(place[t[1]]), SurfaceId(place[t[2]])});
    }
    const auto size = static_cast<Eigen::Index>(3 * nodes.size());
    compliance_.resize(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index j = 0; j < size; ++j)
        compliance_(i, j) = organ.compliance.block(nodes[i / 3], nodes[j / 3])(i % 3, j % 3);
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index j = i; j < size; ++j)
        patch_.compliance.push_back(static_cast<float>(kQuick * compliance_(i, j)));
    }
    for (const SurfaceId n : nodes) {
      patch_.nodes.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[organ.surface.node[n]]));
      patch_.at_rest.push_back(organ.rest[n]);
    }
    patch_.positions = patch_.at_rest;
    patch_.velocities = patch_.forces = std::vector<Vec3>(nodes.size(), Vec3::Zero());
  }

  double swing_, damping_;
  haptic::LocalPatch patch_;
  Eigen::MatrixXd compliance_;         // [3n, 3n] of all that it yields, m/N
  Eigen::VectorXd own_, rate_, load_;  // [3n] of the slow part, m and m/s; N
  Eigen::VectorXd told_u_, told_f_;    // [3n] by the hand, m and N
};

}  // namespace omentum::haptic_test
