#include "physics/dynamics/inverse_columns.h"

#include "physics/dynamics/flush_tiny.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

// Columns, filled up to whole groups of those that are taken through together.
std::size_t whole_groups(std::size_t columns) {
  return (columns + kernels::kTogether - 1) / kernels::kTogether * kernels::kTogether;
}

}  // namespace

InverseColumns::InverseColumns(const FactorPanels& panels, std::size_t most_columns)
    : stride_(static_cast<std::size_t>(panels.size())),
      columns_(whole_groups(most_columns) * stride_),
      rows_(static_cast<std::size_t>(std::max(1, panels.most_rows() / kernels::kTileRows))),
      together_(kernels::kTogether * rows_),
      place_(panels.supernodes().size(), -1) {
  ways_.reserve(place_.size());
}

void InverseColumns::mark_ways(const FactorPanels& panels, std::span<const std::int32_t> positions) noexcept {
  for (const std::int32_t s : ways_) place_[s] = -1;
  ways_.clear();
  for (const std::int32_t p : positions) {
    for (std::int32_t s = panels.supernode_of(p); s >= 0 && place_[s] < 0;
         s = panels.supernodes()[s].parent) {
      place_[s] = 0;
      ways_.push_back(s);
    }
  }
  std::ranges::sort(ways_);
  way_length_ = 0;
  for (const std::int32_t s : ways_) {
    place_[s] = way_length_;
    way_length_ += panels.supernodes()[s].width;
  }
}

void InverseColumns::begin(const FactorPanels& panels, std::span<const std::int32_t> positions,
                           std::size_t width) noexcept {
  mark_ways(panels, positions);
  width_ = width;
  for (std::size_t r = 0; r < whole_groups(width); ++r)
    std::fill_n(columns_.data() + r * stride_, way_length_, 0.0f);
}

// Columns first to first + kTogether of Z, as far as supernode `s` goes.
void InverseColumns::forward(const FactorPanels& panels, const FactorPanels::Supernode& s,
                             std::size_t first) noexcept {
  const std::size_t stride = rows_ * kernels::kTileRows;
  const std::int32_t here = place_[&s - panels.supernodes().data()];
  const auto height =
      static_cast<std::size_t>((s.height + kernels::kTileRows - 1) / kernels::kTileRows * kernels::kTileRows);
  float* v = together_.data()->value;
  for (std::size_t c = 0; c < kernels::kTogether; ++c) {
    std::copy_n(columns_.data() + (first + c) * stride_ + here, s.width, v + c * stride);
    std::fill(v + c * stride + s.width, v + c * stride + height, 0.0f);
  }
  panels.forward_together(s, v, static_cast<std::ptrdiff_t>(stride));
  for (std::size_t c = 0; c < kernels::kTogether; ++c) {
    float* z = columns_.data() + (first + c) * stride_;
    for (std::int32_t i = 0; i < s.width; ++i)
      z[here + i] = v[c * stride + i] * std::sqrt(panels.inverse_pivot(s.first + i));
    const float* change = v + c * stride + s.width;
    for (const std::int32_t p : panels.rows_below(s)) z[place_on_way(panels, p)] += *change++;
  }
}

void InverseColumns::square(const FactorPanels& panels, std::span<float> block) noexcept {
  const FlushTiny flush;
  for (const std::int32_t s : ways_) {
    for (std::size_t first = 0; first < width_; first += kernels::kTogether)
      forward(panels, panels.supernodes()[s], first);
  }
  for (std::size_t r = 0; r < width_; ++r) {
    for (std::size_t q = 0; q <= r; ++q) {
      block[r * width_ + q] = block[q * width_ + r] =
          kernels::column_dot(columns_.data() + r * stride_, columns_.data() + q * stride_, way_length_);
    }
  }
}

}  // namespace omentum::physics
