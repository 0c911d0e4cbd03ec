#include "physics/dynamics/kept_factor.h"

#include "physics/dynamics/element_root.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace omentum::physics {

namespace {

// A over all nodes.
Stiffness system_of(const Stiffness& K, std::span<const double> mass, const SystemWeights& weights) {
  Stiffness A = K;
  for (std::int32_t n = 0; n < A.node_count(); ++n) {
    for (std::int32_t b = A.start[n]; b < A.start[n + 1]; ++b) {
      A.block[b] *= weights.stiffness;
      if (A.neighbour[b] == n) A.block[b].diagonal().array() += weights.mass * mass[n];
    }
  }
  return A;
}

std::vector<std::int32_t> free_components(const FreeDofs& free) {
  std::vector<std::int32_t> components(free.count);
  for (std::size_t c = 0; c < free.index.size(); ++c) {
    if (free.index[c] >= 0) components[free.index[c]] = static_cast<std::int32_t>(c);
  }
  return components;
}

}  // namespace

struct KeptFactor::Assembled {
  FreeDofs free;
  Stiffness stiffness;
  std::optional<StiffnessFactor> factor;  // none where everything is held

  Assembled(const geometry::TetraMesh& mesh, const MaterialMap& material, const FixedComponents& fixed,
            std::span<const double> mass, const SystemWeights& weights, const AddedStiffness& added)
      : free(free_dofs(fixed)), stiffness(with_added(assemble_stiffness(mesh, material), added)) {
    if (free.count > 0) factor.emplace(system_of(stiffness, mass, weights), free);
  }
  Supernodes supernodes() const { return factor ? factor->supernodes() : Supernodes{}; }
};

KeptFactor::KeptFactor(const geometry::TetraMesh& mesh, const MaterialMap& material,
                       const FixedComponents& fixed, const std::vector<double>& mass,
                       const SystemWeights& weights, int most_compliance_nodes, const AddedStiffness& added)
    : KeptFactor(mesh, material, mass, weights, most_compliance_nodes,
                 Assembled(mesh, material, fixed, mass, weights, added)) {}

KeptFactor::KeptFactor(const geometry::TetraMesh& mesh, const MaterialMap& material,
                       const std::vector<double>& mass, const SystemWeights& weights,
                       int most_compliance_nodes, const Assembled& assembled)
    : mesh_(mesh),
      material_(material),
      mass_(mass),
      uncut_mass_(mass),
      weights_(weights),
      start_(assembled.stiffness.start),
      neighbour_(assembled.stiffness.neighbour.begin(), assembled.stiffness.neighbour.end()),
      block_(assembled.stiffness.block.begin(), assembled.stiffness.block.end()),
      uncut_block_(block_),
      component_(assembled.free.count),
      position_(assembled.free.index.size(), -1),
      panels_(assembled.supernodes()),
      uncut_(panels_),
      downdate_(panels_),
      changed_(panels_.supernodes().size()),
      scratch_(std::max(1, panels_.most_rows() / kernels::kTileRows)),
      x_(panels_.size()),
      residual_(position_.size()),
      correction_(position_.size()),
      columns_(panels_, 3 * static_cast<std::size_t>(most_compliance_nodes)),
      known_blocks_(most_compliance_nodes) {
  touched_.reserve(position_.size());
  const std::vector<std::int32_t> components = free_components(assembled.free);
  const Supernodes order = assembled.supernodes();
  for (std::int32_t p = 0; p < order.size; ++p) {
    component_[p] = components[order.permutation[p]];
    position_[component_[p]] = p;
  }
}

RankSix KeptFactor::root_of(geometry::TetId t) const noexcept {
  const ElementRoot W =
      std::sqrt(weights_.stiffness) * element_root(corners_of(mesh_, t), material_.of(mesh_, t));
  RankSix root;
  for (int i = 0; i < 12; ++i) {
    root.position[i] = position_[3 * mesh_.tetrahedra[t][i / 3] + i % 3];
    for (int k = 0; k < kernels::kRank; ++k) root.w[i][k] = W(i, k);
  }
  return root;
}

void KeptFactor::subtract_element(geometry::TetId t) noexcept {
  const ElementTensors element = element_tensors(corners_of(mesh_, t), material_.of(mesh_, t));
  const geometry::Tetrahedron& tet = mesh_.tetrahedra[t];
  for (int j = 0; j < 4; ++j) {
    const auto row = neighbour_.begin() + start_[tet[j]], row_end = neighbour_.begin() + start_[tet[j] + 1];
    for (int k = 0; k < 4; ++k)
      block_[std::lower_bound(row, row_end, tet[k]) - neighbour_.begin()] -= element[j][k];
  }
}

bool KeptFactor::remove(std::span<const geometry::TetId> tetrahedra) noexcept {
  bool definite = true;
  known_blocks_.forget();
  while (!tetrahedra.empty()) {
    const auto now = tetrahedra.first(std::min<std::size_t>(tetrahedra.size(), FactorDowndate::kMost));
    std::array<RankSix, FactorDowndate::kMost> roots;
    for (std::size_t i = 0; i < now.size(); ++i) {
      roots[i] = root_of(now[i]);
      subtract_element(now[i]);
    }
    definite &= apply({roots.data(), now.size()});
    tetrahedra = tetrahedra.subspan(now.size());
  }
  return definite;
}

bool KeptFactor::apply(std::span<const RankSix> roots) noexcept {
  const bool definite = downdate_.apply(panels_, roots);
  for (const std::int32_t s : downdate_.changed()) changed_[s] = 1;
  return definite;
}

// Of two nodes at most.
RankSix KeptFactor::root_of_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg,
                                   bool is_added) const noexcept {
  RankSix root{.position = {}, .w = {}, .is_added = is_added};
  root.position.fill(-1);
  for (std::size_t i = 0; i < 3 * nodes.size(); ++i) {
    root.position[i] = position_[3 * nodes[i / 3] + static_cast<std::int32_t>(i % 3)];
    root.w[i][i] = std::sqrt(weights_.mass * kg[i / 3]);
  }
  return root;
}

bool KeptFactor::add_mass(std::span<const geometry::NodeId> nodes, double mass) noexcept {
  const std::array<double, 2> of_pair{mass, mass};
  return change_masses(nodes, of_pair, true);
}

bool KeptFactor::add_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept {
  return change_masses(nodes, kg, true);
}

bool KeptFactor::take_mass(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept {
  return change_masses(nodes, kg, false);
}

// By pairs; `kg`: of each node, or of a pair that all are like.
bool KeptFactor::change_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg,
                               bool is_added) noexcept {
  bool definite = true;
  known_blocks_.forget();
  std::array<RankSix, FactorDowndate::kMost> roots;
  for (std::size_t next = 0; next < nodes.size();) {
    std::size_t count = 0;
    for (; count < roots.size() && next < nodes.size(); ++count) {
      const auto pair = nodes.subspan(next, std::min<std::size_t>(nodes.size() - next, 2));
      const auto own = kg.size() == nodes.size() ? kg.subspan(next, pair.size()) : kg.first(pair.size());
      roots[count] = root_of_masses(pair, own, is_added);
      for (std::size_t i = 0; i < pair.size(); ++i) mass_[pair[i]] += is_added ? own[i] : -own[i];
      next += pair.size();
    }
    definite &= apply({roots.data(), count});
  }
  return definite;
}

void KeptFactor::restore() noexcept {
  known_blocks_.forget();
  std::ranges::copy(uncut_mass_, mass_.begin());
  std::ranges::copy(uncut_block_, block_.begin());
  for (std::size_t s = 0; s < changed_.size(); ++s) {
    if (changed_[s] == 0) continue;
    panels_.copy(panels_.supernodes()[s], uncut_);
    changed_[s] = 0;
  }
}

void KeptFactor::solve_roughly(std::span<const double> b, std::span<double> x) noexcept {
  for (std::size_t p = 0; p < x_.size(); ++p) x_[p] = static_cast<float>(b[component_[p]]);
  panels_.solve(x_.data(), scratch_.data()->value);
  for (std::size_t c = 0; c < position_.size(); ++c) x[c] = position_[c] >= 0 ? x_[position_[c]] : 0.0;
}

void KeptFactor::solve(std::span<const double> b, std::span<double> x) noexcept {
  solve_roughly(b, x);
  multiply(x, residual_);
  for (std::size_t c = 0; c < residual_.size(); ++c) residual_[c] = b[c] - residual_[c];
  solve_roughly(residual_, correction_);
  for (std::size_t c = 0; c < residual_.size(); ++c) x[c] += correction_[c];
}

void KeptFactor::holding_forces(std::span<const double> u, std::span<double> f) const noexcept {
  kernels::multiply_block_rows(start_.data(), neighbour_.data(), block_.front().data(), node_count(),
                               u.data(), f.data());
}

void KeptFactor::multiply(std::span<const double> x, std::span<double> y) const noexcept {
  holding_forces(x, y);
  for (std::size_t c = 0; c < y.size(); ++c)
    y[c] = position_[c] < 0 ? 0.0 : weights_.mass * mass_[c / 3] * x[c] + weights_.stiffness * y[c];
}

// Their free components' positions.
void KeptFactor::touch(std::span<const geometry::NodeId> nodes) noexcept {
  touched_.clear();
  for (const geometry::NodeId n : nodes) {
    for (int axis = 0; axis < 3; ++axis)
      if (const std::int32_t p = position_[3 * n + axis]; p >= 0) touched_.push_back(p);
  }
}

void KeptFactor::inverse_block(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept {
  if (known_blocks_.find(nodes, block)) return;
  const std::size_t width = 3 * nodes.size();
  touch(nodes);
  columns_.begin(panels_, touched_, width);
  for (std::size_t c = 0; c < width; ++c) {
    const std::int32_t p = position_[3 * nodes[c / 3] + static_cast<std::int32_t>(c % 3)];
    if (p >= 0) columns_.set(panels_, c, p, 1);
  }
  columns_.square(panels_, block);
  known_blocks_.keep(nodes, block);
}

void KeptFactor::project_inverse(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                                 std::span<float> block) noexcept {
  const std::size_t width = nodes.empty() ? 0 : rows.size() / (3 * nodes.size());
  touch(nodes);
  columns_.begin(panels_, touched_, width);
  for (std::size_t c = 0; c < 3 * nodes.size(); ++c) {
    const std::int32_t p = position_[3 * nodes[c / 3] + static_cast<std::int32_t>(c % 3)];
    for (std::size_t r = 0; p >= 0 && r < width; ++r) columns_.set(panels_, r, p, rows[c * width + r]);
  }
  columns_.square(panels_, block);
}

}  // namespace omentum::physics
