#include "physics/hybrid/hybrid_body.h"

#include "physics/direct_solve.h"
#include "physics/dynamics/carried_mass.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/warped_step.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;

namespace {

Inertia inertia_of(const HybridBody& body, const Connection& connection) {
  Inertia own = body.inertia;
  own.fixed = supports_of(body.split.dynamic, body.inertia.fixed);
  own.mass.clear();
  for (const NodeId n : body.split.dynamic.node) own.mass.push_back(body.inertia.mass[n]);
  if (!connection.is_tied()) return own;
  std::vector<double> mass;
  for (const SurfaceId s : connection.nodes())
    mass.push_back(body.inertia.mass[body.split.precomputed.node[body.surface.node[s]]]);
  const std::vector<double> carried = connection.carried(mass);
  for (std::size_t m = 0; m < carried.size(); ++m) {
    double& sum = own.mass[connection.leaders()[m]];
    sum = std::max(sum + carried[m], CarriedMass::kLeastShare * sum);
  }
  return own;
}

}  // namespace

std::vector<Vec3> sag_of(const HybridBody& body) {
  const MeshPart& part = body.split.precomputed;
  std::vector<Vec3> loads;
  for (const NodeId n : part.node) {
    const bool is_own = !body.split.dynamic.own_node[n].valid();
    loads.push_back(is_own ? Vec3(body.weights.data() + 3 * n) : Vec3::Zero().eval());
  }
  if (std::ranges::all_of(loads, [](const Vec3& f) { return f.isZero(0); })) return {};
  const Stiffness K = assemble_stiffness(part.mesh, body.material);
  const std::vector<Vec3> displacements = direct_solve(K, body.fixed, {}, loads).displacements;
  std::vector<Vec3> sag;
  for (std::int32_t s = 0; s < body.surface.mobile_count; ++s)
    sag.push_back(displacements[body.surface.node[static_cast<std::size_t>(s)]]);
  return sag;
}

std::unique_ptr<JoinableStep> dynamic_step_of(const HybridBody& body, const Connection& connection,
                                              const Eigen::MatrixXd& S, double step_s,
                                              int most_compliance_nodes) {
  const AddedStiffness added = connection.added(S);
  Inertia inertia = inertia_of(body, connection);
  const geometry::TetraMesh& mesh = body.split.dynamic.mesh;
  if (body.law == DynamicLaw::kLinear) {
    return std::make_unique<ImplicitStep>(
        mesh, body.material, std::move(inertia),
        ImplicitOptions{.step_s = step_s, .most_compliance_nodes = most_compliance_nodes, .added = added});
  }
  return std::make_unique<WarpedStep>(
      mesh, body.material, std::move(inertia), Corotational(mesh, body.material),
      WarpedOptions{.step_s = step_s, .most_compliance_nodes = most_compliance_nodes, .added = added});
}

}  // namespace omentum::physics
