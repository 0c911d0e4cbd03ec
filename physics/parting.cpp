#include "physics/parting.h"

#include "physics/element_tensors.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;
using geometry::TetId;

Parting::Parting(const geometry::TetraMesh& mesh)
    : links_(mesh.tetrahedra, mesh.positions.size()),
      left_(links_),
      stays_(mesh.tetrahedra.size()),
      is_settled_(mesh.positions.size()) {
  taken_.reserve(stays_.size());
  whole_.reserve(stays_.size());
  piece_.reserve(stays_.size());
  loose_.reserve(is_settled_.size());
}

void Parting::anchor(NodeId n) noexcept {
  if (!is_settled_[n]) loose_.push_back(n);
  is_settled_[n] = true;
}

// All that faces connect with `first` of what goes as a whole.
void Parting::keep_piece(TetId first) noexcept {
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

PartedTetrahedra Parting::part(std::span<const TetId> gone) noexcept {
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
  return {taken_, whole_, loose_};
}

void Parting::settle(std::span<const NodeId> nodes) noexcept {
  for (const NodeId n : nodes) is_settled_[n] = true;
}

void Parting::restore() noexcept {
  for (std::size_t t = 0; t < stays_.size(); ++t)
    if (!left_.has(TetId(t))) left_.put_back(TetId(t));
  std::ranges::fill(stays_, Stay::kNo);
  std::fill(is_settled_.begin(), is_settled_.end(), false);
}

double Parting::sum_around(NodeId n, std::span<const double> each) const noexcept {
  double sum = 0;
  for (const TetId t : links_.around(n))
    if (left_.has(t)) sum += each[static_cast<std::size_t>(t)];
  return sum;
}

double anchor_stiffness(const geometry::TetraMesh& mesh, const MaterialMap& material) {
  double trace = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const ElementTensors K = element_tensors(corners_of(mesh, TetId(t)), material.of(mesh, TetId(t)));
    for (std::size_t j = 0; j < 4; ++j) trace += K[j][j].trace();
  }
  return trace / (3 * static_cast<double>(mesh.positions.size()));
}

}  // namespace omentum::physics
