// Nothing but loops on raw pointers and no library header with inline functions: this file alone is
// compiled for this machine's vector unit (omentum_native).
#include "physics/superpose_kernels.h"

namespace omentum::physics::kernels {

namespace {

// Sixteen lanes as one value; the compiler splits it where registers are narrower.
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));

// The same at any address.
struct __attribute__((packed, may_alias)) LooseLanes {
  Lanes lanes;
};

inline const Lanes& tile_plane(const float* tile, int plane) {
  return *reinterpret_cast<const Lanes*>(tile + plane * kLanes);
}

inline const LooseLanes& at(const float* p) {
  return *reinterpret_cast<const LooseLanes*>(p);
}
inline LooseLanes& at(float* p) {
  return *reinterpret_cast<LooseLanes*>(p);
}

inline float larger(float a, float b) {
  return a > b ? a : b;
}

// Room for the rounding of four sums and two roundings, each below 2^-23 relative.
constexpr float kRoundUp = 1 + 8e-7f;

}  // namespace

void superpose_tile(const float* const* tiles, const float* forces, int count, bool accumulate,
                    float* u) noexcept {
  Lanes x{}, y{}, z{};
  if (accumulate) {
    x = at(u).lanes;
    y = at(u + kLanes).lanes;
    z = at(u + 2 * kLanes).lanes;
  }
  for (int q = 0; q < count; ++q) {
    const float* tile = tiles[q];
    const float f0 = forces[3 * q], f1 = forces[3 * q + 1], f2 = forces[3 * q + 2];
    x += tile_plane(tile, 0) * f0 + tile_plane(tile, 1) * f1 + tile_plane(tile, 2) * f2;
    y += tile_plane(tile, 3) * f0 + tile_plane(tile, 4) * f1 + tile_plane(tile, 5) * f2;
    z += tile_plane(tile, 6) * f0 + tile_plane(tile, 7) * f1 + tile_plane(tile, 8) * f2;
  }
  at(u).lanes = x;
  at(u + kLanes).lanes = y;
  at(u + 2 * kLanes).lanes = z;
}

void superpose_columns(const float* const* columns, const float* forces, int count, std::size_t clusters,
                       bool accumulate, float* u) noexcept {
  const float* tiles[kMaxColumns];
  for (int q = 0; q < count; ++q) tiles[q] = columns[q];
  for (std::size_t c = 0; c < clusters; ++c) {
    superpose_tile(tiles, forces, count, accumulate, u + c * 3 * kLanes);
    for (int q = 0; q < count; ++q) tiles[q] += kTile;
  }
}

void bound_tile(const float* tile, float* norms) noexcept {
  for (int l = 0; l < kLanes; ++l) {
    float row = 0, column = 0;
    for (int i = 0; i < 3; ++i) {
      float along_row = 0, along_column = 0;
      for (int j = 0; j < 3; ++j) {
        along_row += __builtin_fabsf(tile[(3 * i + j) * kLanes + l]);
        along_column += __builtin_fabsf(tile[(3 * j + i) * kLanes + l]);
      }
      row = larger(row, along_row);
      column = larger(column, along_column);
    }
    norms[l] = __builtin_sqrtf(row) * __builtin_sqrtf(column) * kRoundUp;
  }
}

}  // namespace omentum::physics::kernels
