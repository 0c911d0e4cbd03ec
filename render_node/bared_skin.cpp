#include "render_node/bared_skin.h"

#include "render_node/surface_shading.h"

#include <algorithm>
#include <limits>
#include <set>

namespace omentum::render {
namespace {

using geometry::SurfaceId;
using geometry::Triangle;
using Edge = std::pair<std::int32_t, std::int32_t>;

// Those that have one triangle only: on their other side is skin.
std::set<Edge> open_edges(std::span<const Triangle> triangles) {
  std::set<Edge> open;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge edge = std::minmax<std::int32_t>(t[c], t[(c + 1) % 3]);
      if (const auto [place, first] = open.insert(edge); !first) open.erase(place);
    }
  }
  return open;
}

}  // namespace

BaredSkin::BaredSkin(std::vector<Triangle> bared, std::span<const Vec3f> rest, int level)
    : triangles_(std::move(bared)) {
  number_nodes(rest.size());
  positions_.resize(node_.size());
  normals_.assign(node_.size(), Vec3f::UnitZ());
  around_.resize(node_.size());
  openness_.resize(node_.size());
  reach_.resize(node_.size());
  refinement_ = SurfaceRefinement(own_, static_cast<std::int32_t>(node_.size()), level);
  find_rim();
  mesh_.triangles = refinement_.triangles();
  mesh_.vertices.resize(refinement_.vertex_count());
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    const auto& [node, weight] = refinement_.places()[i];
    Vec3f& at = mesh_.vertices[i].rest;
    at = Vec3f::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      at += weight[static_cast<int>(c)] * rest[node_[static_cast<std::size_t>(node[c])]];
  }
}

void BaredSkin::number_nodes(std::size_t node_count) {
  std::vector<SurfaceId> own(node_count);
  for (const Triangle& t : triangles_) {
    Triangle& numbered = own_.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      SurfaceId& place = own[static_cast<std::size_t>(t[c])];
      if (!place.valid()) {
        place = SurfaceId(node_.size());
        node_.push_back(t[c]);
      }
      numbered[c] = place;
    }
  }
}

void BaredSkin::find_rim() {
  const std::set<Edge> open = open_edges(own_);
  const auto& places = refinement_.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<std::int32_t> ends;  // of the edge that it lies on
    for (int c = 0; c < 3; ++c)
      if (places[i].weight[c] > 0) ends.push_back(places[i].node[c]);
    if (ends.size() == 2 && open.contains(std::minmax(ends[0], ends[1]))) rim_.push_back(i);
  }

  std::vector<bool> on_rim(node_.size(), false);
  for (const auto& [a, b] : open) {
    on_rim[static_cast<std::size_t>(a)] = on_rim[static_cast<std::size_t>(b)] = true;
    pulls_.push_back({a, b});
    pulls_.push_back({b, a});
  }
  for (const Triangle& t : own_) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (const SurfaceId other : {t[(c + 1) % 3], t[(c + 2) % 3]})
        if (!on_rim[static_cast<std::size_t>(t[c])]) pulls_.push_back({t[c], other});
    }
  }
  pull_count_.assign(node_.size(), 0);
  for (const auto& [drawn, to] : pulls_) ++pull_count_[static_cast<std::size_t>(drawn)];
}

void BaredSkin::relax(std::span<Vec3f> positions) {
  for (std::size_t b = 0; b < node_.size(); ++b)
    positions_[b] = positions[static_cast<std::size_t>(node_[b])];
  find_reach();
  const std::vector<Vec3f> start = positions_;
  std::vector<Vec3f>& sum = around_;  // free until deform()
  for (int k = 0; k < kRelaxations; ++k) {
    std::fill(sum.begin(), sum.end(), Vec3f::Zero());
    for (const auto& [drawn, to] : pulls_)
      sum[static_cast<std::size_t>(drawn)] += positions_[static_cast<std::size_t>(to)];
    for (std::size_t b = 0; b < node_.size(); ++b)
      if (pull_count_[b] > 0) positions_[b] = 0.5f * (positions_[b] + sum[b] / pull_count_[b]);
  }
  for (std::size_t b = 0; b < node_.size(); ++b) {
    const Vec3f moved = positions_[b] - start[b];
    const float share = std::min(1.0f, reach_[b] / std::max(moved.norm(), std::numeric_limits<float>::min()));
    positions[static_cast<std::size_t>(node_[b])] = start[b] + share * moved;
  }
}

void BaredSkin::find_reach() {
  std::fill(reach_.begin(), reach_.end(), 0.0f);
  for (const auto& [drawn, to] : pulls_) {
    const auto d = static_cast<std::size_t>(drawn);
    reach_[d] +=
        kMostMoved / pull_count_[d] * (positions_[static_cast<std::size_t>(to)] - positions_[d]).norm();
  }
}

void BaredSkin::spread(std::span<const float> of_nodes, float Vertex::*field) {
  std::vector<float> own;
  for (const SurfaceId s : node_) own.push_back(of_nodes[static_cast<std::size_t>(s)]);
  refinement_.spread(own, field, mesh_.vertices);
}

void BaredSkin::deform(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                       std::span<const float> openness) {
  for (std::size_t b = 0; b < node_.size(); ++b) {
    const auto s = static_cast<std::size_t>(node_[b]);
    positions_[b] = positions[s];
    around_[b] = normals[s];
    openness_[b] = openness[s];
  }
  smooth_normals(own_, positions_, normals_);
  refinement_.apply(positions_, normals_, openness_, mesh_.vertices);
  for (const std::size_t i : rim_) mesh_.vertices[i].position = refinement_.curved(i, positions_, around_);
}

}  // namespace omentum::render
