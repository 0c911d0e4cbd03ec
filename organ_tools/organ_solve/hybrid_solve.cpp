#include "organ_tools/organ_solve/hybrid_solve.h"

#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "organ_tools/organ_solve/joined_law.h"
#include "organ_tools/organ_solve/move_to_rest.h"
#include "physics/direct_solve.h"
#include "physics/dynamics/corotational.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/rest_search.h"
#include "physics/hybrid/condensed_stiffness.h"
#include "physics/hybrid/connection.h"
#include "physics/tensor_solve.h"

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::NodeId;
using geometry::SurfaceId;
using geometry::TetId;
using geometry::Vec3;
using physics::MeshPart;

// What is imposed on nodes of the precomputed part that are its own, on its surface.
struct Contacts {
  std::vector<SurfaceId> nodes;
  std::vector<Vec3> displacements;
};

Contacts contacts_of(const organ::Organ& organ, Imposed imposed, Numbering numbering) {
  const organ::OrganSplit& split = *organ.split;
  Contacts contacts;
  for (const physics::ImposedDisplacement& i : imposed) {
    if (split.parts.dynamic.own_node[i.node].valid()) continue;
    const SurfaceId s = split.surface.of_node[split.parts.precomputed.own_node[i.node]];
    contacts.nodes.push_back(s);
    contacts.displacements.push_back(i.displacement);
    const bool follows = split.tie && std::ranges::binary_search(split.tie->slaves, s);
    if (s.valid() && !follows) continue;
    const auto position = static_cast<std::size_t>(organ.mesh.file_node[i.node]);
    throw InputError(
        "node " + std::to_string(organ.mesh.names_of_nodes(numbering).of(position)) +
        (follows ? " follows the dynamic part, on which it lies; expected nodes of that part, or others of "
                   "the precomputed one's surface"
                 : " is inside the precomputed part and has no tensors; expected nodes of its surface or of "
                   "the dynamic part"));
  }
  return contacts;
}

class HybridRest {
 public:
  HybridRest(const organ::Organ& organ, const organ::StoredTensors& tensors, const CutOrgan& cut,
             Imposed imposed, const std::vector<Vec3>& weights, Contacts contacts, DynamicLaw law)
      : organ_(organ),
        split_(*organ.split),
        tensors_(tensors),
        cut_(cut),
        imposed_(imposed),
        weights_(weights),
        contacts_(std::move(contacts)),
        law_(law),
        connection_(split_.parts, split_.surface, split_.tie ? &*split_.tie : nullptr),
        stiffness_(physics::assemble_stiffness(split_.parts.precomputed.mesh, organ.material)),
        loads_(loads_of_precomputed()),
        sag_(physics::direct_solve(stiffness_, split_.fixed, {}, loads_).displacements) {}

  std::vector<Vec3> displacements() {
    const std::vector<double> u = rest_of_dynamic();
    std::vector<Vec3> displacements(organ_.mesh.positions.size(), Vec3::Zero());
    const std::vector<Vec3> precomputed = follow(u);
    for (std::size_t n = 0; n < precomputed.size(); ++n)
      displacements[split_.parts.precomputed.node[n]] = precomputed[n];
    for (std::size_t n = 0; n < split_.parts.dynamic.node.size(); ++n)
      displacements[split_.parts.dynamic.node[n]] = Vec3(u.data() + 3 * n);
    return displacements;
  }

  // What tissue that is deformed so holds against at each node, [N], N.
  std::vector<Vec3> holding_forces(const std::vector<Vec3>& displacements) const {
    if (law_ == DynamicLaw::kLinear)
      return physics::holding_forces(stiffness_of(organ_, cut_), displacements);
    std::vector<Vec3> held(displacements.size(), Vec3::Zero());
    std::vector<Vec3> own;
    for (const NodeId n : split_.parts.precomputed.node) own.push_back(displacements[n]);
    const std::vector<Vec3> precomputed = physics::holding_forces(stiffness_, own);
    for (std::size_t n = 0; n < own.size(); ++n) held[split_.parts.precomputed.node[n]] += precomputed[n];
    std::vector<double> u;
    for (const NodeId n : split_.parts.dynamic.node)
      u.insert(u.end(), displacements[n].begin(), displacements[n].end());
    std::vector<double> f(u.size());
    turning_law()->forces(u, f);
    for (std::size_t n = 0; n < split_.parts.dynamic.node.size(); ++n)
      held[split_.parts.dynamic.node[n]] -= Vec3(f.data() + 3 * n);
    return held;
  }

  // What holds nodes that follow others is held at those: `forces`, [N], N.
  void pass_on_border(std::vector<Vec3>& forces) const {
    if (!split_.tie) return;
    std::vector<double> f_c, f_m(3 * connection_.leaders().size());
    for (const SurfaceId s : split_.connection) {
      const Vec3& f = forces[split_.parts.precomputed.node[split_.surface.node[s]]];
      f_c.insert(f_c.end(), f.begin(), f.end());
    }
    connection_.gather(f_c, f_m);
    for (std::size_t m = 0; m < connection_.leaders().size(); ++m)
      forces[split_.parts.dynamic.node[connection_.leaders()[m]]] += Vec3(f_m.data() + 3 * m);
  }

 private:
  std::unique_ptr<physics::Corotational> turning_law() const {
    auto law = std::make_unique<physics::Corotational>(split_.parts.dynamic.mesh, organ_.material);
    for (const TetId t : removed()) law->remove(t);
    return law;
  }

  // Connection nodes carry theirs as nodes of the dynamic part.
  std::vector<Vec3> loads_of_precomputed() const {
    std::vector<Vec3> loads;
    for (const NodeId n : split_.parts.precomputed.node) {
      const bool connects = split_.parts.dynamic.own_node[n].valid();
      loads.push_back(connects ? Vec3::Zero().eval() : weights_[n]);
    }
    return loads;
  }

  Vec3 sag_at(SurfaceId s) const { return sag_[split_.surface.node[s]]; }

  // Of connection nodes, then of contacts.
  Eigen::MatrixXd stiffness_of_held() const {
    std::vector<SurfaceId> held = split_.connection;
    held.insert(held.end(), contacts_.nodes.begin(), contacts_.nodes.end());
    return physics::condensed_stiffness(tensors_.storage == organ::Storage::kFloat
                                            ? physics::compliance_among(tensors_.single, held)
                                            : physics::compliance_among(tensors_.twofold, held));
  }

  // f_c: what the precomputed part does to its connection nodes while these are at rest.
  Eigen::VectorXd force_at_rest(const Eigen::MatrixXd& S) const {
    Eigen::VectorXd away(S.rows());  // of each held node, from where it would be by itself
    const std::size_t connected = split_.connection.size();
    for (std::size_t k = 0; k < connected; ++k)
      away.segment<3>(static_cast<Eigen::Index>(3 * k)) = -sag_at(split_.connection[k]);
    for (std::size_t k = 0; k < contacts_.nodes.size(); ++k)
      away.segment<3>(static_cast<Eigen::Index>(3 * (connected + k))) =
          contacts_.displacements[k] - sag_at(contacts_.nodes[k]);
    return -S.topRows(static_cast<Eigen::Index>(3 * connected)) * away;
  }

  physics::Inertia inertia() const {
    const std::vector<double> mass = physics::lumped_masses(organ_.mesh, organ_.material);
    physics::Inertia inertia{{}, physics::supports_of(split_.parts.dynamic, cut_.fixed)};
    for (const NodeId n : split_.parts.dynamic.node) inertia.mass.push_back(mass[n]);
    for (const physics::ImposedDisplacement& i : imposed_) {
      const NodeId n = split_.parts.dynamic.own_node[i.node];
      if (n.valid()) inertia.fixed[n] = physics::kPinned;
    }
    return inertia;
  }

  physics::BodyState start() const {
    physics::BodyState state = physics::state_at_rest(split_.parts.dynamic.node.size());
    for (const physics::ImposedDisplacement& i : imposed_) {
      const NodeId n = split_.parts.dynamic.own_node[i.node];
      if (n.valid()) Vec3::Map(&state.u[3 * static_cast<std::size_t>(n)]) = i.displacement;
    }
    return state;
  }

  std::vector<TetId> removed() const {
    std::vector<TetId> own;
    for (const TetId t : cut_.removed) own.push_back(split_.parts.dynamic.own_tetrahedron[t]);
    return own;
  }

  std::vector<double> rest_of_dynamic() {
    const MeshPart& dynamic = split_.parts.dynamic;
    const Eigen::MatrixXd S = stiffness_of_held();
    const Eigen::VectorXd f_c = force_at_rest(S);
    const physics::AddedStiffness added = connection_.added(S.topLeftCorner(f_c.size(), f_c.size()));
    std::vector<double> external;
    for (const NodeId n : dynamic.node)
      external.insert(external.end(), weights_[n].begin(), weights_[n].end());
    connection_.add_gathered({f_c.data(), static_cast<std::size_t>(f_c.size())}, external);
    physics::ImplicitStep stepper(dynamic.mesh, organ_.material, inertia(),
                                  {.step_s = kRestStep_s, .most_compliance_nodes = 0, .added = added});
    physics::BodyState state = start();
    const auto find_rest = [&] {
      if (law_ == DynamicLaw::kLinear)
        return run_to_rest([&] { return stepper.step(state, external); }, state);
      const auto turning = turning_law();
      JoinedLaw joined(*turning, added);
      return physics::search_rest(joined, stepper.factor(), external, state.u);
    };
    const bool rests = stepper.remove(removed()) && find_rest();
    if (!rests) throw InputError("--model hybrid: found no rest; expected smaller loads or displacements");
    return state.u;
  }

  // The precomputed part's nodes where the dynamic ones are at `u`.
  std::vector<Vec3> follow(std::span<const double> u) {
    std::vector<physics::ImposedSurfaceNode> held;
    std::vector<double> w_c(3 * split_.connection.size());
    connection_.lead(u, u, 0, w_c);
    for (std::size_t k = 0; k < split_.connection.size(); ++k)
      held.push_back({split_.connection[k], Vec3(w_c.data() + 3 * k) - sag_at(split_.connection[k])});
    for (std::size_t k = 0; k < contacts_.nodes.size(); ++k)
      held.push_back({contacts_.nodes[k], contacts_.displacements[k] - sag_at(contacts_.nodes[k])});
    const physics::SurfaceSolution surface =
        tensors_.storage == organ::Storage::kFloat
            ? physics::tensor_solve(tensors_.single, split_.surface, split_.fixed, held)
            : physics::tensor_solve(tensors_.twofold, split_.surface, split_.fixed, held);
    std::vector<Vec3> displacements = sag_;
    for (std::size_t s = 0; s < surface.displacements.size(); ++s)
      displacements[split_.surface.node[s]] += surface.displacements[s];
    return physics::extend_inside(stiffness_, split_.fixed, split_.surface, displacements, loads_);
  }

  const organ::Organ& organ_;
  const organ::OrganSplit& split_;
  const organ::StoredTensors& tensors_;
  const CutOrgan& cut_;
  Imposed imposed_;
  const std::vector<Vec3>& weights_;  // [N] of what is left
  Contacts contacts_;
  DynamicLaw law_;
  physics::Connection connection_;
  physics::Stiffness stiffness_;  // of the precomputed part
  std::vector<Vec3> loads_;       // [n] of its own nodes
  std::vector<Vec3> sag_;         // [n] under them, without the dynamic part
};

void require_dynamic(const organ::Organ& organ, const std::filesystem::path& file) {
  if (organ.split) return;
  throw InputError(file.string() +
                   ": has no dynamic part; --model hybrid expects an organ of organ_build --dynamic");
}

}  // namespace

void require_knows_tie(const organ::Organ& organ, const std::filesystem::path& file,
                       const std::string& model) {
  if (!organ.split || !organ.split->tie || model == "hybrid") return;
  throw InputError(file.string() + ": its parts share no nodes, and --model " + model +
                   " knows nothing of what ties them; expected --model hybrid");
}

physics::StaticSolution solve_hybrid(const organ::Organ& organ, const std::filesystem::path& file,
                                     const CutOrgan& cut, Imposed imposed, const Vec3& gravity,
                                     Numbering numbering, DynamicLaw law) {
  require_dynamic(organ, file);
  const organ::StoredTensors tensors = organ::map_tensors(file, organ);
  organ::require_whole(tensors, file);
  const std::vector<Vec3> weights = weights_of(organ, cut, gravity);
  HybridRest rest(organ, tensors, cut, imposed, weights, contacts_of(organ, imposed, numbering), law);
  physics::StaticSolution solution{rest.displacements(), {}};
  std::vector<Vec3> forces = rest.holding_forces(solution.displacements);
  for (std::size_t n = 0; n < forces.size(); ++n) forces[n] -= weights[n];
  rest.pass_on_border(forces);
  for (const physics::ImposedDisplacement& i : imposed) solution.holding_forces.push_back(forces[i.node]);
  return solution;
}

}  // namespace omentum::organ_tools
