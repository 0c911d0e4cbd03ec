#include "deform_node/cut_score.h"

#include "geometry/across.h"
#include "geometry/segment_points.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace omentum::deform {
namespace {

// Between two stations of the line, m: finer than any organ's mesh.
constexpr double kStation_m = 2e-3;

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

double tetra_volume(const geometry::TetraMesh& mesh, geometry::TetId t) {
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  const auto& x = mesh.positions;
  return std::abs(geometry::signed_volume(x[a], x[b], x[c], x[d]));
}

std::vector<Vec3> points_along(const std::vector<Vec3>& line) {
  std::vector<Vec3> points{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 way = line[i] - line[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / kStation_m)));
    for (int k = 1; k <= parts; ++k) points.push_back(line[i - 1] + way * k / parts);
  }
  return points;
}

std::size_t nearest_of(const std::vector<Vec3>& positions, const Vec3& x) {
  const auto less = [&](const Vec3& a, const Vec3& b) {
    return (a - x).squaredNorm() < (b - x).squaredNorm();
  };
  return static_cast<std::size_t>(std::ranges::min_element(positions, less) - positions.begin());
}

// The planned line of an organ goes along its surface, m: farther off is another organ, or another unit.
constexpr double kFarFromOrgan_m = 0.02;

void require_near(const scene::Scene& scene, const geometry::TetraMesh& mesh) {
  for (std::size_t i = 0; i < scene.score.planned_line.size(); ++i) {
    const Vec3& p = scene.score.planned_line[i];
    const double away_m = (mesh.positions[NodeId(nearest_of(mesh.positions, p))] - p).norm();
    if (away_m <= kFarFromOrgan_m) continue;
    char text[160];
    std::snprintf(
        text, sizeof text,
        ": score.planned_line: found point %zu %g m away from the nodes of %s, expected at most %g m", i,
        away_m, scene.score.line_of.c_str(), kFarFromOrgan_m);
    throw std::runtime_error(scene.file.string() + text);
  }
}

bool is_gone(const OrganView& organ, std::size_t t) {
  return t / 8 < organ.removed_bits.size() && (organ.removed_bits[t / 8] >> t % 8 & 1) != 0;
}

}  // namespace

CutScore::CutScore(const scene::ScoreSpec& score, const geometry::TetraMesh& mesh,
                   const geometry::Surface& surface)
    : mesh_(mesh) {
  const std::vector<Vec3> places = geometry::surface_positions(mesh, surface),
                          normals = geometry::surface_normals(surface, places);
  for (const Vec3& p : points_along(score.planned_line)) {
    const std::size_t n = nearest_of(places, p);
    stations_.push_back({p, normals[n], surface.node[SurfaceId(n)]});
    now_.push_back(p);
  }
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    outside_.push_back(lies_outside(geometry::TetId(t), score.line_width_m));
}

// Seen along the planned cut both are flat, and a tetrahedron is the shadow of its edges.
bool CutScore::lies_outside(geometry::TetId t, double width_m) const noexcept {
  const auto& corners = mesh_.tetrahedra[t];
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    const Vec3& origin = stations_[i - 1].rest;
    const Vec3& normal = stations_[i].normal;
    const Vec3 end = geometry::across(stations_[i].rest - origin, normal);
    for (const auto& [a, b] : kEdges) {
      const Vec3 from = geometry::across(mesh_.positions[corners[a]] - origin, normal),
                 to = geometry::across(mesh_.positions[corners[b]] - origin, normal);
      const auto pair = geometry::closest_points_of_segments(Vec3::Zero(), end, from, to);
      if (pair.squared_distance <= width_m * width_m) return false;
    }
  }
  return true;
}

double CutScore::aside_m(const Vec3& a, const Vec3& b) const noexcept {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < now_.size(); ++i)
    squared =
        std::min(squared, geometry::closest_points_of_segments(a, b, now_[i - 1], now_[i]).squared_distance);
  return std::sqrt(squared);
}

void CutScore::follow(std::span<const CutStroke> strokes, const OrganView& organ, std::uint32_t tools,
                      double now_s) noexcept {
  if (tools == 0) return;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    now_[i] = stations_[i].rest;
    if (!organ.body_u.empty()) now_[i] += Eigen::Map<const Vec3>(organ.body_u.data() + 3 * stations_[i].node);
  }
  for (const CutStroke& stroke : strokes) {
    const double step_m = (stroke.to[0] + stroke.to[1] - stroke.from[0] - stroke.from[1]).norm() / 2;
    if (step_m == 0 || (tools >> stroke.tool % 32 & 1) == 0) continue;
    const double from_line_m = aside_m(stroke.to[0], stroke.to[1]);
    way_m_ += step_m;
    weighted_m2_ += step_m * from_line_m;
    largest_m_ = std::max(largest_m_, from_line_m);
  }
  if (first_s_ < 0) first_s_ = now_s;
  last_s_ = now_s;
}

void CutScore::reset() noexcept {
  way_m_ = weighted_m2_ = largest_m_ = 0;
  first_s_ = last_s_ = -1;
}

CutFigures CutScore::figures(const OrganView& organ) const {
  CutFigures figures{.way_m = way_m_,
                     .mean_m = way_m_ > 0 ? weighted_m2_ / way_m_ : 0,
                     .largest_m = largest_m_,
                     .seconds = last_s_ - first_s_};
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    if (!is_gone(organ, t)) continue;
    const double volume_m3 = tetra_volume(mesh_, geometry::TetId(t));
    figures.removed_m3 += volume_m3;
    if (outside_[t]) figures.outside_m3 += volume_m3;
  }
  return figures;
}

ScoredCut scored_cut(const scene::Scene& scene, const std::vector<ServedOrgan>& organs) {
  if (scene.score.planned_line.empty()) return {};
  const auto found = std::ranges::find(scene.organs, scene.score.line_of, &scene::OrganSpec::name);
  const auto index = static_cast<std::size_t>(found - scene.organs.begin());
  const organ::Organ& organ = organs[index].source->organ;
  require_near(scene, organ.mesh);
  return {index, std::make_unique<CutScore>(scene.score, organ.mesh, organ.surface)};
}

nlohmann::json to_json(const CutFigures& figures) {
  return {{"way_mm", 1e3 * figures.way_m},           {"mean_mm", 1e3 * figures.mean_m},
          {"largest_mm", 1e3 * figures.largest_m},   {"removed_cm3", 1e6 * figures.removed_m3},
          {"outside_cm3", 1e6 * figures.outside_m3}, {"seconds", figures.seconds}};
}

}  // namespace omentum::deform
