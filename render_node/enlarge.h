// Small pictures over a large one, on the processor.
#pragma once

#include "render_node/renderer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::render {

/// Between which pixels of a small picture's row or column one of the large one lies, and how far, of 256.
struct EnlargedPlace {
  int first = 0, weight_of_next = 0;
};

/// Enlarges pictures of four bytes per pixel by a whole factor, smoothly: straight lines between the middles
/// of neighbouring pixels, their last ones held at the edges. Mesa's rasterizer takes twice as long for the
/// same (docs/rendering.md). Keeps its scratch. One thread.
class Enlarger {
 public:
  /// `from`: [height * width * 4] of `size`; `to`: [target.height * target.width * 4], of at least one pixel
  /// and at most about `factor` times the size: what lies beyond is held.
  void enlarge(std::span<const std::uint8_t> from, Size size, int factor, std::span<std::uint8_t> to,
               Size target);

 private:
  void widen(std::span<const std::uint8_t> row, std::span<std::uint8_t> to) const;

  std::vector<EnlargedPlace> places_;        // of each column
  std::vector<std::uint8_t> above_, below_;  // rows of the source, widened
};

}  // namespace omentum::render
