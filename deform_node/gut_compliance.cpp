#include "deform_node/gut_compliance.h"

#include <algorithm>

namespace omentum::deform {

using geometry::GutSkin;
using geometry::NodeId;

GutCompliance::GutCompliance(const GutSkin& skin, double wall_m_n, std::size_t most_nodes)
    : skin_(skin), wall_m_n_(wall_m_n), place_of_(most_nodes) {
  const std::size_t most_masses = most_nodes * GutSkin::kMostWeights;
  masses_.reserve(most_masses);
  block_.resize(most_masses * most_masses);
}

void GutCompliance::find_masses(std::span<const NodeId> nodes) noexcept {
  masses_.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const GutSkin::Node& node = skin_.node(nodes[i]);
    for (std::size_t k = 0; k < GutSkin::kMostWeights; ++k) {
      place_of_[i][k] = 0;
      if (node.weight[k] == 0) continue;
      const auto found = std::ranges::find(masses_, node.mass[k]);
      place_of_[i][k] = static_cast<std::size_t>(found - masses_.begin());
      if (found == masses_.end()) masses_.push_back(node.mass[k]);
    }
  }
}

double GutCompliance::between(std::span<const NodeId> nodes, std::size_t i, std::size_t j) const noexcept {
  double sum = i == j ? wall_m_n_ : 0;
  for (std::size_t k = 0; k < GutSkin::kMostWeights; ++k)
    for (std::size_t l = 0; l < GutSkin::kMostWeights; ++l)
      sum += skin_.node(nodes[i]).weight[k] * skin_.node(nodes[j]).weight[l] *
             block_[place_of_[i][k] * masses_.size() + place_of_[j][l]];
  return sum;
}

void GutCompliance::find(const physics::GutSystem& gut, std::span<const NodeId> nodes,
                         std::span<float> upper) noexcept {
  find_masses(nodes);
  gut.compliance(masses_, std::span(block_).first(masses_.size() * masses_.size()));
  float* value = upper.data();
  for (std::size_t row = 0; row < 3 * nodes.size(); ++row)
    for (std::size_t column = row; column < 3 * nodes.size(); ++column)
      *value++ = row % 3 == column % 3 ? static_cast<float>(between(nodes, row / 3, column / 3)) : 0.0F;
}

}  // namespace omentum::deform
