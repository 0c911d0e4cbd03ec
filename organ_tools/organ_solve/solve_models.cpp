#include "organ_tools/organ_solve/solve_models.h"

#include "organ/stored_tensors.h"
#include "physics/direct_solve.h"
#include "physics/tensor_solve.h"

#include <cstdio>
#include <limits>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::Vec3;

// Loads of gravity, or none.
std::vector<Vec3> loads_of(const organ::Organ& organ, const Vec3& gravity) {
  if (gravity.isZero(0)) return {};
  return physics::body_forces(organ.mesh, organ.material, gravity);
}

// What the tensors have to add to `sag` at each imposed node.
std::vector<physics::ImposedSurfaceNode> increments(const organ::Organ& organ, Imposed imposed,
                                                    std::span<const Vec3> sag) {
  std::vector<physics::ImposedSurfaceNode> nodes;
  for (const physics::ImposedDisplacement& i : imposed) {
    const geometry::SurfaceId s = organ.surface.of_node[i.node];
    if (!s.valid()) {
      throw InputError(
          "node " + std::to_string(organ.mesh.file_node[i.node]) +
          " is inside the organ and has no tensors; expected nodes of the surface (or --model direct)");
    }
    nodes.push_back({s, i.displacement - (sag.empty() ? Vec3::Zero().eval() : sag[i.node])});
  }
  return nodes;
}

physics::SurfaceSolution superpose(const organ::Organ& organ, const organ::StoredTensors& tensors,
                                   std::span<const physics::ImposedSurfaceNode> imposed) {
  if (tensors.storage == organ::Storage::kFloat) {
    return physics::tensor_solve(tensors.single, organ.surface, organ.fixed, imposed);
  }
  return physics::tensor_solve(tensors.twofold, organ.surface, organ.fixed, imposed);
}

// Nodes side by side, each moved its own way, need large forces whose effects nearly cancel. The condition
// number bounds the error; what was measured on organs lies ten times below.
std::string precision_warning(organ::Storage storage, double rcond) {
  constexpr double kFloatRounding = std::numeric_limits<float>::epsilon() / 2, kPromised = 1e-5,
                   kMeasured = 0.1;
  if (storage != organ::Storage::kFloat || kMeasured * kFloatRounding <= kPromised * rcond) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "these nodes need forces that nearly cancel: tensors stored in float may be off by %.0e "
                "of the largest; --store double or --model direct is exact",
                kFloatRounding / rcond);
  return text;
}

}  // namespace

physics::StaticSolution solve_directly(const organ::Organ& organ, Imposed imposed, const Vec3& gravity) {
  return physics::direct_solve(physics::assemble_stiffness(organ.mesh, organ.material), organ.fixed, imposed,
                               loads_of(organ, gravity));
}

physics::StaticSolution solve_with_tensors(const organ::Organ& organ, const std::filesystem::path& file,
                                           Imposed imposed, const Vec3& gravity, std::string& warning) {
  const physics::Stiffness stiffness = physics::assemble_stiffness(organ.mesh, organ.material);
  const std::vector<Vec3> loads = loads_of(organ, gravity);
  std::vector<Vec3> displacements(organ.mesh.positions.size(), Vec3::Zero());
  if (!loads.empty()) displacements = physics::direct_solve(stiffness, organ.fixed, {}, loads).displacements;

  const organ::StoredTensors tensors = organ::map_tensors(file, organ);
  physics::SurfaceSolution surface = superpose(organ, tensors, increments(organ, imposed, displacements));
  warning = precision_warning(tensors.storage, surface.rcond);
  for (std::size_t s = 0; s < surface.displacements.size(); ++s) {
    displacements[organ.surface.node[s]] += surface.displacements[s];
  }
  return {physics::extend_inside(stiffness, organ.fixed, organ.surface, displacements, loads),
          std::move(surface.holding_forces)};
}

}  // namespace omentum::organ_tools
