// The stiffness over the free degrees of freedom, factorized once: K = L L^T (CHOLMOD, supernodal).
#pragma once

#include "physics/stiffness.h"
#include "physics/supports.h"

#include <memory>

namespace omentum::physics {

/// A read-only view of the supernodal factor. Supernode s holds the columns first_column[s] ..
/// first_column[s+1] of L, as a dense column-major panel whose rows are rows[row_start[s]] ..
/// rows[row_start[s+1]]; the first of them are its own columns. All numbers are positions in the order of
/// elimination.
struct Supernodes {
  std::int32_t size = 0;                       // n: degrees of freedom
  std::int32_t count = 0;                      // S: supernodes
  const std::int32_t* first_column = nullptr;  // [S+1]
  const std::int32_t* row_start = nullptr;     // [S+1] into `rows`
  const std::int32_t* value_start = nullptr;   // [S+1] into `values`
  const std::int32_t* rows = nullptr;
  const double* values = nullptr;
  const std::int32_t* permutation = nullptr;  // [n] the free degree of freedom at each position

  std::int32_t width(std::int32_t s) const { return first_column[s + 1] - first_column[s]; }
  std::int32_t height(std::int32_t s) const { return row_start[s + 1] - row_start[s]; }
  std::span<const std::int32_t> rows_below(std::int32_t s) const {
    return {rows + row_start[s] + width(s), rows + row_start[s + 1]};
  }
  const double* panel(std::int32_t s) const { return values + value_start[s]; }
};

/// Read-only after construction: any number of threads may solve with it.
class StiffnessFactor {
 public:
  /// Orders by nested dissection of the nodes' graph and factorizes. Throws FloatingError when K is not
  /// positive definite over the free degrees of freedom, std::runtime_error when CHOLMOD fails otherwise (out
  /// of memory).
  StiffnessFactor(const Stiffness& stiffness, const FreeDofs& free);
  ~StiffnessFactor();
  StiffnessFactor(StiffnessFactor&&) noexcept;
  StiffnessFactor& operator=(StiffnessFactor&&) noexcept;

  /// K^-1 f: [free x columns], plainly by CHOLMOD. Throws std::runtime_error when out of memory.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;

  Supernodes supernodes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace omentum::physics
