// The models that organ_solve offers: the same question, answered with and without precomputation.
#pragma once

#include "organ_tools/organ_solve/cut_organ.h"

#include <filesystem>
#include <span>
#include <string>

namespace omentum::organ_tools {

using Imposed = std::span<const physics::ImposedDisplacement>;
using geometry::Numbering;

/// A constrained solve from scratch. `gravity`: m/s^2. The holding force of an imposed node is, here and
/// below, all that holds it there: in its free components the hand, in held ones its support. Throws
/// geometry::InputError.
physics::StaticSolution solve_directly(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                       const geometry::Vec3& gravity);

/// The stored tensors, read from `file` in their own precision, with the contact system in double; inner
/// nodes follow elastically. Under gravity the organ first sags (one direct solve, u_g), and the tensors add
/// what u* - u_g calls for. Throws geometry::InputError for an imposed node without tensors (an inner one),
/// naming it by `numbering`.
/// `warning`: set when float tensors gave less than 1e-5 of the largest force or 2e-5 of the largest
/// displacement, by how much, and what would be exact.
physics::StaticSolution solve_with_tensors(const organ::Organ& organ, const std::filesystem::path& file,
                                           Imposed imposed, const geometry::Vec3& gravity,
                                           Numbering numbering, std::string& warning);

/// The largest displacement that can be meant, m: a thousand times the mesh's diagonal.
double largest_displacement(const geometry::TetraMesh& mesh);

/// Throws geometry::InputError naming a node whose force or displacement is not finite, or that moves farther
/// than that.
void require_sensible(const organ::Organ& organ, Imposed imposed, const physics::StaticSolution& solution,
                      Numbering numbering);

}  // namespace omentum::organ_tools
