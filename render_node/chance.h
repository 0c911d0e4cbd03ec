// Numbers that look random and follow from others: every process that draws the same thing gets the same.
#pragma once

#include <cstdint>

namespace omentum::render {

/// Mixes all bits into all (splitmix64: Steele, Lea and Flood, OOPSLA 2014).
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// From 0 to below 1; another one for each `use` of the same seed.
constexpr float chance(std::uint64_t seed, std::uint32_t use) {
  constexpr float kStep = 1.0f / (1u << 24);
  return static_cast<float>(mixed(seed + use) >> 40) * kStep;
}

}  // namespace omentum::render
