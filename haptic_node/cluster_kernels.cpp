// Nothing but loops on raw pointers and no library header with inline functions: this file alone is
// compiled for this machine's vector unit (omentum_native).
#include "haptic_node/cluster_kernels.h"

namespace omentum::haptic::kernels {

namespace {
constexpr int kLanes = 16;  // floats kept in registers while the rows stream past
}

void weighted_sum(const float* const* rows, const float* weights, int count, int size, float* sum) noexcept {
  int begin = 0;
  for (; begin + kLanes <= size; begin += kLanes) {
    float lanes[kLanes] = {};
    for (int q = 0; q < count; ++q) {
      const float* row = rows[q] + begin;
      for (int l = 0; l < kLanes; ++l) lanes[l] += weights[q] * row[l];
    }
    for (int l = 0; l < kLanes; ++l) sum[begin + l] = lanes[l];
  }
  for (int i = begin; i < size; ++i) {
    sum[i] = 0;
    for (int q = 0; q < count; ++q) sum[i] += weights[q] * rows[q][i];
  }
}

void add_to_both(const float* step, int size, float* __restrict a, float* __restrict b) noexcept {
  for (int i = 0; i < size; ++i) {
    a[i] += step[i];
    b[i] += step[i];
  }
}

void mark_meeting(const Boxes& boxes, const float* grow, const float* low, const float* high, int size,
                  std::uint8_t* __restrict marks) noexcept {
  const float *lx = boxes.low[0], *ly = boxes.low[1], *lz = boxes.low[2];
  const float *hx = boxes.high[0], *hy = boxes.high[1], *hz = boxes.high[2];
  const float ax = low[0], ay = low[1], az = low[2], bx = high[0], by = high[1], bz = high[2];
  for (int i = 0; i < size; ++i) {
    const float g = grow[i];
    const int meets = (lx[i] - g <= bx) & (hx[i] + g >= ax) & (ly[i] - g <= by) & (hy[i] + g >= ay) &
                      (lz[i] - g <= bz) & (hz[i] + g >= az);
    marks[i] = static_cast<std::uint8_t>(meets);
  }
}

void combine_blocks(const float* const* blocks, const double* weights, int count, double* sum) noexcept {
  double lanes[kBlockStride] = {};
  for (int q = 0; q < count; ++q) {
    for (int l = 0; l < kBlockStride; ++l) lanes[l] += weights[q] * static_cast<double>(blocks[q][l]);
  }
  for (int l = 0; l < kBlockStride; ++l) sum[l] = lanes[l];
}

}  // namespace omentum::haptic::kernels
