// The models that organ_solve offers: the same question, answered with and without precomputation.
#pragma once

#include "organ/organ.h"
#include "physics/static_solution.h"

#include <filesystem>
#include <span>
#include <string>

namespace omentum::organ_tools {

using Imposed = std::span<const physics::ImposedDisplacement>;

/// A constrained solve from scratch. `gravity`: m/s^2. Throws geometry::InputError.
physics::StaticSolution solve_directly(const organ::Organ& organ, Imposed imposed,
                                       const geometry::Vec3& gravity);

/// The stored tensors, read from `file` in their own precision, with the contact system in double; inner
/// nodes follow elastically. Under gravity the organ first sags (one direct solve, u_g), and the tensors add
/// what u* - u_g calls for. Throws geometry::InputError for an imposed node without tensors (an inner one),
/// naming it.
/// `warning`: set when the tensors' precision may not give 1e-5 of the largest force, saying what would.
physics::StaticSolution solve_with_tensors(const organ::Organ& organ, const std::filesystem::path& file,
                                           Imposed imposed, const geometry::Vec3& gravity,
                                           std::string& warning);

}  // namespace omentum::organ_tools
