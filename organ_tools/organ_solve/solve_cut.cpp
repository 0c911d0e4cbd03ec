#include "organ_tools/organ_solve/solve_cut.h"

#include "physics/static_factor.h"
#include "physics/unheld_pieces.h"

#include <Eigen/LU>

#include <algorithm>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::MeshEditor;
using geometry::NodeId;
using geometry::TetId;
using geometry::Vec3;
using Values = std::vector<double>;

// A component whose force is to be found: of an imposed node, or of an anchor, which has none in truth.
struct Unknown {
  std::size_t component;
  double displacement;  // m, of an imposed one
  bool is_anchor;
};

class CutSolver {
 public:
  CutSolver(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed)
      : factor_(organ.mesh, organ.material, organ.fixed, 0) {
    MeshEditor editor(organ.mesh);
    std::vector<std::uint8_t> bits((organ.mesh.tetrahedra.size() + 7) / 8);
    for (const TetId t : cut.removed) bits[t / 8] = static_cast<std::uint8_t>(bits[t / 8] | 1 << t % 8);
    editor.set_removed(bits);
    for (const physics::ImposedDisplacement& i : imposed)
      for (int axis = 0; axis < 3; ++axis) add(3 * i.node + axis, i.displacement[axis], false);
    if (!anchor_unheld(organ, editor) || !factor_.remove(cut.removed))
      throw InputError("--remove: what is left hangs together too loosely to be solved");
  }

  // f: [3N], N; what the unknowns answer is added to it.
  Values solve(Values& f) {
    Values u(f.size());
    factor_.solve_exactly(f, u);
    const Eigen::VectorXd forces = compliance().fullPivLu().solve(lacking(u));
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      f[unknowns_[i].component] += forces[static_cast<Eigen::Index>(i)];
    factor_.solve_exactly(f, u);
    return u;
  }

  Values holding_forces(const Values& u) const {
    Values f(u.size());
    factor_.holding_forces(u, f);
    return f;
  }

 private:
  void add(std::size_t component, double displacement, bool is_anchor) {
    if (!factor_.is_held(component)) unknowns_.push_back({component, displacement, is_anchor});
  }

  // Pieces that imposed nodes alone hold: their anchors' forces are found with the others, and taken back.
  bool anchor_unheld(const organ::Organ& organ, const MeshEditor& editor) {
    std::vector<bool> is_known(organ.mesh.tetrahedra.size());
    bool is_held = true;
    physics::UnheldPieces unheld(organ.mesh, organ.fixed);
    for (const TetId t : unheld.find(editor)) {
      const auto piece = static_cast<std::size_t>(editor.piece_of(t));
      if (is_known[piece]) continue;
      is_known[piece] = true;
      for (const NodeId n : organ.mesh.tetrahedra[t])
        for (int axis = 0; axis < 3; ++axis) add(3 * n + axis, 0, true);
      is_held &= factor_.hold(organ.mesh.tetrahedra[t]);
    }
    return is_held;
  }

  // Of the unknowns to each other. What an anchor adds is force = anchor times displacement.
  Eigen::MatrixXd compliance() {
    const auto count = static_cast<Eigen::Index>(unknowns_.size());
    Eigen::MatrixXd C(count, count);
    Values f, u;
    for (Eigen::Index column = 0; column < count; ++column) {
      f.assign(3 * static_cast<std::size_t>(factor_.node_count()), 0);
      u.resize(f.size());
      f[unknowns_[column].component] = 1;
      factor_.solve_exactly(f, u);
      for (Eigen::Index row = 0; row < count; ++row) C(row, column) = u[unknowns_[row].component];
      if (unknowns_[column].is_anchor) C(column, column) -= 1 / factor_.anchor_n_m();
    }
    return C;
  }

  Eigen::VectorXd lacking(const Values& u) const {
    Eigen::VectorXd lacks(static_cast<Eigen::Index>(unknowns_.size()));
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      lacks[static_cast<Eigen::Index>(i)] = unknowns_[i].displacement - u[unknowns_[i].component];
    return lacks;
  }

  physics::StaticFactor factor_;
  std::vector<Unknown> unknowns_;
};

Vec3 at(const Values& values, NodeId n) {
  return Eigen::Map<const Vec3>(values.data() + 3 * n);
}

}  // namespace

physics::StaticSolution solve_cut(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                  const Vec3& gravity) {
  CutSolver solver(organ, cut, imposed);
  Values weight;
  for (const Vec3& w : weights_of(organ, cut, gravity)) weight.insert(weight.end(), w.begin(), w.end());
  Values loads = weight;
  const Values u = solver.solve(loads);
  const Values forces = solver.holding_forces(u);
  physics::StaticSolution solution;
  for (std::size_t n = 0; n < organ.mesh.positions.size(); ++n)
    solution.displacements.push_back(at(u, NodeId(n)));
  for (const physics::ImposedDisplacement& i : imposed) {
    solution.displacements[i.node] = i.displacement;
    solution.holding_forces.push_back(at(forces, i.node) - at(weight, i.node));
  }
  return solution;
}

}  // namespace omentum::organ_tools
