#include "organ_tools/phantom/implicit_shape.h"

#include <algorithm>
#include <cmath>

namespace omentum::phantom {

double blended_min(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * width / 4;
}

double blended_max(double a, double b, double width) {
  return -blended_min(-a, -b, width);
}

}  // namespace omentum::phantom
