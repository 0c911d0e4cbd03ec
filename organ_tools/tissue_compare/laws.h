// The models that are compared.
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/dynamics/force_law.h"
#include "physics/material_map.h"

#include <array>
#include <memory>

namespace omentum::tissue_compare {

enum class Law { kTensorMass, kCorotational, kSpringMass };
inline constexpr std::array kLaws = {Law::kTensorMass, Law::kCorotational, Law::kSpringMass};

/// "tensor-mass", "corotational", "spring-mass".
const char* name_of(Law law);

/// Tissue and what holds it. The mesh outlives what is made of it.
struct Tissue {
  geometry::TetraMesh mesh;
  physics::MaterialMap material;
};

/// As simulations run it: tensor-mass in float.
std::unique_ptr<physics::ForceLaw> make_law(Law law, const Tissue& tissue);

/// In double throughout: differences of its forces are as good as those forces.
std::unique_ptr<physics::ForceLaw> make_exact_law(Law law, const Tissue& tissue);

/// Edges of a mesh, each once.
std::int32_t edge_count(const Tissue& tissue);

}  // namespace omentum::tissue_compare
