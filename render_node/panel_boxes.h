// The parts of a picture that the panel lies on.
#pragma once

#include <vector>

struct ImDrawData;

namespace omentum::render {

/// Pixels, rows downwards: from `x0`, `y0` up to but without `x1`, `y1`.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// Boxes of which none overlaps another, so that what lies in them can be blended once: those that overlap
/// become the one around both. Without the empty ones.
std::vector<PixelBox> disjoint(std::vector<PixelBox> boxes);

/// Around what each of Dear ImGui's windows draws, within the picture; disjoint.
std::vector<PixelBox> boxes_of(const ImDrawData& drawn);

}  // namespace omentum::render
