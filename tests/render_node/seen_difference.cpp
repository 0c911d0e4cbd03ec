#include "seen_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace omentum::render::test {
namespace {

constexpr int kBlurReach = 1;  // pixels to each side

double linear_of(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double lab_root(double t) {
  constexpr double kKnee = 6.0 / 29;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0 / 29;
}

// CIE 15, of linear sRGB under D65.
Eigen::Vector3d lab_of(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d xyz_from_rgb;
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d white(0.9505, 1, 1.089);
  const Eigen::Vector3d f = (xyz_from_rgb * rgb).cwiseQuotient(white).unaryExpr(&lab_root);
  return {116 * f.y() - 16, 500 * (f.x() - f.y()), 200 * (f.y() - f.z())};
}

Eigen::Vector3d blurred_at(const Picture& picture, int column, int row) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy)
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx) {
      const int x = std::clamp(column + dx, 0, picture.size.width - 1);
      const int y = std::clamp(row + dy, 0, picture.size.height - 1);
      const auto byte = 4 * static_cast<std::size_t>(y * picture.size.width + x);
      for (int c = 0; c < 3; ++c) sum[c] += linear_of(picture.rgba[byte + static_cast<std::size_t>(c)]);
    }
  return sum / ((2 * kBlurReach + 1) * (2 * kBlurReach + 1));
}

}  // namespace

SeenDifference seen_difference_of(const Picture& a, const Picture& b) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (a.size != b.size || a.rgba.empty()) return {kNever, kNever};
  std::vector<double> all;
  for (int y = 0; y < a.size.height; ++y)
    for (int x = 0; x < a.size.width; ++x)
      all.push_back((lab_of(blurred_at(a, x, y)) - lab_of(blurred_at(b, x, y))).norm());
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  const auto worst = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
  std::ranges::nth_element(all, worst);
  return {mean, *worst};
}

}  // namespace omentum::render::test
