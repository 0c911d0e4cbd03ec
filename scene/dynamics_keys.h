// Reads what a scene says of an organ that moves by itself, or is cut.
#pragma once

#include "scene/dynamics_spec.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// Whether an organ of this model has masses that swing, and tears.
bool has_masses(const std::string& model);
/// Whether one part of it is precomputed and the other has masses.
bool is_hybrid(const std::string& model);
/// The keys beside `model` of one of [[organs]].
DynamicsSpec read_dynamics(TomlSection& organ, const std::string& model);
/// Where tissue tears: keys of an organ, and of a region with a material of its own.
TearSpec read_tears(TomlSection& section);

}  // namespace omentum::scene
