// Strain and stress at the nodes of a body, from the tetrahedra around them.
#pragma once

#include "physics/element_strain.h"
#include "physics/material_map.h"

namespace omentum::physics {

/// Whose stress it is.
enum class StressLaw {
  kLinear,  // of linear_strain(F), in W: what a body of the tensor-mass law answers with, its false one under
            // a large rotation too
  kTurned,  // of turned_strain(F), in the frame that turns with each tetrahedron: the co-rotational law's
  kNone,    // not known, as of springs, whose law is of edges
};

/// A body at one moment, and at which of its nodes it is asked.
struct BodyShape {
  std::span<const double> u;              // [3N], from rest, m
  std::span<const std::uint8_t> removed;  // bit t % 8 of byte t / 8: tetrahedron t is gone; empty: none is
  std::span<const geometry::NodeId> nodes;
};

/// Tensors are averaged over the tetrahedra around a node that are left, by volume at rest; of what comes out
/// the largest principal value is told. Nominal stress, per area at rest. No allocation after construction;
/// one thread at a time.
class NodalStress {
 public:
  /// `mesh` must outlive this.
  NodalStress(const geometry::TetraMesh& mesh, const MaterialMap& material, StressLaw law);

  bool knows_stress() const noexcept { return law_ != StressLaw::kNone; }
  /// At each of the shape's nodes: `strain` of turned_strain(F), whatever the law is, and `stress_pa` (empty
  /// where none is known). 0 where no tetrahedron is left.
  void measure(const BodyShape& shape, std::span<float> strain, std::span<float> stress_pa) noexcept;

 private:
  struct Sum {
    Eigen::Matrix3d strain, stress;  // times volume
    double volume_m3;
    bool is_asked;
  };
  struct Stiffness {
    double lambda_pa, mu_pa;
  };
  void add(geometry::TetId t, std::span<const double> u) noexcept;

  const geometry::TetraMesh& mesh_;
  DeformationGradients gradients_;
  StressLaw law_;
  std::vector<Stiffness> stiffness_;  // [T]
  std::vector<Sum> sums_;             // workspace, [N]
};

}  // namespace omentum::physics
