#include "organ_tools/phantom/implicit_shape.h"

#include <algorithm>
#include <cmath>

namespace omentum::phantom {

double ellipsoid_distance(const Ellipsoid& e, const Vec3& p) {
  const Vec3 q = (p - e.centre).cwiseQuotient(e.radii);
  const double level = q.norm();
  const double slope = q.cwiseQuotient(e.radii).norm();
  return slope > 0 ? level * (level - 1) / slope : -e.radii.minCoeff();
}

double blended_min(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * width / 4;
}

double blended_max(double a, double b, double width) {
  return -blended_min(-a, -b, width);
}

}  // namespace omentum::phantom
