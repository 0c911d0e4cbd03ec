// The loops of the search for near parts of an intestine, on raw pointers: compiled for this machine's vector
// unit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace omentum::physics::kernels {

/// Two parts by the masses of their corners: a segment, and behind it a segment (two) or a triangle (three).
struct PartCorners {
  std::int32_t of_segment[2], of_part[3];
};

/// Closest points, as PairPlaces (gut_distance.h).
struct MeasuredPair {
  double s, weights[3], distance_m;
};

/// between_segments and between_segment_and_triangle (gut_distance.h) for `count` pairs, several at a time:
/// the same to rounding. `x` [masses][3], m; `farthest_m` [count].
void measure_segments(std::size_t count, const PartCorners* pairs, const double* x,
                      MeasuredPair* found) noexcept;
void measure_triangles(std::size_t count, const PartCorners* pairs, const double* x, const double* farthest_m,
                       MeasuredPair* found) noexcept;

/// Writes those i of [count], in their order, with slack_m[i] <= ahead_m[one[i]] + ahead_m[other[i]]. Returns
/// how many. `awake` has room for all.
std::size_t find_awake(std::size_t count, const double* slack_m, const std::int32_t* one,
                       const std::int32_t* other, const double* ahead_m, std::int32_t* awake) noexcept;

/// Balls [count] by components, m.
struct Balls {
  const double *x, *y, *z, *radius;
};

/// A segment from `start` on; per_length: 1 / length^2, 0 without length.
struct BallLine {
  double start[3], along[3], per_length;
};

constexpr std::size_t kMostBalls = 16;

/// Which of at most kMostBalls are within `around_m` of the line, a bit each; separation [kMostBalls]: how
/// far all are from it, m.
std::uint32_t find_near_balls(std::size_t count, const Balls& balls, const BallLine& line, double around_m,
                              double* separation_m) noexcept;

}  // namespace omentum::physics::kernels
