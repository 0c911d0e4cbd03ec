// Removed tetrahedra, taken off a factor in place; and what holds loose nodes instead, put on it.
#pragma once

#include "physics/dynamics/factor_panels.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// What one tetrahedron's removal takes off A: w w^T, over the degrees of freedom of its corners; or what is
/// added to it.
struct RankSix {
  std::array<std::int32_t, 12> position;                 // in the order of elimination; -1: held
  std::array<std::array<double, kernels::kRank>, 12> w;  // not read where held
  bool is_added = false;
};

/// The workspace of downdates. Each changes only the supernodes on the ways from the tetrahedra's corners to
/// the root of the elimination tree (Davis and Hager 2001); those that share a way are taken off in one pass
/// over it.
class FactorDowndate {
 public:
  explicit FactorDowndate(const FactorPanels& factor);

  /// The most in one call.
  static constexpr int kMost = 8;

  /// A -= sum w w^T, or += of those that are added. False: A did not stay positive definite, or only within
  /// rounding; the factor is then of no use before it is copied back.
  [[nodiscard]] bool apply(FactorPanels& factor, std::span<const RankSix> removals) noexcept;

  /// The supernodes that the last call changed, in ascending order.
  std::span<const std::int32_t> changed() const { return path_; }

 private:
  void mark(const FactorPanels& factor, std::int32_t position, int removal) noexcept;
  void gather(const FactorPanels& factor, const FactorPanels::Supernode& s, int removal,
              double* into) noexcept;
  void scatter(const FactorPanels& factor, const FactorPanels::Supernode& s, int removal,
               const double* from) noexcept;
  // whether enough is left of every alpha
  bool downdate(FactorPanels& factor, std::int32_t supernode) noexcept;
  bool downdate_strip(FactorPanels& factor, const FactorPanels::Supernode& s, std::int32_t strip,
                      std::span<const int> removals) noexcept;

  using Ranks = std::array<double, kernels::kRank>;

  std::size_t local_size_;                   // doubles of one removal's local rows
  std::array<std::vector<Ranks>, kMost> w_;  // [n], zero between calls
  std::vector<double> local_;                // [kMost][tile][rank][row]
  std::array<Ranks, kMost> alpha_{};
  std::array<kernels::Rotations, kMost> rotations_{};
  std::vector<std::uint8_t> marks_;  // [S] a bit for each removal whose way leads through
  std::vector<std::int32_t> path_;
};

}  // namespace omentum::physics
