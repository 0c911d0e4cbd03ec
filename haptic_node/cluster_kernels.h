// The innermost loops of the haptic step, on raw pointers: compiled for this machine's vector unit.
#pragma once

#include <cstdint>

namespace omentum::haptic::kernels {

/// sum[i] = sum_q weights[q] rows[q][i], i < size. No alignment needed.
void weighted_sum(const float* const* rows, const float* weights, int count, int size, float* sum) noexcept;

/// a[i] += step[i] and b[i] += step[i], i < size.
void add_to_both(const float* step, int size, float* a, float* b) noexcept;

/// Axis-aligned boxes, one array per bound.
struct Boxes {
  const float* low[3];
  const float* high[3];
};

/// marks[i] = 1 where box i, grown by grow[i] on every side, meets the box [low, high]; else 0. i < size.
void mark_meeting(const Boxes& boxes, const float* grow, const float* low, const float* high, int size,
                  std::uint8_t* marks) noexcept;

/// Floats of one 3x3 block: nine in use, column after column, and padding to one cache line.
inline constexpr int kBlockStride = 16;

/// sum[16] = sum_q weights[q] blocks[q], in double.
void combine_blocks(const float* const* blocks, const double* weights, int count, double* sum) noexcept;

}  // namespace omentum::haptic::kernels
