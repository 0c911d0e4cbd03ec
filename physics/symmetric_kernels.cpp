// Nothing but loops on raw pointers, as superpose_kernels.cpp.
#include "physics/symmetric_kernels.h"

namespace omentum::physics::kernels {

namespace {

#if defined(__AVX512F__)
constexpr std::size_t kSide = 8;
#elif defined(__AVX__)
constexpr std::size_t kSide = 4;
#else
constexpr std::size_t kSide = 2;
#endif

typedef double Lanes __attribute__((vector_size(kSide * sizeof(double)), may_alias));

inline double sum(Lanes a) {
  for (std::size_t half = kSide / 2; half > 0; half /= 2)
    for (std::size_t l = 0; l < half; ++l) a[l] += a[l + half];
  return a[0];
}

}  // namespace

std::size_t symmetric_tile_side() noexcept {
  return kSide;
}

// A tile below the diagonal counts once as it is, and once as its mirror image.
void symmetric_product(const double* tiles, std::size_t columns, const double* x, double* y) noexcept {
  const auto* a = reinterpret_cast<const Lanes*>(tiles);
  const auto* x_of = reinterpret_cast<const Lanes*>(x);
  auto* y_of = reinterpret_cast<Lanes*>(y);
  for (std::size_t j = 0; j < columns; ++j) y_of[j] = Lanes{};
  for (std::size_t j = 0; j < columns; ++j) {
    const double* x_j = x + kSide * j;
    Lanes y_j = y_of[j];
    for (std::size_t k = 0; k < kSide; ++k) y_j += *a++ * x_j[k];
    Lanes mirrored[kSide] = {};
    for (std::size_t i = j + 1; i < columns; ++i) {
      Lanes y_i = y_of[i];
      for (std::size_t k = 0; k < kSide; ++k, ++a) {
        y_i += *a * x_j[k];
        mirrored[k] += *a * x_of[i];
      }
      y_of[i] = y_i;
    }
    for (std::size_t k = 0; k < kSide; ++k) y_j[k] += sum(mirrored[k]);
    y_of[j] = y_j;
  }
}

}  // namespace omentum::physics::kernels
