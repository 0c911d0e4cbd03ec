// An intestine and its mesentery: what a scene says beside its model.
#pragma once

#include "geometry/gut_anatomy.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::scene {

/// What an intestine cannot pass: it stays above a plane, or inside an ellipsoid or a box.
struct ObstacleSpec {
  std::string shape;                                    // "plane", "ellipsoid" or "box"
  geometry::Vec3 centre = geometry::Vec3::Zero();       // or any place on the plane, in W, m
  geometry::Vec3 normal = geometry::Vec3::UnitZ();      // of the plane, towards where the intestine is, unit
  geometry::Vec3 half_axes_m = geometry::Vec3::Zero();  // of ellipsoid and box, along W's axes
  std::string where{};                                  // FILE:LINE of it, for what only the gut can tell
};

/// What it is made of (physics/intestine/gut_material.h); what is absent is the physics' own.
struct GutMaterialSpec {
  std::optional<double> gut_mass_kg_m, gut_stretch_n, gut_bending_n_m2, mesentery_mass_kg_m2,
      mesentery_stretch_n_m, spring_damping_s, calming_time_s;
};

struct IntestineSpec {
  geometry::GutAnatomy anatomy;
  GutMaterialSpec material;
  std::string method = "projective";  // or "explicit"
  std::optional<double> step_s;       // none: the method's own
  geometry::Vec3 gravity_m_s2 = {0, 0, -9.81};
  std::string collision = "complete";  // or "stochastic"
  std::uint32_t seed = 1;              // of the pairs that "stochastic" tries
  double friction = 0.1;               // Coulomb coefficient, of the gut against itself and what it meets
  double wall_stiffness_n_m = 300;     // how a place of its skin gives way to an instrument, beside its axis
  std::vector<ObstacleSpec> obstacles{};  // the scene's
  std::string where{};                    // FILE:LINE of the organ, for what only its making can tell
};

}  // namespace omentum::scene
