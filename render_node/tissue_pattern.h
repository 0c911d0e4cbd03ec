// The mottling and grain of an organ's capsule: a smooth noise that repeats without a seam.
#pragma once

#include <cstdint>
#include <vector>

namespace omentum::render {

/// A cube of side^3 texels, x fastest; four bytes each: the gradient of the noise (128 is none) and its
/// value. Three octaves of gradient noise (Perlin 1985) on periodic lattices, always the same.
struct TissuePattern {
  int side = 0;
  std::vector<std::uint8_t> texels;
};
TissuePattern make_tissue_pattern(int side);

}  // namespace omentum::render
