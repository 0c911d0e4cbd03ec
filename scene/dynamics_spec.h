// How an organ moves that has masses: what a scene says beside its model.
#pragma once

#include "geometry/types.h"

#include <optional>
#include <string>

namespace omentum::scene {

/// Where tissue tears (Cotin 1998, section 5.5); what is absent: never for this reason.
struct TearSpec {
  std::optional<double> volume_change;    // |V / V_0 - 1| of a tetrahedron
  std::optional<double> mean_elongation;  // l / l_0 - 1, mean of its edges
  std::optional<double> edge_elongation;  // l / l_0 - 1, of its most stretched edge
  std::optional<double> stress_pa;        // largest principal stress
};

/// Parameters of the models that move by themselves.
struct DynamicsSpec {
  std::string integrator = "implicit";  // "implicit", "symplectic", "euler" or "rk4"
  std::optional<double> step_s;         // none: the model's own
  double mass_damping_per_s = 2;        // a and b of the damping a M + b K
  double stiffness_damping_s = 0.01;
  geometry::Vec3 gravity_m_s2 = geometry::Vec3::Zero();
  TearSpec tears;  // of the organ's own material
  // Tissue burns through: a tetrahedron goes this long after an edge has met it, and so many go in a second.
  double cut_delay_s = 0.05;
  double cut_rate_per_s = 1000;
  double smallest_piece_m3 = 0;  // loose pieces below this are dropped
  // Of an organ without masses, or with some in a part, what becomes of a piece that supports no longer hold:
  // "drop" or "fall"; empty for others, whose pieces fall as they are. And what then pulls it, where the
  // organ has no gravity of its own.
  std::string pieces;
  geometry::Vec3 piece_gravity_m_s2 = geometry::Vec3(0, 0, -9.81);
  std::string dynamic_part;  // of a hybrid organ that is built of a mesh, as organ_build --dynamic takes it
  std::string dynamic_mesh;  // or that part's own mesh, "phantom:..." or a file: organ_build --dynamic-mesh
  std::string law;           // of a hybrid organ's dynamic part: "linear" or "corotational"; else empty
  std::string where;         // FILE:LINE of the step or of the organ, for what only its mesh can tell
};

}  // namespace omentum::scene
