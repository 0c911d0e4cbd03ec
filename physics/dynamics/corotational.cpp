#include "physics/dynamics/corotational.h"

#include "physics/element_tensors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace omentum::physics {

namespace kernels {

// Horn 1987: the unit quaternion that maximizes tr(R^T F) is an eigenvector of this matrix's largest
// eigenvalue; of several, any.
void nearest_rotation(const double* F, double* R) noexcept {
  const auto f = [&](int a, int b) { return F[3 * a + b]; };
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(R);
  rotation.setIdentity();
  // the eigenvalues of what diverged would be looked for a thousand times as long, in vain
  if (!Eigen::Map<const Eigen::Matrix3d>(F).allFinite()) return;
  Eigen::Matrix4d N;
  N.row(0) << f(0, 0) + f(1, 1) + f(2, 2), f(2, 1) - f(1, 2), f(0, 2) - f(2, 0), f(1, 0) - f(0, 1);
  N.row(1) << N(0, 1), f(0, 0) - f(1, 1) - f(2, 2), f(0, 1) + f(1, 0), f(0, 2) + f(2, 0);
  N.row(2) << N(0, 2), N(1, 2), f(1, 1) - f(0, 0) - f(2, 2), f(1, 2) + f(2, 1);
  N.row(3) << N(0, 3), N(1, 3), N(2, 3), f(2, 2) - f(0, 0) - f(1, 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(N);
  const Eigen::Vector4d q = eigen.eigenvectors().col(3);
  rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

}  // namespace kernels

namespace {

using kernels::kTetLanes;
using kernels::TetPack;

TetPack& pack_of(std::vector<TetPack>& packs, std::size_t t) {
  return packs[t / kTetLanes];
}

int lane_of(std::size_t t) {
  return static_cast<int>(t % kTetLanes);
}

void place(TetPack& pack, int lane, const geometry::Tetrahedron& nodes, const Corners& corners,
           double volume) {
  const std::array<Vec3, 4> M = area_normals(corners);
  for (int c = 0; c < 4; ++c) pack.node[c][lane] = nodes[c];
  for (int c = 0; c < 3; ++c) {
    for (int axis = 0; axis < 3; ++axis) pack.gradient[c][axis][lane] = -M[c + 1][axis] / (6 * volume);
  }
}

}  // namespace

Corotational::Corotational(const geometry::TetraMesh& mesh, const MaterialMap& material,
                           const kernels::LawKernels& unit)
    : kernels_(&unit),
      packs_((mesh.tetrahedra.size() + kTetLanes - 1) / kTetLanes),
      tangents_(packs_.size()),
      in_(mesh.positions.size()),
      out_(mesh.positions.size()) {
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const Corners corners = corners_of(mesh, id);
    const double volume = geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]);
    const Material& tissue = material.of(mesh, id);
    place(pack_of(packs_, t), lane_of(t), mesh.tetrahedra[t], corners, volume);
    two_mu_volume_.push_back(2 * tissue.mu() * volume);
    lambda_volume_.push_back(tissue.lambda() * volume);
    add(id);
  }
}

void Corotational::forces(std::span<const double> u, std::span<double> f) noexcept {
  kernels::pad(u.data(), in_.size(), in_.data());
  std::ranges::fill(out_, kernels::PaddedNode{});
  kernels_->add_corotational_forces(packs_.data(), pack_count(), in_.data(), out_.data());
  kernels::unpad(out_.data(), out_.size(), f.data());
}

double Corotational::energy(std::span<const double> u) const noexcept {
  kernels::pad(u.data(), in_.size(), in_.data());
  return kernels_->corotational_energy(packs_.data(), pack_count(), in_.data());
}

void Corotational::remove(geometry::TetId t) noexcept {
  TetPack& pack = pack_of(packs_, static_cast<std::size_t>(t));
  const int lane = lane_of(static_cast<std::size_t>(t));
  pack.two_mu_volume[lane] = pack.lambda_volume[lane] = 0;
  --pack.stiff_count;
}

void Corotational::add(geometry::TetId t) noexcept {
  TetPack& pack = pack_of(packs_, static_cast<std::size_t>(t));
  const int lane = lane_of(static_cast<std::size_t>(t));
  pack.two_mu_volume[lane] = two_mu_volume_[t];
  pack.lambda_volume[lane] = lambda_volume_[t];
  ++pack.stiff_count;
}

void Corotational::linearize(std::span<const double> u, Tangent tangent) noexcept {
  kernels::pad(u.data(), in_.size(), in_.data());
  kernels_->linearize_corotational(packs_.data(), pack_count(), in_.data(), tangent == Tangent::kExact,
                                   tangents_.data());
}

void Corotational::product(std::span<const double> v, std::span<double> f) const noexcept {
  kernels::pad(v.data(), in_.size(), in_.data());
  std::ranges::fill(out_, kernels::PaddedNode{});
  kernels_->add_corotational_product(packs_.data(), tangents_.data(), pack_count(), in_.data(), out_.data());
  kernels::unpad(out_.data(), out_.size(), f.data());
}

Eigen::Matrix3d Corotational::rotation(geometry::TetId t) const noexcept {
  const kernels::TetTangent& tangent = tangents_[static_cast<std::size_t>(t / kTetLanes)];
  Eigen::Matrix3d R;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) R(a, b) = tangent.rotation[a][b][t % kTetLanes];
  }
  return R;
}

}  // namespace omentum::physics
