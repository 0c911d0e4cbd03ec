// The innermost loops of the co-rotational law and of the springs, for each vector unit. No library header
// with inline functions here: the loops' own files include it.
#pragma once

#include "physics/dynamics/padded_nodes.h"

#include <cstdint>

namespace omentum::physics::kernels {

inline constexpr int kTetLanes = 8;

/// Eight tetrahedra, a lane each. A lane without a tetrahedron, or whose tetrahedron is gone, is not stiff:
/// it takes no force, whatever its nodes do.
struct alignas(64) TetPack {
  double gradient[3][3][kTetLanes];  // [corner 1..3][axis] of its shape function, 1/m
  double two_mu_volume[kTetLanes];   // N m; 0: not stiff
  double lambda_volume[kTetLanes];   // N m
  std::int32_t node[4][kTetLanes];   // [corner]
  std::int32_t stiff_count;          // lanes that are stiff
};

/// What products with the stiffness need of eight tetrahedra.
struct alignas(64) TetTangent {
  double rotation[3][3][kTetLanes];  // R
  double skew[6][kTetLanes];         // N m: xx xy xz yy yz zz of A V (corotational.h)
};

/// The rotation that is nearest to one gradient of deformation F[3][3], whatever F is: for the lanes where
/// the vector kernel's formula has no answer. Defined beside the law.
void nearest_rotation(const double* F, double* R) noexcept;

inline constexpr int kSpringLanes = 8;

/// Eight springs, a lane each. A lane without stiffness takes no force, whatever its nodes do.
struct alignas(64) SpringPack {
  double rest[3][kSpringLanes];        // [axis] from the first end to the second, m
  double length[kSpringLanes];         // its norm, m
  double stiffness[kSpringLanes];      // N/m
  std::int32_t node[2][kSpringLanes];  // [end]
};

/// What one vector unit runs. `count`: of packs; u and v are m, f N.
struct LawKernels {
  const char* name;
  /// f -= dE/du.
  void (*add_corotational_forces)(const TetPack* packs, int count, const PaddedNode* u,
                                  PaddedNode* f) noexcept;
  /// E, J.
  double (*corotational_energy)(const TetPack* packs, int count, const PaddedNode* u) noexcept;
  /// tangents[count] at u; with `exact` the second derivative of E, else the warped linear stiffness.
  void (*linearize_corotational)(const TetPack* packs, int count, const PaddedNode* u, bool exact,
                                 TetTangent* tangents) noexcept;
  /// f += K v.
  void (*add_corotational_product)(const TetPack* packs, const TetTangent* tangents, int count,
                                   const PaddedNode* v, PaddedNode* f) noexcept;
  /// f -= dE/du.
  void (*add_spring_forces)(const SpringPack* packs, int count, const PaddedNode* u, PaddedNode* f) noexcept;
  /// E, J.
  double (*spring_energy)(const SpringPack* packs, int count, const PaddedNode* u) noexcept;
};

extern const LawKernels kPlainLawKernels;
extern const LawKernels kAvx2LawKernels;
extern const LawKernels kAvx512LawKernels;

/// Those that this processor can run, the fastest first, ended by null; never empty.
const LawKernels* const* law_kernels() noexcept;

}  // namespace omentum::physics::kernels
