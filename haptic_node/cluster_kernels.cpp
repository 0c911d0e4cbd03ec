// Nothing but loops on raw pointers and no library header with inline functions: this file alone is
// compiled for this machine's vector unit (omentum_native).
#include "haptic_node/cluster_kernels.h"

namespace omentum::haptic::kernels {

namespace {

// Sixteen values at once; the compiler splits them where registers are narrower.
constexpr int kLanes = 16;
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));

// Eight in double: a wider accumulator than a register would live in memory.
constexpr int kHalf = kLanes / 2;
typedef float HalfLanes __attribute__((vector_size(kHalf * sizeof(float)), aligned(4), may_alias));
typedef double WideLanes __attribute__((vector_size(kHalf * sizeof(double))));

// The same at any address.
struct __attribute__((packed, may_alias)) LooseLanes {
  Lanes lanes;
};

inline Lanes load(const float* p) {
  return reinterpret_cast<const LooseLanes*>(p)->lanes;
}

}  // namespace

void weighted_sum(const float* const* rows, const float* weights, int count, int size, float* sum) noexcept {
  int begin = 0;
  for (; begin + kLanes <= size; begin += kLanes) {
    Lanes lanes{};
    for (int q = 0; q < count; ++q) lanes += weights[q] * load(rows[q] + begin);
    reinterpret_cast<LooseLanes*>(sum + begin)->lanes = lanes;
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

void combine_blocks(const float* blocks, std::ptrdiff_t pitch, const Weighted& rows, const Weighted& columns,
                    double* sum) noexcept {
  // the ninth by itself: a second vector for it would be empty but for one lane
  WideLanes first{};
  double last = 0;
  for (int a = 0; a < rows.count; ++a) {
    const float* row = blocks + rows.slots[a] * pitch;
    WideLanes row_first{};
    double row_last = 0;
    for (int b = 0; b < columns.count; ++b) {
      const float* block = row + columns.slots[b] * kBlockStride;
      const double weight = columns.weights[b];
      row_first += weight * __builtin_convertvector(*reinterpret_cast<const HalfLanes*>(block), WideLanes);
      row_last += weight * block[kHalf];
    }
    first += rows.weights[a] * row_first;
    last += rows.weights[a] * row_last;
  }
  __builtin_memcpy(sum, &first, sizeof first);
  sum[kHalf] = last;
}

}  // namespace omentum::haptic::kernels
