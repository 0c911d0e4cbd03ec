#include "physics/dynamics/factor_downdate.h"

#include <algorithm>

namespace omentum::physics {

namespace {

using kernels::kRank;
using kernels::kTileRows;

constexpr int kTileRanks = kRank * kTileRows;

// Whether a removal's rows in one tile are zero: then it leaves the columns there as they are.
bool is_zero(const double* w) {
  return std::all_of(w, w + kTileRanks, [](double value) { return value == 0; });
}

}  // namespace

FactorDowndate::FactorDowndate(const FactorPanels& factor)
    : local_size_(static_cast<std::size_t>(factor.most_rows()) * kRank),
      local_(local_size_ * kMost),
      marks_(factor.supernodes().size()) {
  for (auto& w : w_) w.assign(factor.size(), Ranks{});
  path_.reserve(factor.supernodes().size());
}

void FactorDowndate::mark(const FactorPanels& factor, std::int32_t position, int removal) noexcept {
  const auto bit = static_cast<std::uint8_t>(1 << removal);
  std::int32_t s = factor.supernode_of(position);
  while (s >= 0 && (marks_[s] & bit) == 0) {
    if (marks_[s] == 0) path_.push_back(s);
    marks_[s] |= bit;
    s = factor.supernodes()[s].parent;
  }
}

bool FactorDowndate::apply(FactorPanels& factor, std::span<const RankSix> removals) noexcept {
  path_.clear();
  for (std::size_t r = 0; r < removals.size(); ++r) {
    alpha_[r].fill(removals[r].is_added ? -1 : 1);
    for (std::size_t i = 0; i < removals[r].position.size(); ++i) {
      const std::int32_t p = removals[r].position[i];
      if (p < 0) continue;
      w_[r][p] = removals[r].w[i];
      mark(factor, p, static_cast<int>(r));
    }
  }
  std::ranges::sort(path_);
  bool enough = true;
  for (const std::int32_t s : path_) enough &= downdate(factor, s);
  return enough;
}

void FactorDowndate::gather(const FactorPanels& factor, const FactorPanels::Supernode& s, int removal,
                            double* into) noexcept {
  std::vector<Ranks>& w = w_[removal];
  std::int32_t row = 0;
  const auto take = [&](std::int32_t position) {
    double* at = into + row / kTileRows * kTileRanks + row % kTileRows;
    for (int k = 0; k < kRank; ++k) at[k * kTileRows] = w[position][k];
    ++row;
  };
  for (std::int32_t c = 0; c < s.width; ++c) {
    take(s.first + c);
    w[s.first + c].fill(0);
  }
  for (const std::int32_t p : factor.rows_below(s)) take(p);
  for (; row % kTileRows != 0; ++row) {
    for (int k = 0; k < kRank; ++k) into[row / kTileRows * kTileRanks + k * kTileRows + row % kTileRows] = 0;
  }
}

void FactorDowndate::scatter(const FactorPanels& factor, const FactorPanels::Supernode& s, int removal,
                             const double* from) noexcept {
  std::int32_t row = s.width;
  for (const std::int32_t p : factor.rows_below(s)) {
    const double* at = from + row / kTileRows * kTileRanks + row % kTileRows;
    for (int k = 0; k < kRank; ++k) w_[removal][p][k] = at[k * kTileRows];
    ++row;
  }
}

bool FactorDowndate::downdate(FactorPanels& factor, std::int32_t supernode) noexcept {
  const FactorPanels::Supernode& s = factor.supernodes()[supernode];
  std::array<int, kMost> removals{};
  std::size_t count = 0;
  for (int r = 0; r < kMost; ++r) {
    if ((marks_[supernode] >> r & 1) == 0) continue;
    gather(factor, s, r, local_.data() + local_size_ * r);
    removals[count++] = r;
  }
  marks_[supernode] = 0;
  bool enough = true;
  const std::span<const int> here(removals.data(), count);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(factor.strips(s).size()); ++k)
    enough &= downdate_strip(factor, s, k, here);
  for (const int r : here) scatter(factor, s, r, local_.data() + local_size_ * r);
  factor.refresh(s);
  return enough;
}

bool FactorDowndate::downdate_strip(FactorPanels& factor, const FactorPanels::Supernode& s,
                                    std::int32_t strip, std::span<const int> removals) noexcept {
  const FactorPanels::Strip& columns = factor.strips(s)[strip];
  const kernels::SplitColumns diagonal = factor.columns(columns);
  std::array<double*, kMost> w{};
  std::size_t count = 0;
  bool enough = true;
  for (const int r : removals) {
    double* rows = local_.data() + local_size_ * r + static_cast<std::ptrdiff_t>(kTileRanks) * strip;
    if (is_zero(rows)) continue;
    enough &= kernels::downdate_diagonal(diagonal, columns.width, factor.pivots(s.first + kTileRows * strip),
                                         rows, alpha_[r].data(), rotations_[count]);
    w[count++] = rows;
  }
  for (std::int32_t t = 1; t < columns.tiles; ++t) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(t) * columns.width * kTileRows;
    for (std::size_t r = 0; r < count; ++r) {
      kernels::rotate_tile({diagonal.high + at, diagonal.low + at}, columns.width, rotations_[r],
                           w[r] + static_cast<std::ptrdiff_t>(kTileRanks) * t);
    }
  }
  return enough;
}

}  // namespace omentum::physics
