#include "physics/dynamics/spring_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omentum::physics {

namespace {

using OfEdges = std::array<double, 6>;
using Vectors = std::array<Vec3, 6>;

// What a uniform dilation costs the continuum, 3 E V e^2, over what a spring of 1 / l^2 costs, e^2 / 2.
constexpr double kDilation = 6;
// Sweeps end where nothing changes any more; in slivers, whose equations hardly differ, after so many.
constexpr int kMostSweeps = 2000;
constexpr double kSettled = 1e-12;

// x >= 0 that is nearest to sum_j (d_i . d_j)^4 x_j = 1: Gauss and Seidel's sweeps with a floor, which end at
// the minimum since the matrix is positive definite.
OfEdges solve_not_negative(const Vectors& directions) {
  OfEdges x{};
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      double rest = 1;
      for (std::size_t j = 0; j < x.size(); ++j) {
        if (j != i) rest -= std::pow(directions[i].dot(directions[j]), 4) * x[j];
      }
      const double next = std::max(rest, 0.0);
      change = std::max(change, std::abs(next - x[i]));
      x[i] = next;
    }
    if (change < kSettled) break;
  }
  return x;
}

}  // namespace

std::array<double, 6> fit_springs(const Corners& corners, const Material& material, SpringFit fit) {
  Vectors edges, directions;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i] = corners[kTetEdges[i][1]] - corners[kTetEdges[i][0]];
    directions[i] = edges[i].normalized();
  }
  const double volume = geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]);
  OfEdges k;
  k.fill(1);
  if (fit == SpringFit::kLeastSquares) k = solve_not_negative(directions);
  const double scale = kDilation * material.young_pa * volume / std::accumulate(k.begin(), k.end(), 0.0);
  for (std::size_t i = 0; i < k.size(); ++i) k[i] *= scale / edges[i].squaredNorm();
  return k;
}

}  // namespace omentum::physics
