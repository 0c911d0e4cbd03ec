#include "render_node/tube_pallor.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr std::size_t kAround = SkinFrame::kDirections;

// A place that is half of the way is on both sides of it.
constexpr double kHalfWay = 1e-9;

}  // namespace

TubePallor::TubePallor(std::span<const geometry::TubeFrame> stations, double radius_m)
    : radius_m_(static_cast<float>(radius_m)), mesh_(wall_of(stations, radius_m_)), pallor_(mesh_) {}

MeshData TubePallor::wall_of(std::span<const geometry::TubeFrame> stations, float radius_m) {
  geometry::require(stations.size() >= 2, "a wall between two stations");
  MeshData mesh;
  mesh.vertices.resize(kAround * stations.size());
  place(stations, radius_m, mesh.vertices);
  for (Vertex& vertex : mesh.vertices) vertex.rest = vertex.position;
  for (std::size_t s = 0; s + 1 < stations.size(); ++s) {
    for (std::size_t d = 0; d < kAround; ++d) {
      const auto vertex = [&](std::size_t station, std::size_t direction) {
        return static_cast<std::uint32_t>(kAround * station + direction % kAround);
      };
      mesh.triangles.push_back({vertex(s, d), vertex(s, d + 1), vertex(s + 1, d + 1)});
      mesh.triangles.push_back({vertex(s, d), vertex(s + 1, d + 1), vertex(s + 1, d)});
    }
  }
  return mesh;
}

void TubePallor::place(std::span<const geometry::TubeFrame> stations, float radius_m,
                       std::span<Vertex> vertices) {
  for (std::size_t d = 0; d < kAround; ++d) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(d) / kAround;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (std::size_t s = 0; s < stations.size(); ++s) {
      Vertex& vertex = vertices[kAround * s + d];
      vertex.normal = (cosine * stations[s].k + sine * stations[s].b).cast<float>();
      vertex.position = stations[s].origin.cast<float>() + radius_m * vertex.normal;
    }
  }
}

bool TubePallor::advance(std::span<const Press> presses, double dt_s,
                         std::span<const geometry::TubeFrame> stations) {
  geometry::require(kAround * stations.size() == mesh_.vertices.size(), "as many stations as at rest");
  if (!presses.empty()) place(stations, radius_m_, mesh_.vertices);
  if (!pallor_.advance(presses, dt_s, mesh_.vertices)) return false;
  pale_ = is_pale(0, stations.size() - 1);
  return true;
}

bool TubePallor::is_pale(std::size_t first, std::size_t last) const {
  const auto between = std::span(mesh_.vertices).subspan(kAround * first, kAround * (last - first + 1));
  return std::ranges::any_of(between, [](const Vertex& vertex) { return vertex.pallor > 0; });
}

std::array<float, SkinFrame::kDirections> TubePallor::at(double station, double before, double after) const {
  std::array<float, kAround> palest{};
  if (!pale_) return palest;
  const std::size_t last = mesh_.vertices.size() / kAround - 1;
  const auto count = [&](double s, std::size_t d) {
    const auto low = std::min(static_cast<std::size_t>(s), last - 1);
    const auto share = static_cast<float>(s - static_cast<double>(low));
    const float pallor = std::lerp(mesh_.vertices[kAround * low + d].pallor,
                                   mesh_.vertices[kAround * (low + 1) + d].pallor, share);
    palest[d] = std::max(palest[d], pallor);
  };
  const double from = (before + station) / 2 - kHalfWay, to = (station + after) / 2 + kHalfWay;
  for (std::size_t d = 0; d < kAround; ++d) {
    count(station, d);
    for (double s = std::max(0.0, std::ceil(from)); s <= std::min(to, static_cast<double>(last)); ++s)
      count(s, d);
  }
  return palest;
}

}  // namespace omentum::render
