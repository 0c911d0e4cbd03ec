// A tube as a renderer draws it: cross-sections of its axis alone; the wall between them is skinned by
// whoever draws (tube_cylinder.h says how).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>

namespace omentum::render {

/// How finely a tube is drawn (Raghupathi 2004, section 5.3): the axis is cut where a mass turns by `eps` or
/// more (geometry/tube_split.h), and each piece has 2^(n+1) sections. Ladder and bounds: tube_resolution.h.
struct TubeResolution {
  double eps = 0.03;
  int n = 2;
  friend bool operator==(const TubeResolution&, const TubeResolution&) = default;
};

/// What a tube costs to draw.
struct TubeCost {
  std::size_t segments = 0;  // pieces between two frames
  std::size_t vertices = 0;
  friend bool operator==(const TubeCost&, const TubeCost&) = default;
};

/// A cross-section of a tube. Directions across: k, and b = t x k. Uploaded as it lies in memory.
struct SkinFrame {
  static constexpr std::size_t kDirections = 8;  // evenly around, from k towards b

  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  // in W, m
  float along = 0;                                   // the gut at rest, m
  Eigen::Vector3f t = Eigen::Vector3f::UnitX();      // along the axis, unit
  float ahead = 0;  // half of the axis' slope here times the next piece's share of u, m
  Eigen::Vector3f k = Eigen::Vector3f::UnitY();  // unit
  float behind = 0;                              // the same of the piece before, m
  float bend_k = 0, bend_b = 0;  // radius times curvature, towards k and b: the tighter side's
  float share = 0;               // of a map's scale (tissue_map.h)
  float turn = 0;                // of the piece behind it: the larger indicator of its masses, 0 to 1
  std::array<float, kDirections> walls{};  // of the wall there: pack_wall()
};
static_assert(sizeof(SkinFrame) == 24 * sizeof(float), "uploaded as it lies in memory");

/// A Vertex' openness and pallor in one number: openness in 255ths before the point, pallor behind it.
/// Attributes of two frames and a corner would be more than the 16 that OpenGL promises otherwise.
/// gl/shaders/tube.vert unpacks them too.
inline constexpr float kWallSteps = 255, kFullPallor = 0.999f;
inline float pack_wall(float openness, float pallor) {
  return std::round(kWallSteps * openness) + kFullPallor * pallor;
}
inline float openness_of(float wall) {
  return std::floor(wall) / kWallSteps;
}
inline float pallor_of(float wall) {
  return (wall - std::floor(wall)) / kFullPallor;
}

/// A tube that a renderer holds.
enum class TubeId : std::uint32_t {};

}  // namespace omentum::render
