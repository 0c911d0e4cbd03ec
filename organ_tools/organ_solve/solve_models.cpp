#include "organ_tools/organ_solve/solve_models.h"

#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "organ_tools/organ_solve/tensor_error.h"
#include "physics/direct_solve.h"
#include "physics/tensor_solve.h"

#include <cstdio>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::Vec3;

// A linear answer of any size can be scaled to the true one; what is larger than this was not meant.
constexpr double kLargestInSizes = 1000;

// Loads of gravity, or none.
std::vector<Vec3> loads_of(const organ::Organ& organ, const CutOrgan& cut, const Vec3& gravity) {
  if (gravity.isZero(0)) return {};
  return weights_of(organ, cut, gravity);
}

// What messages call a node.
std::string name_of(const organ::Organ& organ, geometry::NodeId n, Numbering numbering) {
  const auto position = static_cast<std::size_t>(organ.mesh.file_node[n]);
  return "node " + std::to_string(organ.mesh.names_of_nodes(numbering).of(position));
}

// What the tensors have to add to `sag` at each imposed node.
std::vector<physics::ImposedSurfaceNode> increments(const organ::Organ& organ, Imposed imposed,
                                                    std::span<const Vec3> sag, Numbering numbering) {
  std::vector<physics::ImposedSurfaceNode> nodes;
  for (const physics::ImposedDisplacement& i : imposed) {
    const geometry::SurfaceId s = organ.surface.of_node[i.node];
    if (!s.valid()) {
      throw InputError(
          name_of(organ, i.node, numbering) +
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

// Decision 26: what float tensors keep. Nodes side by side, each moved its own way, need large forces whose
// effects nearly cancel, and may cost more. The error is known to a part in ten at worst: the warning comes
// that much early.
std::string precision_warning(const TensorError& error) {
  constexpr double kForce = 1e-5, kDisplacement = 2e-5, kEarly = 0.9;
  if (error.force < kEarly * kForce && error.displacement < kEarly * kDisplacement) return {};
  char text[200];
  std::snprintf(
      text, sizeof text,
      "these nodes need forces that nearly cancel: tensors stored in float are off by %.1e of the largest "
      "force and %.1e of the largest displacement; --store double or --model direct is exact",
      error.force, error.displacement);
  return text;
}

// Adds what the supports of partly held nodes carry, by K u - f, so that each force is all that holds its
// node.
void add_support_shares(const organ::Organ& organ, const physics::Stiffness& stiffness, Imposed imposed,
                        std::span<const Vec3> loads, physics::StaticSolution& solution) {
  const std::vector<Vec3> forces = physics::holding_forces(stiffness, solution.displacements);
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    const geometry::NodeId n = imposed[i].node;
    for (int axis = 0; axis < 3; ++axis) {
      if (!physics::is_fixed(organ.fixed[n], axis)) continue;
      solution.holding_forces[i][axis] = forces[n][axis] - (loads.empty() ? 0.0 : loads[n][axis]);
    }
  }
}

}  // namespace

physics::StaticSolution solve_directly(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                       const Vec3& gravity) {
  const physics::Stiffness stiffness = stiffness_of(organ, cut);
  const std::vector<Vec3> loads = loads_of(organ, cut, gravity);
  physics::StaticSolution solution = physics::direct_solve(stiffness, cut.fixed, imposed, loads);
  add_support_shares(organ, stiffness, imposed, loads, solution);
  return solution;
}

physics::StaticSolution solve_with_tensors(const organ::Organ& organ, const std::filesystem::path& file,
                                           Imposed imposed, const Vec3& gravity, Numbering numbering,
                                           std::string& warning) {
  if (organ.split) {
    throw InputError(
        file.string() +
        ": the tensors of a hybrid organ are of its precomputed part alone; expected --model hybrid");
  }
  const physics::Stiffness stiffness = physics::assemble_stiffness(organ.mesh, organ.material);
  const std::vector<Vec3> loads = loads_of(organ, {}, gravity);
  std::vector<Vec3> displacements(organ.mesh.positions.size(), Vec3::Zero());
  if (!loads.empty()) displacements = physics::direct_solve(stiffness, organ.fixed, {}, loads).displacements;

  const organ::StoredTensors tensors = organ::map_tensors(file, organ);
  organ::require_whole(tensors, file);
  physics::SurfaceSolution surface =
      superpose(organ, tensors, increments(organ, imposed, displacements, numbering));
  for (std::size_t s = 0; s < surface.displacements.size(); ++s) {
    displacements[organ.surface.node[s]] += surface.displacements[s];
  }
  physics::StaticSolution solution{
      physics::extend_inside(stiffness, organ.fixed, organ.surface, displacements, loads),
      std::move(surface.holding_forces)};
  add_support_shares(organ, stiffness, imposed, loads, solution);
  if (tensors.storage == organ::Storage::kFloat && !imposed.empty())
    warning = precision_warning(measure_error(organ, tensors, stiffness, loads, imposed, solution));
  return solution;
}

void require_sensible(const organ::Organ& organ, Imposed imposed, const physics::StaticSolution& solution,
                      Numbering numbering) {
  const auto refuse = [&](geometry::NodeId n, const std::string& what) {
    throw InputError(name_of(organ, n, numbering) + ": " + what);
  };
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    if (!solution.holding_forces[i].allFinite()) refuse(imposed[i].node, "its force is beyond all numbers");
  }
  const double limit = largest_displacement(organ.mesh);
  for (std::size_t n = 0; n < solution.displacements.size(); ++n) {
    // written so that a NaN is refused
    if (solution.displacements[n].cwiseAbs().maxCoeff() <= limit) continue;
    char text[160];
    std::snprintf(text, sizeof text,
                  "its displacement is not finite or more than %g m, %g times the organ's size", limit,
                  kLargestInSizes);
    refuse(geometry::NodeId(n), text);
  }
}

double largest_displacement(const geometry::TetraMesh& mesh) {
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return kLargestInSizes * (high - low).norm();
}

}  // namespace omentum::organ_tools
