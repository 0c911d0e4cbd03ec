// What a hybrid step is of, and what follows from that alone.
#pragma once

#include "geometry/surface.h"
#include "physics/dynamics/joinable_step.h"
#include "physics/hybrid/connection.h"
#include "physics/hybrid/mesh_split.h"
#include "physics/surface_compliance.h"

#include <Eigen/Core>

#include <memory>

namespace omentum::physics {

/// How the dynamic part's forces come about; the precomputed part is linear whatever they are.
enum class DynamicLaw {
  kLinear,        // ImplicitStep: small turns
  kCorotational,  // WarpedStep: what is pulled, turned and lifted away
};

/// What a hybrid step is of; all of it outlives the step, but for `inertia`, `weights` and `tie`.
struct HybridBody {
  const MeshSplit& split;
  const geometry::Surface& surface;     // of the precomputed part, in its own nodes
  const SurfaceCompliance& compliance;  // of that surface
  const MaterialMap& material;
  const FixedComponents& fixed;  // [n] of the precomputed part
  Inertia inertia;               // of the whole, [N]; what the precomputed part's own nodes weigh is not read
  std::vector<double> weights;   // [3N], N, that always act on the precomputed part's own nodes
  DynamicLaw law = DynamicLaw::kLinear;
  const BorderTie* tie = nullptr;  // of parts that share no nodes: how they hold together
};

/// Where the precomputed part's surface rests under its own nodes' weights, without the dynamic part:
/// [mobile], m; empty where nothing weighs. Throws as StiffnessFactor does.
std::vector<Vec3> sag_of(const HybridBody& body);

/// The dynamic part's own step, in its own nodes, with the precomputed one's stiffness S ([3c x 3c], N/m) and
/// the masses that its connection nodes carry. Throws as KeptFactor does.
std::unique_ptr<JoinableStep> dynamic_step_of(const HybridBody& body, const Connection& connection,
                                              const Eigen::MatrixXd& S, double step_s,
                                              int most_compliance_nodes);

}  // namespace omentum::physics
