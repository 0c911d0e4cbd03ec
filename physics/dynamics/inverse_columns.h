// What a kept factor makes of columns that begin at few nodes.
#pragma once

#include "physics/dynamics/factor_panels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// E^T A^-1 E of columns E that are zero but at some positions, from A = L D L^T. With Z = D^(-1/2) L^-1 E it
/// is Z^T Z: the backward half of a solve is not needed. Of Z only the ways from these positions to the root
/// of the elimination tree are not zero, and only they are visited. begin(), set(), then square(). All memory
/// is taken at construction; one thread at a time.
class InverseColumns {
 public:
  InverseColumns(const FactorPanels& panels, std::size_t most_columns);

  /// All zero, `width` of them, on the ways from `positions` of the factor.
  void begin(const FactorPanels& panels, std::span<const std::int32_t> positions, std::size_t width) noexcept;
  /// Precondition: `position` is one of those on the ways.
  void set(const FactorPanels& panels, std::size_t column, std::int32_t position, float value) noexcept {
    columns_[column * stride_ + place_on_way(panels, position)] = value;
  }
  /// [width x width], symmetric. The columns are Z afterwards.
  void square(const FactorPanels& panels, std::span<float> block) noexcept;

 private:
  std::size_t place_on_way(const FactorPanels& panels, std::int32_t position) const noexcept {
    const std::int32_t s = panels.supernode_of(position);
    return static_cast<std::size_t>(place_[s] + position - panels.supernodes()[s].first);
  }
  void mark_ways(const FactorPanels& panels, std::span<const std::int32_t> positions) noexcept;
  void forward(const FactorPanels& panels, const FactorPanels::Supernode& s, std::size_t first) noexcept;

  struct alignas(64) Row {
    float value[kernels::kTileRows];
  };
  std::size_t stride_;               // n, rows of A
  std::vector<float> columns_;       // [most_columns, in whole groups][n], those on the ways first
  std::size_t rows_;                 // tiles of the tallest supernode
  std::vector<Row> together_;        // [kTogether][rows_]
  std::vector<std::int32_t> ways_;   // supernodes
  std::vector<std::int32_t> place_;  // [S] of its first column in columns_; -1: not on a way
  std::int32_t way_length_ = 0;      // columns of all those
  std::size_t width_ = 0;
};

}  // namespace omentum::physics
