#include "physics/nodal_stress.h"

#include "geometry/tetra_bits.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;
using geometry::TetId;

NodalStress::NodalStress(const geometry::TetraMesh& mesh, const MaterialMap& material, StressLaw law)
    : mesh_(mesh), gradients_(mesh), law_(law), sums_(mesh.positions.size()) {
  stiffness_.reserve(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const Material& tissue = material.of(mesh, TetId(t));
    stiffness_.push_back({tissue.lambda(), tissue.mu()});
  }
}

void NodalStress::measure(const BodyShape& shape, std::span<float> strain,
                          std::span<float> stress_pa) noexcept {
  const Sum nothing{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), 0, false};
  std::ranges::fill(sums_, nothing);
  for (const NodeId n : shape.nodes) sums_[n].is_asked = true;
  for (std::size_t i = 0; i < mesh_.tetrahedra.size(); ++i) {
    const TetId t(i);
    const auto is_asked = [&](NodeId n) { return sums_[n].is_asked; };
    if (!geometry::is_set(shape.removed, t) && std::ranges::any_of(mesh_.tetrahedra[t], is_asked))
      add(t, shape.u);
  }
  for (std::size_t s = 0; s < shape.nodes.size(); ++s) {
    const Sum& sum = sums_[shape.nodes[s]];
    const double share = sum.volume_m3 > 0 ? 1 / sum.volume_m3 : 0;
    strain[s] = static_cast<float>(share * largest_principal(sum.strain));
    if (knows_stress()) stress_pa[s] = static_cast<float>(share * largest_principal(sum.stress));
  }
}

void NodalStress::add(TetId t, std::span<const double> u) noexcept {
  const Eigen::Matrix3d F = gradients_.at(t, u);
  const double volume_m3 = gradients_.volume_m3(t);
  const Eigen::Matrix3d turned = turned_strain(F);
  const Stiffness& of_t = stiffness_[t];
  const Eigen::Matrix3d stress =
      hooke_stress(of_t.lambda_pa, of_t.mu_pa, law_ == StressLaw::kLinear ? linear_strain(F) : turned);
  for (const NodeId n : mesh_.tetrahedra[t]) {
    sums_[n].strain += volume_m3 * turned;
    sums_[n].stress += volume_m3 * stress;
    sums_[n].volume_m3 += volume_m3;
  }
}

}  // namespace omentum::physics
