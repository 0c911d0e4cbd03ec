// A static solution as the two tables that organ_solve writes.
#pragma once

#include "organ_tools/organ_solve/solve_models.h"

#include <string>

namespace omentum::organ_tools {

/// PREFIX.u.csv: "node,ux,uy,uz" for every node of the mesh file, in its order (m; unused ones do not move,
/// merged ones do as those that took their places),
/// and PREFIX.f.csv: "node,fx,fy,fz", all that holds each imposed node there (N; where a support holds a
/// component, its share; of merged nodes that which took their place). Their first line is a comment that
/// says the numbering. Both are written beside their places and then renamed. Throws geometry::InputError,
/// naming the file.
void write_solution(const std::string& prefix, const organ::Organ& organ, Imposed imposed,
                    const physics::StaticSolution& solution, geometry::Numbering numbering);

}  // namespace omentum::organ_tools
