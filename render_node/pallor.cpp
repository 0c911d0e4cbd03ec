#include "render_node/pallor.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {

float steady_pallor(float pressure_pa) {
  return -std::expm1(-std::max(pressure_pa, 0.0f) / kCapillary_pa);
}

float pallor_after(float pallor, float target, double dt_s) {
  const double left = std::exp(-dt_s / (target > pallor ? kPaling_s : kRefill_s));
  return target + static_cast<float>(left) * (pallor - target);
}

Pallor::Pallor(const MeshData& mesh)
    : pressure_(mesh),
      pale_(std::ranges::any_of(mesh.vertices, [](const Vertex& vertex) { return vertex.pallor > 0; })) {}

bool Pallor::advance(std::span<const Press> presses, double dt_s, std::span<Vertex> vertices) {
  const auto presses_it = [](const Press& press) { return press.force_n > 0; };
  if (std::ranges::any_of(presses, presses_it)) {
    const std::span<const float> pressure_pa = pressure_.under(presses, vertices);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      float& pallor = vertices[v].pallor;
      if (pressure_pa[v] > 0 || pallor > 0)
        pallor = pallor_after(pallor, steady_pallor(pressure_pa[v]), dt_s);
    }
    return pale_ = true;
  }
  if (!pale_) return false;
  const auto left = static_cast<float>(std::exp(-dt_s / kRefill_s));
  float palest = 0;
  for (Vertex& vertex : vertices) palest = std::max(palest, vertex.pallor *= left);
  pale_ = palest > kSeen;
  if (!pale_)
    for (Vertex& vertex : vertices) vertex.pallor = 0;
  return true;
}

}  // namespace omentum::render
