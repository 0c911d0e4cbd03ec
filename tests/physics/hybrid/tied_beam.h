// A beam whose held half is precomputed and fine, and whose other half has masses and nodes of its own.
#pragma once

#include "physics/direct_solve.h"
#include "physics/dynamics/carried_mass.h"
#include "physics/dynamics/kept_factor.h"
#include "physics/hybrid/hybrid_step.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/support/meshes.h"
#include "tests/support/tensors.h"

namespace omentum::test {

inline constexpr double kTiedBorderX_m = 0.06, kTiedWidth_m = 0.03;

/// Two meshes in one, the fine one first; and the same two as one model of less freedom, u = T q: q are the
/// nodes that nothing leads, [3N] components with those of the others left out by T.
struct TiedBeam {
  geometry::TetraMesh mesh;
  physics::MaterialMap material{{5000, 0.4, 1050}, {}};
  std::vector<std::uint8_t> dynamic;
  physics::MeshSplit split;
  physics::Inertia inertia;
  physics::FixedComponents fixed;  // of the precomputed part
  geometry::Surface surface, boundary;
  physics::BorderTie tie;
  physics::SurfaceCompliance compliance{0, nullptr, nullptr, nullptr};
  Values weights;

  explicit TiedBeam(const geometry::Vec3& gravity = {0, 0, -9.81}, int across = 3) {
    add(make_box_mesh(2 * across, across, across, {kTiedBorderX_m, kTiedWidth_m, kTiedWidth_m}), 0, 0);
    add(make_box_mesh(4, 2, 2, {kTiedBorderX_m, kTiedWidth_m, kTiedWidth_m}), kTiedBorderX_m, 1);
    split = physics::split_mesh(mesh, dynamic);
    inertia.mass = physics::lumped_masses(mesh, material);
    for (const geometry::Vec3& p : mesh.positions) inertia.fixed.push_back(p.x() == 0 ? physics::kPinned : 0);
    fixed = physics::supports_of(split.precomputed, inertia.fixed);
    surface = geometry::extract_surface(split.precomputed.mesh, physics::pinned_nodes(fixed));
    boundary = geometry::extract_surface(split.dynamic.mesh, {});
    tie = physics::tie_border(split, surface, boundary, border_faces());
    compliance = tensors_of(physics::assemble_stiffness(split.precomputed.mesh, material), fixed, surface);
    for (const geometry::Vec3& f : physics::body_forces(mesh, material, gravity))
      weights.insert(weights.end(), f.begin(), f.end());
  }
  TiedBeam(const TiedBeam&) = delete;

  physics::HybridBody body(physics::DynamicLaw law = physics::DynamicLaw::kLinear) const {
    return {split, surface, compliance, material, fixed, inertia, weights, law, &tie};
  }
  std::size_t components() const { return 3 * mesh.positions.size(); }
  bool is_known(std::size_t n) const {
    if (split.dynamic.own_node[n].valid()) return true;
    const geometry::SurfaceId s = surface.of_node[split.precomputed.own_node[n]];
    return s.valid() && s < surface.mobile_count;
  }
  /// Of one part: both have nodes at some places of the border.
  geometry::NodeId nearest(const geometry::Vec3& place, bool of_dynamic) const {
    std::size_t best = mesh.positions.size();
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (split.dynamic.own_node[n].valid() != of_dynamic) continue;
      if (best == mesh.positions.size() ||
          (mesh.positions[n] - place).norm() < (mesh.positions[best] - place).norm())
        best = n;
    }
    return geometry::NodeId(best);
  }
  double difference(std::span<const double> found, std::span<const double> expected) const {
    double size = 0, off = 0;
    for (std::size_t c = 0; c < found.size(); ++c) {
      if (!is_known(c / 3)) continue;
      size = std::max(size, std::abs(expected[c]));
      off = std::max(off, std::abs(found[c] - expected[c]));
    }
    return off / size;
  }
  /// T, [3N x q].
  Eigen::MatrixXd freedom() const {
    std::vector<Eigen::Index> column(mesh.positions.size(), -1);
    Eigen::Index count = 0;
    for (std::size_t n = 0; n < column.size(); ++n)
      if (inertia.fixed[n] == 0 && !is_slave(n)) column[n] = std::exchange(count, count + 3);
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(components()), count);
    const auto lead = [&](std::size_t n, std::size_t by, double share) {
      for (Eigen::Index i = 0; i < 3; ++i) T(static_cast<Eigen::Index>(3 * n) + i, column[by] + i) += share;
    };
    for (std::size_t n = 0; n < column.size(); ++n)
      if (column[n] >= 0) lead(n, n, 1);
    for (std::size_t s = 0; s < tie.slaves.size(); ++s)
      for (std::size_t m = 0; m < tie.map.masters.size(); ++m)
        lead(slave(s), static_cast<std::size_t>(split.dynamic.node[tie.map.masters[m]]),
             tie.map.P(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(m)));
    return T;
  }

 private:
  void add(const geometry::TetraMesh& part, double x_m, std::uint8_t is_dynamic) {
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    for (const geometry::Vec3& p : part.positions) mesh.positions.emplace_back(p + geometry::Vec3(x_m, 0, 0));
    for (geometry::Tetrahedron t : part.tetrahedra) {
      for (geometry::NodeId& n : t) n = geometry::NodeId(static_cast<std::int32_t>(n) + first);
      mesh.tetrahedra.push_back(t);
      dynamic.push_back(is_dynamic);
    }
  }
  std::vector<geometry::TriangleId> border_faces() const {
    std::vector<geometry::TriangleId> faces;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
      if (std::ranges::all_of(surface.triangles[f], [&](geometry::SurfaceId s) {
            return split.precomputed.mesh.positions[surface.node[s]].x() > kTiedBorderX_m - 1e-12;
          }))
        faces.emplace_back(f);
    return faces;
  }
  std::size_t slave(std::size_t s) const {
    return static_cast<std::size_t>(split.precomputed.node[surface.node[tie.slaves[s]]]);
  }
  bool is_slave(std::size_t n) const {
    for (std::size_t s = 0; s < tie.slaves.size(); ++s)
      if (slave(s) == n) return true;
    return false;
  }
};

/// A step of backward Euler of a TiedBeam as one model, by dense matrices: nodes of the precomputed part have
/// no mass beside what leads its border.
class TiedReference {
 public:
  TiedReference(const TiedBeam& beam, double step_s)
      : beam_(beam),
        step_s_(step_s),
        T_(beam.freedom()),
        carried_(beam.split.dynamic.mesh, beam.material, own_mass()) {
    for (std::size_t t = 0; t < beam.mesh.tetrahedra.size(); ++t) left_.push_back(true);
    factorize();
  }

  void remove(std::span<const geometry::TetId> tetrahedra) {
    std::vector<geometry::TetId> own;
    for (const geometry::TetId t : tetrahedra) {
      left_[static_cast<std::size_t>(t)] = false;
      own.push_back(beam_.split.dynamic.own_tetrahedron[t]);
    }
    carried_.remove(own);
    factorize();
  }
  void step(physics::BodyState& state, std::span<const double> external) {
    const Eigen::Map<const Eigen::VectorXd> f(external.data(), T_.rows());
    Eigen::Map<Eigen::VectorXd> u(state.u.data(), T_.rows()), v(state.v.data(), T_.rows());
    const Eigen::VectorXd b = M_ * v + step_s_ * (f - K_ * u);
    v = T_ * A_.solve(T_.transpose() * b);
    u += step_s_ * v;
  }
  /// Where it rests.
  Values rest(std::span<const double> external) const {
    const Eigen::Map<const Eigen::VectorXd> f(external.data(), T_.rows());
    const Eigen::VectorXd u = T_ * (T_.transpose() * K_ * T_).llt().solve(T_.transpose() * f);
    return {u.begin(), u.end()};
  }
  /// By how much a step ends elsewhere for forces, [3N].
  Values yield_to(std::span<const double> forces) const {
    const Eigen::Map<const Eigen::VectorXd> f(forces.data(), T_.rows());
    const Eigen::VectorXd u = step_s_ * step_s_ * (T_ * A_.solve(T_.transpose() * f));
    return {u.begin(), u.end()};
  }

 private:
  // Of the dynamic part's nodes, what they carry for the border included.
  std::vector<double> own_mass() const {
    std::vector<double> mass;
    for (const geometry::NodeId n : beam_.split.dynamic.node) mass.push_back(beam_.inertia.mass[n]);
    for (std::size_t s = 0; s < beam_.tie.slaves.size(); ++s) {
      const geometry::NodeId slave = beam_.split.precomputed.node[beam_.surface.node[beam_.tie.slaves[s]]];
      for (std::size_t m = 0; m < beam_.tie.map.masters.size(); ++m)
        mass[static_cast<std::size_t>(beam_.tie.map.masters[m])] +=
            beam_.tie.map.P(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(m)) *
            beam_.inertia.mass[slave];
    }
    return mass;
  }
  void factorize() {
    geometry::TetraMesh left = beam_.mesh;
    left.tetrahedra.clear();
    for (std::size_t t = 0; t < left_.size(); ++t)
      if (left_[t]) left.tetrahedra.push_back(beam_.mesh.tetrahedra[t]);
    const physics::Stiffness K = physics::assemble_stiffness(left, beam_.material);
    K_ = Eigen::MatrixXd::Zero(T_.rows(), T_.rows());
    for (std::int32_t n = 0; n < K.node_count(); ++n)
      for (std::int32_t b = K.start[n]; b < K.start[n + 1]; ++b)
        K_.block<3, 3>(3 * n, 3 * static_cast<Eigen::Index>(K.neighbour[b])) += K.block[b];
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(T_.rows());
    for (std::size_t d = 0; d < carried_.kg().size(); ++d)
      mass.segment<3>(3 * static_cast<Eigen::Index>(beam_.split.dynamic.node[d]))
          .setConstant(carried_.kg()[d]);
    M_ = mass.asDiagonal();
    const physics::SystemWeights w = physics::weights_of(beam_.inertia, step_s_);
    const Eigen::MatrixXd A = w.mass * M_ + w.stiffness * K_;
    A_.compute(T_.transpose() * A * T_);
  }

  const TiedBeam& beam_;
  double step_s_;
  Eigen::MatrixXd T_, K_, M_;
  std::vector<bool> left_;  // [T]
  physics::CarriedMass carried_;
  Eigen::LLT<Eigen::MatrixXd> A_;
};

}  // namespace omentum::test
