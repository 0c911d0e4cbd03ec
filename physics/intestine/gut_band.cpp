#include "physics/intestine/gut_band.h"

#include "physics/intestine/gut_kernels.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

using geometry::MassId;

namespace {

// Adds springs to the lower half of a band: rows of width + 1, the diagonal last.
class BandRows {
 public:
  BandRows(const GutBand& band, const geometry::GutLayout& layout, std::size_t width)
      : band_(band), layout_(layout), width_(width), rows_(band.size() * (width + 1)) {}

  /// k (d d^T) for d = sum of weight times mass.
  template <std::size_t n>
  void add(double k, const std::array<std::size_t, n>& masses, const std::array<double, n>& weights) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) add_entry(masses[i], masses[j], k * weights[i] * weights[j]);
    }
  }
  void add_entry(std::size_t a, std::size_t b, double value) {
    const MassId one(a), other(b);
    if (layout_.is_held(one) || layout_.is_held(other) || band_.place(other) > band_.place(one)) return;
    at(band_.place(one), band_.place(other)) += value;
  }
  double& at(std::size_t i, std::size_t j) { return rows_[i * (width_ + 1) + width_ - (i - j)]; }
  std::size_t first(std::size_t i) const { return i < width_ ? 0 : i - width_; }

 private:
  const GutBand& band_;
  const geometry::GutLayout& layout_;
  std::size_t width_;
  std::vector<double> rows_;
};

void add_springs(const GutSprings& springs, double damped, BandRows& rows) {
  for (const auto& [offset, stiffness, rest] : springs.families()) {
    for (std::size_t a = 0; a < stiffness.size(); ++a) {
      if (stiffness[a] == 0) continue;
      rows.add<2>(damped * stiffness[a], {a, a + static_cast<std::size_t>(offset)}, {1, -1});
    }
  }
  const std::vector<double>& bends = springs.bends().stiffness_n_m;
  for (std::size_t c = 1; c + 1 < bends.size(); ++c) {
    rows.add<3>(damped * bends[c], {c - 1, c, c + 1}, {0.5, -1, 0.5});
  }
}

// Column by column.
std::vector<MassId> free_masses(const geometry::GutLayout& layout) {
  std::vector<MassId> masses;
  for (std::int32_t column = 1; column + 1 < layout.columns; ++column)
    for (std::int32_t row = 0; row + 1 < layout.rows; ++row) masses.push_back(layout.mass(row, column));
  return masses;
}

}  // namespace

GutBand::GutBand(const GutSprings& springs, double step_s)
    : layout_(springs.layout()),
      masses_(free_masses(layout_)),
      width_(2 * static_cast<std::size_t>(layout_.rows - 1)),
      lower_(masses_.size() * width_),
      upper_(lower_.size()),
      diagonal_(masses_.size()) {
  factorize(springs, step_s);
}

std::size_t GutBand::place(MassId m) const {
  return static_cast<std::size_t>((layout_.column(m) - 1) * (layout_.rows - 1) + layout_.row(m));
}

void GutBand::factorize(const GutSprings& springs, double step_s) {
  BandRows A(*this, layout_, width_);
  add_springs(springs, 1 + springs.damping_s() / step_s, A);
  const double inertia = (1 + step_s * springs.drag_per_s()) / (step_s * step_s);
  for (std::size_t i = 0; i < size(); ++i) {
    A.at(i, i) += inertia * springs.mass()[static_cast<std::size_t>(mass(i))];
    for (std::size_t j = A.first(i); j <= i; ++j) {
      for (std::size_t k = std::max(A.first(i), A.first(j)); k < j; ++k)
        A.at(i, j) -= A.at(i, k) * A.at(j, k) * A.at(k, k);
      if (j < i) A.at(i, j) /= A.at(j, j);
    }
    diagonal_[i] = 1 / A.at(i, i);
    for (std::size_t j = A.first(i); j < i; ++j) {
      lower_[i * width_ + width_ - (i - j)] = A.at(i, j);
      upper_[j * width_ + (i - j - 1)] = A.at(i, j);
    }
  }
}

// A^-1 within the band, from its last row on: A^-1 = D^-1 L^-1 + (1 - L^T) A^-1.
std::vector<double> GutBand::diagonal_of_inverse() const {
  const std::size_t row = width_ + 1;
  std::vector<double> band(size() * row), diagonal(size());
  const auto at = [&](std::size_t i, std::size_t j) -> double& {
    return band[std::min(i, j) * row + (std::max(i, j) - std::min(i, j))];
  };
  for (std::size_t i = size(); i-- > 0;) {
    const std::size_t last = std::min(i + width_, size() - 1);
    for (std::size_t j = last + 1; j-- > i;) {
      double sum = i == j ? diagonal_[i] : 0;
      for (std::size_t k = i + 1; k <= last; ++k) sum -= upper_[i * width_ + (k - i - 1)] * at(k, j);
      at(i, j) = sum;
    }
    diagonal[i] = at(i, i);
  }
  return diagonal;
}

void GutBand::solve(Node* b) const noexcept {
  kernels::solve_band(size(), width_, lower_.data(), upper_.data(), diagonal_.data(), b);
}

}  // namespace omentum::physics
