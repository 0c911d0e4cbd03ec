#include "render_node/surface_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace omentum::render {
namespace {

constexpr float kCurvature = 0.75f;         // alpha: the value that its authors recommend
constexpr double kDrawnTriangles = 16'000;  // about 3 ms of vertex work for software OpenGL on one core
constexpr int kFinestLevel = 4;             // finer is smaller than a pixel for a 1,500-triangle liver

// Numbers the vertices of one triangle's grid, sharing corners and edges with its neighbours.
class GridNumbering {
 public:
  GridNumbering(std::int32_t node_count, int level)
      : level_(level), next_(static_cast<std::uint32_t>(node_count)) {}

  // Grid point (i, j, level - i - j), in units of 1/level, of triangle `t`; `fresh` says that it is new.
  std::uint32_t number(const std::array<std::int32_t, 3>& t, const std::array<int, 3>& w, bool& fresh) {
    fresh = false;
    for (int c = 0; c < 3; ++c) {
      if (w[c] == level_) return static_cast<std::uint32_t>(t[c]);
    }
    for (int c = 0; c < 3; ++c) {
      if (w[c] == 0) return on_edge(t[(c + 1) % 3], t[(c + 2) % 3], w[(c + 1) % 3], fresh);
    }
    fresh = true;
    return next_++;
  }

 private:
  std::uint32_t on_edge(std::int32_t a, std::int32_t b, int weight_of_a, bool& fresh) {
    if (a > b) std::swap(a, b), weight_of_a = level_ - weight_of_a;
    const auto [place, inserted] = edges_.try_emplace({a, b, weight_of_a}, next_);
    fresh = inserted;
    if (inserted) ++next_;
    return place->second;
  }

  int level_;
  std::uint32_t next_;
  std::map<std::array<std::int32_t, 3>, std::uint32_t> edges_;
};

}  // namespace

SurfaceRefinement::SurfaceRefinement(std::span<const geometry::Triangle> triangles, std::int32_t node_count,
                                     int level)
    : node_count_(static_cast<std::size_t>(node_count)) {
  for (std::int32_t s = 0; s < node_count; ++s) places_.push_back({{s, s, s}, Vec3f::UnitX()});
  GridNumbering numbering(node_count, level);
  std::vector<std::uint32_t> grid(static_cast<std::size_t>((level + 1) * (level + 1)));
  const auto at = [&](int i, int j) -> std::uint32_t& {
    return grid[static_cast<std::size_t>(i * (level + 1) + j)];
  };

  for (const auto& triangle : triangles) {
    const std::array<std::int32_t, 3> t{triangle[0], triangle[1], triangle[2]};
    for (int i = 0; i <= level; ++i) {
      for (int j = 0; i + j <= level; ++j) {
        const std::array<int, 3> w{level - i - j, i, j};
        bool fresh = false;
        at(i, j) = numbering.number(t, w, fresh);
        if (fresh) places_.push_back({t, Vec3f(w[0], w[1], w[2]) / static_cast<float>(level)});
      }
    }
    // small triangles of the same orientation, and the ones between them
    for (int i = 0; i < level; ++i) {
      for (int j = 0; i + j < level; ++j) {
        triangles_.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < level) triangles_.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
}

Vec3f SurfaceRefinement::curved(std::size_t vertex, std::span<const Vec3f> positions,
                                std::span<const Vec3f> normals) const {
  return curved(places_[vertex], positions, normals);
}

Vec3f SurfaceRefinement::curved(const Place& v, std::span<const Vec3f> positions,
                                std::span<const Vec3f> normals) {
  Vec3f flat = Vec3f::Zero();
  for (int c = 0; c < 3; ++c) flat += v.weight[c] * positions[v.node[c]];
  Vec3f offset = Vec3f::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vec3f& n = normals[v.node[c]];
    offset -= v.weight[c] * (flat - positions[v.node[c]]).dot(n) * n;
  }
  return flat + kCurvature * offset;
}

void SurfaceRefinement::curve(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                              std::span<Vec3f> out) const {
  for (std::size_t i = 0; i < places_.size(); ++i) out[i] = curved(i, positions, normals);
}

void SurfaceRefinement::apply(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                              std::span<const float> openness, std::span<Vertex> out) const {
  for (std::size_t s = 0; s < node_count_; ++s) {
    out[s].position = positions[s];
    out[s].normal = normals[s];
    out[s].openness = openness[s];
  }
  for (std::size_t i = node_count_; i < places_.size(); ++i) {
    const Place& v = places_[i];
    out[i].position = curved(i, positions, normals);
    Vec3f normal = Vec3f::Zero();
    out[i].openness = 0;
    for (int c = 0; c < 3; ++c) {
      normal += v.weight[c] * normals[v.node[c]];
      out[i].openness += v.weight[c] * openness[v.node[c]];
    }
    const float length = normal.norm();
    out[i].normal = length > 0 ? Vec3f(normal / length) : normals[v.node[0]];
  }
}

void SurfaceRefinement::spread(std::span<const float> of_nodes, float Vertex::*field,
                               std::span<Vertex> out) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto& [node, weight] = places_[i];
    out[i].*field = 0;
    for (int c = 0; c < 3; ++c) out[i].*field += weight[c] * of_nodes[static_cast<std::size_t>(node[c])];
  }
}

int refinement_level(std::size_t triangle_count) {
  const double level =
      std::sqrt(kDrawnTriangles / static_cast<double>(std::max<std::size_t>(triangle_count, 1)));
  return std::clamp(static_cast<int>(level), 1, kFinestLevel);
}

}  // namespace omentum::render
