#include "physics/static_factor.h"

#include "physics/element_tensors.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;
using geometry::TetId;

namespace {

const geometry::TetraMesh& held(const geometry::TetraMesh& mesh, const FixedComponents& fixed) {
  require_held(mesh, fixed);
  return mesh;
}

// Of K, N/m.
double mean_diagonal(const geometry::TetraMesh& mesh, const MaterialMap& material) {
  double trace = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const ElementTensors K = element_tensors(corners_of(mesh, TetId(t)), material.of(mesh, TetId(t)));
    for (std::size_t j = 0; j < 4; ++j) trace += K[j][j].trace();
  }
  return trace / (3 * static_cast<double>(mesh.positions.size()));
}

}  // namespace

StaticFactor::StaticFactor(const geometry::TetraMesh& mesh, const MaterialMap& material,
                           const FixedComponents& fixed, int most_compliance_nodes)
    : links_(held(mesh, fixed).tetrahedra, mesh.positions.size()),
      left_(links_),
      anchor_n_m_(mean_diagonal(mesh, material)),
      kept_(mesh, material, fixed, std::vector<double>(mesh.positions.size()), {1, 1}, most_compliance_nodes),
      stays_(mesh.tetrahedra.size()),
      residual_(3 * mesh.positions.size()),
      correction_(residual_.size()),
      is_settled_(mesh.positions.size()) {
  taken_.reserve(stays_.size());
  whole_.reserve(stays_.size());
  piece_.reserve(stays_.size());
  loose_.reserve(is_settled_.size());
}

void StaticFactor::anchor(NodeId n) noexcept {
  if (!is_settled_[n]) loose_.push_back(n);
  is_settled_[n] = true;
}

// All that faces connect with `first` of what goes as a whole.
void StaticFactor::keep_piece(TetId first) noexcept {
  for (const NodeId n : links_.nodes(first)) anchor(n);
  piece_.assign(1, first);
  stays_[first] = Stay::kYes;
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    for (const NodeId n : links_.nodes(piece_[i])) is_settled_[n] = true;
    for (const TetId t : links_.across(piece_[i])) {
      if (!t.valid() || stays_[t] != Stay::kFound) continue;
      stays_[t] = Stay::kYes;
      piece_.push_back(t);
    }
  }
}

void StaticFactor::part(std::span<const TetId> gone) noexcept {
  const auto is_used = [&](NodeId n) { return left_.uses(n) > 0; };
  for (const TetId t : gone) left_.take(t);
  taken_.clear();
  whole_.clear();
  loose_.clear();
  for (const TetId t : gone) {
    const bool is_tied = std::ranges::any_of(links_.nodes(t), is_used);
    (is_tied ? taken_ : whole_).push_back(t);
    if (!is_tied) stays_[t] = Stay::kFound;
  }
  for (const TetId t : whole_)
    if (stays_[t] == Stay::kFound) keep_piece(t);
  for (const TetId t : taken_)
    for (const NodeId n : links_.nodes(t))
      if (!is_used(n)) anchor(n);
}

bool StaticFactor::remove(std::span<const TetId> tetrahedra) noexcept {
  part(tetrahedra);
  // anchors first: then nothing on the way is singular
  const bool is_anchored = kept_.add_mass(loose_, anchor_n_m_);
  return kept_.remove(taken_) && is_anchored;
}

bool StaticFactor::hold(std::span<const NodeId> nodes) noexcept {
  for (const NodeId n : nodes) is_settled_[n] = true;
  return kept_.add_mass(nodes, anchor_n_m_);
}

void StaticFactor::solve_exactly(std::span<const double> f, std::span<double> u) noexcept {
  kept_.solve(f, u);
  kept_.multiply(u, residual_);
  for (std::size_t c = 0; c < f.size(); ++c) residual_[c] = is_held(c) ? 0 : f[c] - residual_[c];
  kept_.solve(residual_, correction_);
  for (std::size_t c = 0; c < f.size(); ++c) u[c] += correction_[c];
}

void StaticFactor::restore() noexcept {
  kept_.restore();
  for (std::size_t t = 0; t < stays_.size(); ++t)
    if (!left_.has(TetId(t))) left_.put_back(TetId(t));
  std::ranges::fill(stays_, Stay::kNo);
  std::fill(is_settled_.begin(), is_settled_.end(), false);
}

}  // namespace omentum::physics
