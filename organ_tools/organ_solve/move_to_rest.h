// The models that move: run until they rest.
#pragma once

#include "organ_tools/organ_solve/cut_organ.h"
#include "organ_tools/organ_solve/solve_models.h"
#include "physics/dynamics/body_state.h"

#include <functional>
#include <string_view>

namespace omentum::organ_tools {

/// "tensor-mass", "corotational", "spring-mass".
bool is_dynamic_model(std::string_view model);

/// Many periods of an organ's slowest swing (0.2 to 1 s): a step leaves about a tenth of it.
inline constexpr double kRestStep_s = 1;

/// Takes steps of that length until nothing moves. False: one failed, or it does not come to that.
bool run_to_rest(const std::function<bool()>& step, const physics::BodyState& state);

/// Where the organ comes to rest under gravity with the imposed nodes held, from the undeformed shape. The
/// linear model runs there by large implicit steps (physics::ImplicitStep), whose own damping is all that
/// slows it down; the others, whose steps on the rest shape's factor are not stable once they turned, descend
/// their energy (physics::search_rest). The tetrahedra are removed from law and factor as while an organ
/// moves. Answers as solve_directly(). Throws geometry::InputError where it finds no rest. Precondition:
/// is_dynamic_model(model).
physics::StaticSolution move_to_rest(std::string_view model, const organ::Organ& organ, const CutOrgan& cut,
                                     Imposed imposed, const geometry::Vec3& gravity);

}  // namespace omentum::organ_tools
