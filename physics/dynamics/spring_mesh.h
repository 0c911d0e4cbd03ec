// The springs of a mesh: what surgery simulators used before the continuum, for comparison.
#pragma once

#include "physics/dynamics/force_law.h"
#include "physics/dynamics/law_kernels.h"
#include "physics/dynamics/spring_fit.h"
#include "physics/material_map.h"

#include <vector>

namespace omentum::physics {

/// A spring along every edge (Cotin 1998, eq. 7): the second end is pulled by -k (|d| - l) d / |d|, E = sum
/// of k (|d| - l)^2 / 2. An edge's k is the sum of what each tetrahedron around it that is left gives to it
/// (spring_fit.h). No force under a rigid motion; but none under a reflection either, and an element that was
/// turned inside out stays so. Springs are damped as every law is: by the integrator (body_state.h). One
/// thread.
class SpringMesh final : public ForceLaw {
 public:
  /// `unit`: what computes.
  SpringMesh(const geometry::TetraMesh& mesh, const MaterialMap& material,
             SpringFit fit = SpringFit::kLeastSquares,
             const kernels::LawKernels& unit = *kernels::law_kernels()[0]);

  void forces(std::span<const double> u, std::span<double> f) noexcept override;
  double energy(std::span<const double> u) const noexcept override;
  void remove(geometry::TetId t) noexcept override;
  void add(geometry::TetId t) noexcept override;

  std::int32_t edge_count() const { return static_cast<std::int32_t>(start_.size()) - 1; }

 private:
  struct Share {
    std::int32_t tetrahedron;
    double stiffness;  // N/m
  };

  void sum_shares(std::int32_t edge) noexcept;
  void set_left(geometry::TetId t, bool left) noexcept;

  const kernels::LawKernels* kernels_;
  std::vector<kernels::SpringPack> packs_;
  std::vector<std::array<std::int32_t, 6>> edges_of_;  // [T]
  std::vector<std::int32_t> start_;                    // [edges+1] into `shares_`
  std::vector<Share> shares_;                          // of each edge, by tetrahedron
  std::vector<std::uint8_t> left_;                     // [T] 1: there, 0: removed
  mutable std::vector<kernels::PaddedNode> u_;         // [N], scratch of one call
  std::vector<kernels::PaddedNode> f_;                 // [N], likewise
};

}  // namespace omentum::physics
