// A factor A = L D L^T in the form that is solved with and downdated in place.
#pragma once

#include "physics/dynamics/factor_kernels.h"
#include "physics/dynamics/huge_pages.h"
#include "physics/stiffness_factor.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// L unit lower triangular and D diagonal, by supernodes as CHOLMOD found them, in the order of elimination.
/// A supernode's columns are cut into strips of 16, those into tiles of 16 rows, counted from the strip's
/// first column and filled up with zeros: [strip][tile][column][row]. So each pass over a strip reads memory
/// from front to end, and works on whole vectors (factor_kernels.h). The local rows of a supernode are its
/// own columns, then the rows below them.
class FactorPanels {
 public:
  struct Supernode {
    std::int32_t first;   // its first column
    std::int32_t width;   // its columns
    std::int32_t height;  // local rows
    std::int32_t rows;    // into `rows`: where those below its columns begin
    std::int32_t strip;   // its first strip
    std::int32_t parent;  // in the tree of supernodes; -1 for a root
  };
  struct Strip {
    std::int64_t column;  // where its tiles begin, in columns of 16 values
    std::int32_t width;
    std::int32_t tiles;
  };

  /// A copy of CHOLMOD's L L^T.
  explicit FactorPanels(const Supernodes& factor);

  std::int32_t size() const { return static_cast<std::int32_t>(pivots_.size()); }
  std::span<const Supernode> supernodes() const { return supernodes_; }
  std::int32_t supernode_of(std::int32_t position) const { return supernode_of_[position]; }
  std::span<const std::int32_t> rows_below(const Supernode& s) const {
    return {rows_.data() + s.rows, static_cast<std::size_t>(s.height - s.width)};
  }
  std::span<const Strip> strips(const Supernode& s) const {
    return {strips_.data() + s.strip, static_cast<std::size_t>(strip_count(s.width))};
  }
  kernels::SplitColumns columns(const Strip& strip) {
    return {high_[strip.column].value, low_[strip.column].value};
  }
  double* pivots(std::int32_t position) { return pivots_.data() + position; }
  /// Entries of L that are kept, the zeros of the tiles among them.
  std::size_t entry_count() const { return high_.size() * kernels::kTileRows; }
  /// Local rows of the highest supernode, filled up to whole tiles.
  std::int32_t most_rows() const { return most_rows_; }

  /// x = A^-1 x, [n], in the order of elimination. `scratch`: [most_rows], 64-byte aligned.
  void solve(float* x, float* scratch) const noexcept;
  /// One supernode's share of L^-1 x; and of L^-T x.
  void forward(const Supernode& s, float* x, float* scratch) const noexcept;
  /// The former of kernels::kTogether right-hand sides, in local rows: v [kTogether][stride], 64-byte
  /// aligned, `stride` at least most_rows(). Rows below the supernode's columns begin as zeros, and end as
  /// what is to be added there.
  void forward_together(const Supernode& s, float* v, std::ptrdiff_t stride) const noexcept;
  void backward(const Supernode& s, float* x, float* scratch) const noexcept;
  /// 1 / D at `position`, as solves use it.
  float inverse_pivot(std::int32_t position) const { return inverse_pivots_[position]; }

  /// What solves keep of the diagonal tiles of a supernode, after its columns or pivots changed.
  void refresh(const Supernode& s) noexcept;
  /// Takes supernode `s` over from another state of the same factor.
  void copy(const Supernode& s, const FactorPanels& from) noexcept;

 private:
  struct alignas(64) Column {
    float value[kernels::kTileRows];
  };
  struct alignas(64) Square {
    float value[kernels::kSquare];
  };
  // Of the unit lower triangle on a strip's diagonal.
  struct Inverses {
    Square plain, transposed;
  };

  static std::int32_t strip_count(std::int32_t width) {
    return (width + kernels::kTileRows - 1) / kernels::kTileRows;
  }
  void lay_out(const Supernodes& factor);
  void fill(const Supernode& s, const double* panel);

  std::vector<Supernode> supernodes_;
  std::vector<std::int32_t> supernode_of_;  // [n]
  std::vector<std::int32_t> rows_;
  std::vector<Strip> strips_;
  std::vector<Column, HugePages<Column>> high_, low_;
  std::vector<Inverses> inverses_;     // [strips]
  std::vector<double> pivots_;         // [n] D
  std::vector<float> inverse_pivots_;  // [n]
  std::int32_t most_rows_ = 0;
};

}  // namespace omentum::physics
