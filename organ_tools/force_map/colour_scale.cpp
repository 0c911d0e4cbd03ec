#include "organ_tools/force_map/colour_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omentum::force_map {

namespace {

constexpr std::array<Colour, 9> kViridis{{{0.267f, 0.005f, 0.329f},
                                          {0.278f, 0.175f, 0.483f},
                                          {0.230f, 0.322f, 0.546f},
                                          {0.173f, 0.449f, 0.558f},
                                          {0.128f, 0.567f, 0.551f},
                                          {0.158f, 0.684f, 0.502f},
                                          {0.369f, 0.789f, 0.383f},
                                          {0.678f, 0.864f, 0.190f},
                                          {0.993f, 0.906f, 0.144f}}};

}  // namespace

Colour ColourScale::of(double value) const {
  const double part = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
  const double place = part * (kViridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const auto share = static_cast<float>(place - static_cast<double>(below));
  const Colour &a = kViridis[below], &b = kViridis[below + 1];
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

std::vector<double> ColourScale::ticks() const {
  if (!(high > low)) return {low};
  const double rough = (high - low) / 6, power = std::pow(10, std::floor(std::log10(rough)));
  const double digit = rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10;
  const double step = digit * power;
  std::vector<double> found;
  // a little tolerance, so that an end that is round itself has its number
  const auto first = std::llround(std::ceil(low / step - 1e-9)),
             last = std::llround(std::floor(high / step + 1e-9));
  for (auto tick = first; tick <= last; ++tick) found.push_back(static_cast<double>(tick) * step);
  return found;
}

}  // namespace omentum::force_map
