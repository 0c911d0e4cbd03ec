#include "physics/dynamics/factor_panels.h"

#include "physics/dynamics/flush_tiny.h"

#include <algorithm>

namespace omentum::physics {

namespace {

using kernels::kTileRows;

std::int32_t tiles_of(std::int32_t rows) {
  return (rows + kTileRows - 1) / kTileRows;
}

}  // namespace

FactorPanels::FactorPanels(const Supernodes& factor)
    : supernode_of_(factor.size), pivots_(factor.size), inverse_pivots_(factor.size) {
  lay_out(factor);
  for (std::int32_t s = 0; s < factor.count; ++s) {
    fill(supernodes_[s], factor.panel(s));
    refresh(supernodes_[s]);
  }
}

void FactorPanels::lay_out(const Supernodes& factor) {
  std::int64_t column = 0;
  for (std::int32_t s = 0; s < factor.count; ++s) {
    const std::int32_t width = factor.width(s), height = factor.height(s);
    supernodes_.push_back({factor.first_column[s], width, height, static_cast<std::int32_t>(rows_.size()),
                           static_cast<std::int32_t>(strips_.size()), -1});
    std::fill_n(supernode_of_.begin() + factor.first_column[s], width, s);
    const auto below = factor.rows_below(s);
    rows_.insert(rows_.end(), below.begin(), below.end());
    for (std::int32_t first = 0; first < width; first += kTileRows) {
      const Strip strip{column, std::min(kTileRows, width - first), tiles_of(height - first)};
      column += static_cast<std::int64_t>(strip.width) * strip.tiles;
      strips_.push_back(strip);
    }
    most_rows_ = std::max(most_rows_, kTileRows * tiles_of(height));
  }
  for (Supernode& s : supernodes_) {
    if (s.height > s.width) s.parent = supernode_of_[rows_[s.rows]];
  }
  high_.resize(column);
  low_.resize(column);
  inverses_.resize(strips_.size());
}

// With l the diagonal of CHOLMOD's factor, D = l^2 and the columns are divided by it.
void FactorPanels::fill(const Supernode& s, const double* panel) {
  for (std::int32_t c = 0; c < s.width; ++c) {
    const double* column = panel + static_cast<std::ptrdiff_t>(c) * s.height;
    pivots_[s.first + c] = column[c] * column[c];
    const Strip& strip = strips(s)[c / kTileRows];
    const std::int32_t first = c / kTileRows * kTileRows;
    for (std::int32_t row = c + 1; row < s.height; ++row) {
      const std::int64_t at = strip.column + (row - first) / kTileRows * strip.width + c - first;
      const std::int32_t lane = (row - first) % kTileRows;
      const double value = column[row] / column[c];
      kernels::split(&value, 1, {high_[at].value + lane, low_[at].value + lane});
    }
  }
}

void FactorPanels::refresh(const Supernode& s) noexcept {
  std::int32_t index = s.strip;
  for (const Strip& strip : strips(s)) {
    Inverses& inverses = inverses_[index++];
    kernels::invert_diagonal(high_[strip.column].value, low_[strip.column].value, strip.width,
                             inverses.plain.value, inverses.transposed.value);
  }
  for (std::int32_t p = s.first; p < s.first + s.width; ++p)
    inverse_pivots_[p] = static_cast<float>(1 / pivots_[p]);
}

void FactorPanels::copy(const Supernode& s, const FactorPanels& from) noexcept {
  const std::span<const Strip> all = strips(s);
  const std::int64_t first = all.front().column;
  const std::int64_t last =
      all.back().column + static_cast<std::int64_t>(all.back().width) * all.back().tiles;
  std::copy(from.high_.begin() + first, from.high_.begin() + last, high_.begin() + first);
  std::copy(from.low_.begin() + first, from.low_.begin() + last, low_.begin() + first);
  std::copy_n(from.inverses_.begin() + s.strip, all.size(), inverses_.begin() + s.strip);
  std::copy_n(from.pivots_.begin() + s.first, s.width, pivots_.begin() + s.first);
  std::copy_n(from.inverse_pivots_.begin() + s.first, s.width, inverse_pivots_.begin() + s.first);
}

void FactorPanels::forward(const Supernode& s, float* x, float* scratch) const noexcept {
  std::copy_n(x + s.first, s.width, scratch);
  std::fill(scratch + s.width, scratch + static_cast<std::ptrdiff_t>(kTileRows) * tiles_of(s.height), 0.0f);
  std::int32_t index = s.strip;
  float* v = scratch;
  for (const Strip& strip : strips(s)) {
    kernels::forward_strip(high_[strip.column].value, inverses_[index++].plain.value, strip.width,
                           strip.tiles, v);
    v += kTileRows;
  }
  std::copy_n(scratch, s.width, x + s.first);
  const float* change = scratch + s.width;
  for (const std::int32_t p : rows_below(s)) x[p] += *change++;
}

void FactorPanels::forward_together(const Supernode& s, float* v, std::ptrdiff_t stride) const noexcept {
  std::int32_t index = s.strip;
  for (const Strip& strip : strips(s)) {
    kernels::forward_strip_together(high_[strip.column].value, inverses_[index++].plain.value, strip.width,
                                    strip.tiles, v, stride);
    v += kTileRows;
  }
}

void FactorPanels::backward(const Supernode& s, float* x, float* scratch) const noexcept {
  std::copy_n(x + s.first, s.width, scratch);
  float* copy = scratch + s.width;
  for (const std::int32_t p : rows_below(s)) *copy++ = x[p];
  std::fill(copy, scratch + static_cast<std::ptrdiff_t>(kTileRows) * tiles_of(s.height), 0.0f);
  for (std::int32_t k = strip_count(s.width) - 1; k >= 0; --k) {
    const Strip& strip = strips_[s.strip + k];
    kernels::backward_strip(high_[strip.column].value, inverses_[s.strip + k].transposed.value, strip.width,
                            strip.tiles, scratch + static_cast<std::ptrdiff_t>(kTileRows) * k);
  }
  std::copy_n(scratch, s.width, x + s.first);
}

void FactorPanels::solve(float* x, float* scratch) const noexcept {
  const FlushTiny flush;
  for (const Supernode& s : supernodes_) forward(s, x, scratch);
  for (std::int32_t p = 0; p < size(); ++p) x[p] *= inverse_pivots_[p];
  for (std::size_t s = supernodes_.size(); s-- > 0;) backward(supernodes_[s], x, scratch);
}

}  // namespace omentum::physics
