// Small pictures over a large one.
#include "render_node/enlarge.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

std::vector<std::uint8_t> enlarged(const std::vector<std::uint8_t>& from, Size size, int factor,
                                   Size target) {
  std::vector<std::uint8_t> to(static_cast<std::size_t>(4 * target.width * target.height));
  Enlarger enlarger;
  enlarger.enlarge(from, size, factor, to, target);
  return to;
}

// Red grows to the right, green downwards.
std::vector<std::uint8_t> slope(Size size, int per_pixel) {
  std::vector<std::uint8_t> picture;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (const int c : {per_pixel * x, per_pixel * y, 7, 255})
        picture.push_back(static_cast<std::uint8_t>(c));
  return picture;
}

TEST(Enlarger, ASlopeStaysASlope) {
  for (const int factor : {2, 3}) {
    const Size size{8, 6}, target{factor * size.width, factor * size.height};
    const auto to = enlarged(slope(size, 6 * factor), size, factor, target);
    for (int y = factor; y < target.height - factor; ++y) {
      for (int x = factor; x < target.width - factor; ++x) {
        const std::uint8_t* p = &to[static_cast<std::size_t>(4 * (y * target.width + x))];
        // the middle of the pixel, 6 per pixel of the large picture; rounded down twice
        EXPECT_NEAR(p[0], 6 * (x + 0.5 - 0.5 * factor), 1.6) << x;
        EXPECT_NEAR(p[1], 6 * (y + 0.5 - 0.5 * factor), 1.6) << y;
        EXPECT_EQ(p[2], 7);
        EXPECT_EQ(p[3], 255);
      }
    }
  }
}

TEST(Enlarger, HoldsTheLastPixelsWhereTheFactorLeavesARest) {
  const Size size{3, 2}, target{8, 5};  // 8 = 2 * 3 + 2
  const auto to = enlarged(slope(size, 50), size, 2, target);
  EXPECT_EQ(to[0], 0);
  EXPECT_EQ(to[4 * 7], 100);
  EXPECT_EQ(to[static_cast<std::size_t>(4 * 8 * 4 + 1)], 50);
}

TEST(Enlarger, FactorOneIsACopy) {
  const Size size{5, 4};
  EXPECT_EQ(enlarged(slope(size, 9), size, 1, size), slope(size, 9));
}

}  // namespace
}  // namespace omentum::render
