// The damped springs that an intestine and its mesentery consist of, and their masses.
#pragma once

#include "geometry/gut_shape.h"
#include "physics/intestine/gut_material.h"

#include <array>
#include <span>
#include <vector>

namespace omentum::physics {

/// Springs between the masses m and m + offset: energy k (l - l0)^2 / 2 each, and a damping force k tau dl/dt
/// along it. Masses are numbered row by row, so every spring of one direction has one offset, and a step runs
/// through them without an index.
struct GutSpringFamily {
  std::int32_t offset = 0;
  std::vector<double> stiffness_n_m;  // [masses] k; 0: there is none
  std::vector<double> rest_m;         // [masses] l0
};

/// Against bending: a spring between a mass of the axis and the middle of its two neighbours. Its length is
/// the sagitta a^2 kappa / 2 of the curvature kappa over segments of length a, so that with k = 4 B / a^3 its
/// energy is B a (kappa - kappa0)^2 / 2: that of a beam of bending stiffness B, however fine its segments.
struct GutBends {
  std::vector<double> stiffness_n_m;  // [columns] k; 0 at both ends
  std::vector<double> rest_m;         // [columns] the sagitta at rest
};

/// The mass-spring model (Raghupathi 2004, 3.2): at rest in the shape that it is made of. Constant; any
/// thread may read it.
class GutSprings {
 public:
  /// Throws std::invalid_argument naming what cannot be (gut_material.h).
  GutSprings(const geometry::GutShape& shape, const GutMaterial& material);

  const geometry::GutLayout& layout() const { return layout_; }
  /// Along the rows, across them, and both diagonals of each cell.
  const std::array<GutSpringFamily, 4>& families() const { return families_; }
  const GutBends& bends() const { return bends_; }
  std::span<const double> mass() const { return mass_; }                  // [masses], kg
  std::span<const double> inverse_mass() const { return inverse_mass_; }  // [masses], 1/kg; 0 where held
  double damping_s() const { return damping_s_; }                         // tau
  double drag_per_s() const { return drag_per_s_; }  // force per momentum, against velocity

  /// f = -dE/dx - damping, N, overwritten, at held masses too. Without drag. All [masses]; allocates nothing.
  void forces(std::span<const geometry::Vec3> x, std::span<const geometry::Vec3> v,
              std::span<geometry::Vec3> f) const noexcept;

  /// E, J: zero at rest.
  double energy(std::span<const geometry::Vec3> x) const noexcept;

 private:
  enum Direction { kAlong, kAcross, kFalling, kRising };

  void lay_gut(const geometry::GutShape& shape, const GutMaterial& material);
  void lay_cell(const geometry::GutShape& shape, double stretch_n_m, std::int32_t row, std::int32_t column);
  void add(const geometry::GutShape& shape, Direction direction, geometry::MassId from, double stiffness);
  void weigh(const geometry::GutShape& shape, const GutMaterial& material);

  geometry::GutLayout layout_;
  std::array<GutSpringFamily, 4> families_;
  GutBends bends_;
  std::vector<double> mass_, inverse_mass_;
  double damping_s_, drag_per_s_;
};

double kinetic_energy(const GutSprings& springs, std::span<const geometry::Vec3> v) noexcept;  // J

}  // namespace omentum::physics
