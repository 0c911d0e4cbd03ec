// Solves K x = e for blocks of unit forces on the supernodal factor, doing only the work that is asked for.
#pragma once

#include "physics/stiffness_factor.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// One worker's workspace. A unit force at elimination position p has a sparse right-hand side: the forward
/// substitution visits only the path from p to the root of the elimination tree. And because K^-1 is
/// symmetric, whoever asks for all columns needs of each only the rows from p on: the backward substitution
/// stops there. Together about a third of the operations of a full solve.
///
/// One thread at a time; several solvers may share the factor.
class ColumnSolver {
 public:
  /// `wanted[p]`: whether row p of a solution is ever asked for. At most `max_columns` per block.
  ColumnSolver(const Supernodes& factor, const std::vector<bool>& wanted, int max_columns);

  /// Solves for unit forces at the given positions (not empty, the smallest first).
  void solve(std::span<const std::int32_t> positions);

  /// Row `p` of the solutions, one value per column of the last block. Valid for wanted p >= positions[0].
  const double* row(std::int32_t p) const { return x_.data() + static_cast<std::size_t>(p) * stride_; }

 private:
  double* mutable_row(std::int32_t p) { return x_.data() + static_cast<std::size_t>(p) * stride_; }
  void mark_paths(std::span<const std::int32_t> positions);
  void forward(std::int32_t s);
  void backward(std::int32_t s);

  Supernodes factor_;
  int stride_;                              // doubles per row
  int columns_ = 0;                         // of the block at hand
  std::vector<std::int32_t> supernode_of_;  // [n]
  std::vector<std::int32_t> parent_;        // [S] in the elimination tree; -1 for a root
  std::vector<std::int32_t>
      last_wanted_;            // [S] highest supernode with a wanted row in the subtree; -1 for none
  std::vector<char> on_path_;  // [S]
  std::vector<double> x_;      // [n][stride]
  std::vector<double> below_;  // [largest number of rows below][stride]
};

}  // namespace omentum::physics
