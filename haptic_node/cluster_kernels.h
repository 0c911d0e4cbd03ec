// The innermost loops of the haptic step, on raw pointers: compiled for this machine's vector unit.
#pragma once

#include <cstddef>
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

/// Some slots, each with its weight.
struct Weighted {
  const int* slots;
  const double* weights;
  int count;
};

/// sum[9] = sum_ab u_a v_b block(a, b), in double, over the slots of rows and columns; `pitch`: floats
/// between two rows of blocks.
void combine_blocks(const float* blocks, std::ptrdiff_t pitch, const Weighted& rows, const Weighted& columns,
                    double* sum) noexcept;

}  // namespace omentum::haptic::kernels
