#include "render_node/enlarge.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace omentum::render {
namespace {

constexpr int kBytes = 4;    // of a pixel
constexpr int kWhole = 256;  // weights are shares of it

std::uint8_t mix(std::uint8_t a, std::uint8_t b, int weight_of_b) {
  return static_cast<std::uint8_t>((a * (kWhole - weight_of_b) + b * weight_of_b) >> 8);
}

// Plain pointers: the compiler makes vectors of this.
void mix_rows(std::span<const std::uint8_t> above, std::span<const std::uint8_t> below, int weight_of_below,
              std::span<std::uint8_t> to) {
  const std::uint8_t* a = above.data();
  const std::uint8_t* b = below.data();
  std::uint8_t* out = to.data();
  const auto wa = static_cast<std::uint16_t>(kWhole - weight_of_below);
  const auto wb = static_cast<std::uint16_t>(weight_of_below);
  for (std::size_t k = 0; k < to.size(); ++k)
    out[k] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(a[k] * wa + b[k] * wb) >> 8);
}

// Where the middle of pixel `at` of the large picture lies between two of the small one.
EnlargedPlace place_of(int at, int factor) {
  const int twice = 2 * at + 1 - factor;  // over 2 factor: pixels of the small picture
  if (twice < 0) return {0, 0};
  return {twice / (2 * factor), kWhole * (twice % (2 * factor)) / (2 * factor)};
}

}  // namespace

void Enlarger::widen(std::span<const std::uint8_t> row, std::span<std::uint8_t> to) const {
  const int last = static_cast<int>(row.size()) / kBytes - 1;
  std::uint8_t* out = to.data();
  for (const auto& [first, weight] : places_) {
    const std::uint8_t* a = row.data() + kBytes * std::min(first, last);
    const std::uint8_t* b = row.data() + kBytes * std::min(first + 1, last);
    for (int c = 0; c < kBytes; ++c) out[c] = mix(a[c], b[c], weight);
    out += kBytes;
  }
}

void Enlarger::enlarge(std::span<const std::uint8_t> from, Size size, int factor, std::span<std::uint8_t> to,
                       Size target) {
  const std::size_t row = static_cast<std::size_t>(kBytes * size.width);
  const std::size_t wide = static_cast<std::size_t>(kBytes * target.width);
  above_.resize(wide);
  below_.resize(wide);
  places_.clear();
  for (int x = 0; x < target.width; ++x) places_.push_back(place_of(x, factor));
  int held = -2;  // the source's row that above_ is; below_ is the next one
  const auto widen_row = [&](int y, std::vector<std::uint8_t>& into) {
    widen(from.subspan(row * static_cast<std::size_t>(std::min(y, size.height - 1)), row), into);
  };
  for (int y = 0; y < target.height; ++y) {
    const auto [first, weight] = place_of(y, factor);
    if (first == held + 1) {
      std::swap(above_, below_);
      widen_row(first + 1, below_);
    } else if (first != held) {
      widen_row(first, above_);
      widen_row(first + 1, below_);
    }
    held = first;
    mix_rows(above_, below_, weight, to.subspan(wide * static_cast<std::size_t>(y), wide));
  }
}

}  // namespace omentum::render
