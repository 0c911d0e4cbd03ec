#include "organ_tools/phantom/colon_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace omentum::phantom {
namespace {

// Metres. An adult's colon is 1.5 m long and lies in more bends; the frame around the small bowel is what an
// exercise needs.
constexpr double kLevel = -0.180;  // z
constexpr double kRadius = 0.0230, kCaecumRadius = 0.0270;
constexpr double kCaecumLength = 0.06;
constexpr double kPouch = 0.045;        // length of one
constexpr double kPouchDepth = 0.0020;  // of the crease between two, about the mean radius
constexpr int kPiecesPerSpan = 10;      // of the axis, between two of the places below

// x and y of places that the axis goes through.
constexpr std::array<std::array<double, 2>, 13> kPlaces{{{-0.125, -0.385},
                                                         {-0.132, -0.310},
                                                         {-0.132, -0.230},
                                                         {-0.122, -0.155},
                                                         {-0.070, -0.150},
                                                         {0.000, -0.175},
                                                         {0.070, -0.150},
                                                         {0.122, -0.145},
                                                         {0.134, -0.220},
                                                         {0.134, -0.300},
                                                         {0.122, -0.370},
                                                         {0.070, -0.395},
                                                         {0.015, -0.370}}};

Vec3 place(std::ptrdiff_t i) {
  const auto& [x, y] =
      kPlaces[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, kPlaces.size() - 1))];
  return {x, y, kLevel};
}

// From place i (t = 0) to the next (t = 1), towards where its neighbours lie (Catmull and Rom 1974).
Vec3 on_spline(std::ptrdiff_t i, double t) {
  const Vec3 a = place(i), b = place(i + 1);
  const Vec3 from = (b - place(i - 1)) / 2, to = (place(i + 2) - a) / 2;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * from + (3 * t2 - 2 * t3) * b + (t3 - t2) * to;
}

std::vector<Vec3> make_axis() {
  std::vector<Vec3> axis{place(0)};
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(kPlaces); ++i)
    for (int k = 1; k <= kPiecesPerSpan; ++k)
      axis.push_back(on_spline(i, static_cast<double>(k) / kPiecesPerSpan));
  return axis;
}

// At the length s from the caecum's end, m.
double radius_at(double s) {
  const double caecum = std::max(0.0, 1 - s / kCaecumLength);
  return kRadius + (kCaecumRadius - kRadius) * caecum * (2 - caecum) -
         kPouchDepth * std::cos(2 * std::numbers::pi * s / kPouch);
}

}  // namespace

const std::vector<Vec3>& colon_axis() {
  static const std::vector<Vec3> axis = make_axis();
  return axis;
}

double colon_distance(const Vec3& p) {
  const std::vector<Vec3>& axis = colon_axis();
  double nearest = std::numeric_limits<double>::infinity(), at = 0, s = 0;
  for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
    const Vec3 piece = axis[i + 1] - axis[i];
    const double length = piece.norm();
    const double along = std::clamp((p - axis[i]).dot(piece) / length, 0.0, length);
    const double distance = (p - axis[i] - along / length * piece).norm();
    if (distance < nearest) nearest = distance, at = s + along;
    s += length;
  }
  return nearest - radius_at(at);
}

ImplicitShape colon() {
  return {"colon", colon_distance, {{-0.170, -0.430, -0.215}, {0.170, -0.100, -0.145}}};
}

}  // namespace omentum::phantom
