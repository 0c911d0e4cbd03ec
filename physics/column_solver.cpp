#include "physics/column_solver.h"

#include <cblas.h>

#include <algorithm>

namespace omentum::physics {

// A block of solutions X is kept with its columns contiguous for each row, so that to BLAS (column-major)
// it is X^T [columns x n]: rows of one supernode are a dense matrix and gathering a row is one copy.

ColumnSolver::ColumnSolver(const Supernodes& factor, const std::vector<bool>& wanted, int max_columns)
    : factor_(factor),
      stride_(max_columns),
      supernode_of_(factor.size),
      parent_(factor.count, -1),
      last_wanted_(factor.count, -1),
      on_path_(factor.count, 0),
      x_(static_cast<std::size_t>(factor.size) * max_columns) {
  std::size_t most_below = 0;
  for (std::int32_t s = 0; s < factor.count; ++s) {
    for (std::int32_t p = factor.first_column[s]; p < factor.first_column[s + 1]; ++p) {
      supernode_of_[p] = s;
      if (wanted[p]) last_wanted_[s] = s;
    }
    most_below = std::max(most_below, factor.rows_below(s).size());
  }
  below_.resize(most_below * max_columns);
  for (std::int32_t s = 0; s < factor.count; ++s) {
    if (factor.rows_below(s).empty()) continue;
    parent_[s] = supernode_of_[factor.rows_below(s).front()];
    last_wanted_[parent_[s]] = std::max(last_wanted_[parent_[s]], last_wanted_[s]);
  }
}

void ColumnSolver::mark_paths(std::span<const std::int32_t> positions) {
  for (const std::int32_t p : positions) {
    for (std::int32_t s = supernode_of_[p]; s >= 0 && !on_path_[s]; s = parent_[s]) {
      on_path_[s] = 1;
      std::fill(mutable_row(factor_.first_column[s]), mutable_row(factor_.first_column[s + 1]), 0.0);
    }
  }
}

void ColumnSolver::solve(std::span<const std::int32_t> positions) {
  columns_ = static_cast<int>(positions.size());
  std::ranges::fill(on_path_, 0);
  mark_paths(positions);
  for (int q = 0; q < columns_; ++q) mutable_row(positions[q])[q] = 1;

  const std::int32_t first = supernode_of_[positions.front()];
  for (std::int32_t s = first; s < factor_.count; ++s) {
    if (on_path_[s]) forward(s);
  }
  for (std::int32_t s = factor_.count - 1; s >= first; --s) {
    if (last_wanted_[s] >= first) backward(s);
  }
}

// L_ss y_s = x_s, then x_below -= L_below,s y_s.
void ColumnSolver::forward(std::int32_t s) {
  const int width = factor_.width(s), height = factor_.height(s);
  const auto below = factor_.rows_below(s);
  const double* panel = factor_.panel(s);
  double* x = mutable_row(factor_.first_column[s]);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, columns_, width, 1, panel,
              height, x, stride_);
  if (below.empty()) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, columns_, static_cast<int>(below.size()), width, 1, x,
              stride_, panel + width, height, 0, below_.data(), stride_);
  const double* change = below_.data();
  for (const std::int32_t p : below) {
    double* target = mutable_row(p);
    for (int q = 0; q < columns_; ++q) target[q] -= change[q];
    change += stride_;
  }
}

// L_ss^T x_s = y_s - L_below,s^T x_below; y_s is zero away from the paths.
void ColumnSolver::backward(std::int32_t s) {
  const int width = factor_.width(s), height = factor_.height(s);
  const auto below = factor_.rows_below(s);
  const double* panel = factor_.panel(s);
  double* x = mutable_row(factor_.first_column[s]);
  if (!below.empty()) {
    double* copy = below_.data();
    for (const std::int32_t p : below) {
      std::copy_n(row(p), columns_, copy);
      copy += stride_;
    }
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, columns_, width, static_cast<int>(below.size()),
                -1, below_.data(), stride_, panel + width, height, on_path_[s] ? 1 : 0, x, stride_);
  } else if (!on_path_[s]) {
    std::fill(x, mutable_row(factor_.first_column[s + 1]), 0.0);
  }
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, columns_, width, 1, panel,
              height, x, stride_);
}

}  // namespace omentum::physics
