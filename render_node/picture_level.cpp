#include "render_node/picture_level.h"

#include <cstdio>

namespace omentum::render {
namespace {

// Evenly spaced, as eq. 15 moves it: from bends of 90 degrees to those of 16 (0.02) between two masses.
constexpr double kCoarsestEps = 0.5, kFinestEps = 0.02;

}  // namespace

double PictureLevel::eps() const {
  const double up = static_cast<double>(step[kIntervals]) / kFinestStep[kIntervals];
  return kCoarsestEps + up * (kFinestEps - kCoarsestEps);
}

std::string words(const PictureLevel& level) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%s, eps %.2f, n %d", means_of(level.quality()).word, level.eps(),
                level.n());
  return text.data();
}

}  // namespace omentum::render
