// Tissue that tears where it is deformed too much (Cotin 1998, section 5.5).
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/element_strain.h"
#include "physics/material_map.h"

#include <limits>
#include <span>
#include <vector>

namespace omentum::physics {

/// Where a material tears; infinite: never for this reason. The first three are the paper's criteria, of the
/// shape alone; the last one is of the material.
struct TearLimits {
  double volume_change = kNever;    // |V / V_0 - 1|
  double mean_elongation = kNever;  // mean of l / l_0 - 1 over the six edges
  double edge_elongation = kNever;  // the largest l / l_0 - 1 of the six
  double stress_pa = kNever;        // largest principal stress, tension alone

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  bool ever() const;
};

/// How deformed a tetrahedron is, in the terms of TearLimits. None of it changes with a rigid motion: the
/// stress is S = lambda tr(E) I + 2 mu E with E = (F^T F - I) / 2, which is the linear model's where
/// displacements are small.
struct TetStrain {
  double volume_change, mean_elongation, edge_elongation, stress_pa;
};

/// Which tetrahedra tear next. A crack runs, a cloud does not vanish: each check lets go of the most loaded
/// ones only, a bounded number, and of none that shares a node with a more heavily loaded one of the same
/// check, since that one's end may be its relief. No allocation after construction; one thread at a time.
class Tearing {
 public:
  /// `mesh` must outlive this. `limits`: [T].
  Tearing(const geometry::TetraMesh& mesh, const MaterialMap& material, std::span<const TearLimits> limits);

  /// `displacements`: [3N], from rest, m; bit t % 8 of byte t / 8 of `removed`: tetrahedron t is gone (empty:
  /// none is). At most `most`, most loaded first; valid until the next call.
  std::span<const geometry::TetId> check(std::span<const double> displacements,
                                         std::span<const std::uint8_t> removed, std::size_t most) noexcept;

  TetStrain strain(geometry::TetId t, std::span<const double> displacements) const noexcept;

 private:
  struct Rest {
    std::array<double, 6> length_m;  // of the edges
    double lambda_pa, mu_pa;
    TearLimits limits;
  };
  struct Loaded {
    double load;  // the largest quotient of deformation and limit: above 1 it tears
    geometry::TetId t;
  };

  struct Deformed;

  Deformed deform(geometry::TetId t, std::span<const double> displacements) const noexcept;
  double load(geometry::TetId t, std::span<const double> displacements) const noexcept;
  bool meets_chosen(geometry::TetId t) const noexcept;
  void choose(geometry::TetId t) noexcept;

  const geometry::TetraMesh& mesh_;
  DeformationGradients gradients_;
  std::vector<Rest> rest_;               // [T]
  std::vector<Loaded> loaded_;           // workspace, [T]
  std::vector<std::uint8_t> is_shared_;  // [N]: a node of what this check chose
  std::vector<geometry::TetId> chosen_;
};

}  // namespace omentum::physics
