#include "render_node/tissue_map.h"

namespace omentum::render {
namespace {

constexpr std::array<std::string_view, 3> kWords{"off", "strain", "stress"};

}  // namespace

TissueMap next(TissueMap map) {
  return static_cast<TissueMap>((static_cast<std::size_t>(map) + 1) % kWords.size());
}

std::string_view word(TissueMap map) {
  return kWords[static_cast<std::size_t>(map)];
}

double full_stress_pa(double largest_young_pa) {
  return static_cast<double>(kFullStrain) * largest_young_pa;
}

const std::array<Vec3f, kMapColourCount>& map_colours() {
  static const std::array<Vec3f, kMapColourCount> colours{{{0.020f, 0.016f, 0.105f},
                                                           {0.040f, 0.100f, 0.270f},
                                                           {0.020f, 0.270f, 0.240f},
                                                           {0.330f, 0.440f, 0.060f},
                                                           {0.900f, 0.660f, 0.040f}}};
  return colours;
}

}  // namespace omentum::render
