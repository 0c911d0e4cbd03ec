// Nothing but loops on raw pointers and no library header with inline functions: this file alone is
// compiled for this machine's vector unit (omentum_native).
#include "physics/dynamics/factor_kernels.h"

namespace omentum::physics::kernels {

namespace {

constexpr int kHalf = kTileRows / 2;

// Values of a tile's column as one; the compiler splits them where registers are narrower.
typedef float Lanes __attribute__((vector_size(kTileRows * sizeof(float))));
typedef float HalfLanes __attribute__((vector_size(kHalf * sizeof(float))));
typedef double WideHalf __attribute__((vector_size(kHalf * sizeof(double))));

typedef double Quad __attribute__((vector_size(4 * sizeof(double))));

// The same at any address.
struct __attribute__((packed, may_alias)) LooseLanes {
  Lanes lanes;
};
struct __attribute__((packed, may_alias)) LooseHalf {
  HalfLanes lanes;
};
struct __attribute__((packed, may_alias)) LooseWide {
  WideHalf lanes;
};

struct __attribute__((packed, may_alias)) LooseQuad {
  Quad lanes;
};

inline Quad quad_at(const double* p) {
  return reinterpret_cast<const LooseQuad*>(p)->lanes;
}
inline Lanes lanes_at(const float* p) {
  return reinterpret_cast<const LooseLanes*>(p)->lanes;
}
inline void put(float* p, const Lanes& lanes) {
  reinterpret_cast<LooseLanes*>(p)->lanes = lanes;
}
inline WideHalf wide_at(const double* p) {
  return reinterpret_cast<const LooseWide*>(p)->lanes;
}
inline void put(double* p, const WideHalf& lanes) {
  reinterpret_cast<LooseWide*>(p)->lanes = lanes;
}

// Eight entries of a split column.
inline WideHalf joined(const float* high, const float* low) {
  return __builtin_convertvector(reinterpret_cast<const LooseHalf*>(high)->lanes, WideHalf) +
         __builtin_convertvector(reinterpret_cast<const LooseHalf*>(low)->lanes, WideHalf);
}

inline double joined(float high, float low) {
  return static_cast<double>(high) + low;
}

// a -= scale b, [16].
inline void subtract(double* a, double scale, const double* b) {
  for (int half = 0; half < kTileRows; half += kHalf)
    put(a + half, wide_at(a + half) - scale * wide_at(b + half));
}

inline void put_split(float* high, float* low, const WideHalf& value) {
  const HalfLanes nearest = __builtin_convertvector(value, HalfLanes);
  reinterpret_cast<LooseHalf*>(high)->lanes = nearest;
  reinterpret_cast<LooseHalf*>(low)->lanes =
      __builtin_convertvector(value - __builtin_convertvector(nearest, WideHalf), HalfLanes);
}

// [16][16] by columns times v.
inline Lanes square_times(const float* square, const float* v) {
  Lanes even{}, odd{};
  for (int j = 0; j < kTileRows; j += 2) {
    even += lanes_at(square + j * kTileRows) * v[j];
    odd += lanes_at(square + (j + 1) * kTileRows) * v[j + 1];
  }
  return even + odd;
}

template <int kWidth>
void forward_below(const float* high, int tiles, float* v) {
  const float* tile = high + kWidth * kTileRows;
  for (int t = 1; t < tiles; ++t, tile += kWidth * kTileRows) {
    Lanes sum = lanes_at(v + t * kTileRows);
    for (int j = 0; j < kWidth; ++j) sum -= lanes_at(tile + j * kTileRows) * v[j];
    put(v + t * kTileRows, sum);
  }
}

// Sums of sixteen vectors' lanes, in order: at each of four levels two vectors become one that holds both,
// each folded once more.
inline Lanes sums_of(Lanes* v) {
  for (int k = 0; k < 8; ++k) {
    const Lanes a = v[2 * k], b = v[2 * k + 1];
    v[k] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23) +
           __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31);
  }
  for (int k = 0; k < 4; ++k) {
    const Lanes a = v[2 * k], b = v[2 * k + 1];
    v[k] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27) +
           __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
  }
  for (int k = 0; k < 2; ++k) {
    const Lanes a = v[2 * k], b = v[2 * k + 1];
    v[k] = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21, 24, 25, 28, 29) +
           __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15, 18, 19, 22, 23, 26, 27, 30, 31);
  }
  return __builtin_shufflevector(v[0], v[1], 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30) +
         __builtin_shufflevector(v[0], v[1], 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}

template <int kWidth>
void backward_below(const float* high, int tiles, float* v) {
  Lanes sums[kTileRows] = {};
  const float* tile = high + kWidth * kTileRows;
  for (int t = 1; t < tiles; ++t, tile += kWidth * kTileRows) {
    const Lanes x = lanes_at(v + t * kTileRows);
    for (int j = 0; j < kWidth; ++j) sums[j] += lanes_at(tile + j * kTileRows) * x;
  }
  put(v, lanes_at(v) - sums_of(sums));
}

typedef void (*Below)(const float* high, int tiles, float* v);

// One loop for each width, so that a strip's sums stay in registers.
constexpr Below kForwardBelow[kTileRows] = {
    forward_below<1>,  forward_below<2>,  forward_below<3>,  forward_below<4>,
    forward_below<5>,  forward_below<6>,  forward_below<7>,  forward_below<8>,
    forward_below<9>,  forward_below<10>, forward_below<11>, forward_below<12>,
    forward_below<13>, forward_below<14>, forward_below<15>, forward_below<16>};
constexpr Below kBackwardBelow[kTileRows] = {
    backward_below<1>,  backward_below<2>,  backward_below<3>,  backward_below<4>,
    backward_below<5>,  backward_below<6>,  backward_below<7>,  backward_below<8>,
    backward_below<9>,  backward_below<10>, backward_below<11>, backward_below<12>,
    backward_below<13>, backward_below<14>, backward_below<15>, backward_below<16>};

// One column of eight rows under six rotations.
inline void rotate(WideHalf& column, WideHalf* w, const double* pivot, const double* gain) {
  for (int k = 0; k < kRank; ++k) {
    w[k] -= pivot[k] * column;
    column += gain[k] * w[k];
  }
}

// A column's pivot d under the ranks in turn: d' = d - p^2 / alpha, alpha' = alpha d' / d. Divisions wait for
// none but each rank's own. Returns whether enough is left of each alpha.
inline bool turn_pivot(double& d, const double* w, double* alpha, double* pivot, double* gain) {
  double parts[kRank], before[kRank + 1];
  for (int k = 0; k < kRank; ++k) {
    pivot[k] = w[k * kTileRows];
    parts[k] = pivot[k] * pivot[k] / alpha[k];
  }
  before[0] = d;
  for (int k = 0; k < kRank; ++k) before[k + 1] = before[k] - parts[k];
  d = before[kRank];
  bool enough = true;
  for (int k = 0; k < kRank; ++k) {
    gain[k] = -pivot[k] / (alpha[k] * before[k + 1]);
    alpha[k] *= before[k + 1] / before[k];
    enough &= alpha[k] >= kLeastAlpha || alpha[k] <= -1;
  }
  return enough;
}

// A column of the diagonal tile, rows below `j`.
void rotate_below(double* column, double* w, int j, const double* pivot, const double* gain) {
  for (int half = j + 1 < kHalf ? 0 : kHalf; half < kTileRows; half += kHalf) {
    WideHalf x = wide_at(column + half), rows[kRank];
    for (int k = 0; k < kRank; ++k) rows[k] = wide_at(w + k * kTileRows + half);
    rotate(x, rows, pivot, gain);
    put(column + half, x);
    for (int k = 0; k < kRank; ++k) put(w + k * kTileRows + half, rows[k]);
  }
  for (int i = 0; i <= j; ++i) column[i] = 0;
}

}  // namespace

void forward_strip(const float* high, const float* inverse, int width, int tiles, float* v) noexcept {
  put(v, square_times(inverse, v));
  kForwardBelow[width - 1](high, tiles, v);
}

void forward_strip_together(const float* high, const float* inverse, int width, int tiles, float* v,
                            long stride) noexcept {
  for (int c = 0; c < kTogether; ++c) put(v + c * stride, square_times(inverse, v + c * stride));
  const float* tile = high + width * kTileRows;
  for (int t = 1; t < tiles; ++t) {
    float* rows = v + t * kTileRows;
    Lanes sums[kTogether];
    for (int c = 0; c < kTogether; ++c) sums[c] = lanes_at(rows + c * stride);
    for (int j = 0; j < width; ++j, tile += kTileRows) {
      const Lanes column = lanes_at(tile);
      for (int c = 0; c < kTogether; ++c) sums[c] -= column * v[c * stride + j];
    }
    for (int c = 0; c < kTogether; ++c) put(rows + c * stride, sums[c]);
  }
}

void backward_strip(const float* high, const float* inverse_transposed, int width, int tiles,
                    float* v) noexcept {
  kBackwardBelow[width - 1](high, tiles, v);
  put(v, square_times(inverse_transposed, v));
}

void invert_diagonal(const float* high, const float* low, int width, float* inverse,
                     float* inverse_transposed) noexcept {
  double unit[2][kTileRows][kTileRows] = {};
  double(*columns)[kTileRows] = unit[0];
  double(*rows)[kTileRows] = unit[1];
  for (int i = 0; i < kTileRows; ++i) columns[i][i] = rows[i][i] = 1;
  for (int j = 0; j < width; ++j) {
    for (int i = j + 1; i < kTileRows; ++i)
      subtract(rows[i], joined(high[j * kTileRows + i], low[j * kTileRows + i]), rows[j]);
  }
  for (int j = width - 1; j >= 0; --j) {
    for (int i = j + 1; i < kTileRows; ++i)
      subtract(columns[j], joined(high[j * kTileRows + i], low[j * kTileRows + i]), columns[i]);
  }
  for (int i = 0; i < kSquare; ++i) {
    inverse[i] = static_cast<float>(columns[i / kTileRows][i % kTileRows]);
    inverse_transposed[i] = static_cast<float>(rows[i / kTileRows][i % kTileRows]);
  }
}

void split(const double* values, int count, SplitColumns into) noexcept {
  for (int i = 0; i < count; ++i) {
    into.high[i] = static_cast<float>(values[i]);
    into.low[i] = static_cast<float>(values[i] - into.high[i]);
  }
}

bool downdate_diagonal(SplitColumns tile, int width, double* pivots, double* w, double* alpha,
                       Rotations& rotations) noexcept {
  bool enough = true;
  for (int j = 0; j < width; ++j) {
    double* pivot = rotations.pivot[j];
    double* gain = rotations.gain[j];
    enough &= turn_pivot(pivots[j], w + j, alpha, pivot, gain);
    double column[kTileRows];
    float* high = tile.high + j * kTileRows;
    float* low = tile.low + j * kTileRows;
    for (int half = 0; half < kTileRows; half += kHalf) put(column + half, joined(high + half, low + half));
    rotate_below(column, w, j, pivot, gain);
    for (int half = 0; half < kTileRows; half += kHalf)
      put_split(high + half, low + half, wide_at(column + half));
  }
  return enough;
}

void rotate_tile(SplitColumns tile, int width, const Rotations& rotations, double* w) noexcept {
  for (int half = 0; half < kTileRows; half += kHalf) {
    WideHalf rows[kRank];
    for (int k = 0; k < kRank; ++k) rows[k] = wide_at(w + k * kTileRows + half);
    for (int j = 0; j < width; ++j) {
      float* high = tile.high + j * kTileRows + half;
      float* low = tile.low + j * kTileRows + half;
      WideHalf column = joined(high, low);
      rotate(column, rows, rotations.pivot[j], rotations.gain[j]);
      put_split(high, low, column);
    }
    for (int k = 0; k < kRank; ++k) put(w + k * kTileRows + half, rows[k]);
  }
}

float column_dot(const float* a, const float* b, int count) noexcept {
  Lanes sum{};
  int i = 0;
  for (; i + kTileRows <= count; i += kTileRows) sum += lanes_at(a + i) * lanes_at(b + i);
  float total = 0;
  for (int l = 0; l < kTileRows; ++l) total += sum[l];
  for (; i < count; ++i) total += a[i] * b[i];
  return total;
}

void multiply_block_rows(const int* start, const int* neighbour, const double* block, int rows,
                         const double* u, double* f) noexcept {
  constexpr int kBlock = 9, kLastFour = kBlock - 4;
  for (int n = 0; n < rows; ++n) {
    Quad x{}, y{}, z{};
    for (int b = start[n]; b < start[n + 1]; ++b) {
      const double* K = block + static_cast<long>(b) * kBlock;
      const double* u_b = u + 3 * static_cast<long>(neighbour[b]);
      // four at a time: the first two columns and a value each of the next, the last with one before it
      x += quad_at(K) * u_b[0];
      y += quad_at(K + 3) * u_b[1];
      z += quad_at(K + kLastFour) * u_b[2];
    }
    for (int i = 0; i < 3; ++i) f[3 * static_cast<long>(n) + i] = x[i] + y[i] + z[i + 1];
  }
}

}  // namespace omentum::physics::kernels
