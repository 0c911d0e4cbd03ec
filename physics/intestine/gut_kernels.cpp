#include "physics/intestine/gut_kernels.h"

namespace omentum::physics::kernels {

namespace {

constexpr std::size_t kChunk = 256;   // springs whose forces are on the stack before they are given to masses
constexpr int kSums = 8;              // lanes of a sum
constexpr double kNoLength2 = 1e-30;  // m^2: keeps a spring without length from dividing by it

#define OMENTUM_GUT_INLINE static inline __attribute__((always_inline))

// d between the ends of spring i. No branch in any of these: the loops around them become vector code.
OMENTUM_GUT_INLINE double across(const SpringRun& run, const double* x, std::size_t i) {
  return x[i + run.offset] - x[i];
}
OMENTUM_GUT_INLINE double across(const BendRun&, const double* x, std::size_t i) {
  return 0.5 * (x[i] + x[i + 2]) - x[i + 1];
}

OMENTUM_GUT_INLINE void give(const SpringRun& run, std::size_t first, std::size_t count, const double* pull,
                             double* f) {
  for (std::size_t i = 0; i < count; ++i) f[first + i] += pull[i];
  for (std::size_t i = 0; i < count; ++i) f[first + i + run.offset] -= pull[i];
}
OMENTUM_GUT_INLINE void give(const BendRun&, std::size_t first, std::size_t count, const double* pull,
                             double* f) {
  for (std::size_t i = 0; i < count; ++i) f[first + i + 1] += pull[i];
  for (std::size_t i = 0; i < count; ++i) f[first + i] -= 0.5 * pull[i];
  for (std::size_t i = 0; i < count; ++i) f[first + i + 2] -= 0.5 * pull[i];
}

template <class Run>
OMENTUM_GUT_INLINE double length(const Run& run, const Planes& at, std::size_t i) {
  const double x = across(run, at.x, i), y = across(run, at.y, i), z = across(run, at.z, i);
  return __builtin_sqrt(x * x + y * y + z * z + kNoLength2);
}

template <class Run>
OMENTUM_GUT_INLINE double measure_run(const Run& run, const Planes& at, double* __restrict__ l) {
  for (std::size_t i = 0; i < run.count; ++i) l[i] = length(run, at, i);
  double sums[kSums] = {};
  std::size_t i = 0;
  for (; i + kSums <= run.count; i += kSums) {
    for (int s = 0; s < kSums; ++s)
      sums[s] += run.k[i + s] * (l[i + s] - run.rest[i + s]) * (l[i + s] - run.rest[i + s]);
  }
  double sum = 0;
  for (; i < run.count; ++i) sum += run.k[i] * (l[i] - run.rest[i]) * (l[i] - run.rest[i]);
  for (const double s : sums) sum += s;
  return sum;
}

// `factor(i, d, l2)`: the force of spring i over its d.
template <class Run, class Factor>
OMENTUM_GUT_INLINE void add_run(const Run& run, const Planes& at, const Planes& f, const Factor& factor) {
  double px[kChunk], py[kChunk], pz[kChunk];
  for (std::size_t first = 0; first < run.count; first += kChunk) {
    const std::size_t count = run.count - first < kChunk ? run.count - first : kChunk;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t i = first + j;
      const double x = across(run, at.x, i), y = across(run, at.y, i), z = across(run, at.z, i);
      const double s = factor(i, x, y, z, x * x + y * y + z * z + kNoLength2);
      px[j] = s * x;
      py[j] = s * y;
      pz[j] = s * z;
    }
    give(run, first, count, px, f.x);
    give(run, first, count, py, f.y);
    give(run, first, count, pz, f.z);
  }
}

template <class Run>
OMENTUM_GUT_INLINE void add_pulls(const Run& run, double stiffer, const double* pull, const Planes& at,
                                  const Planes& f) {
  add_run(run, at, f, [&](std::size_t i, double, double, double, double l2) {
    return stiffer * run.k[i] - pull[i] / __builtin_sqrt(l2);
  });
}

template <class Run>
OMENTUM_GUT_INLINE void add_damped(const Run& run, double tau, const Planes& at, const Planes& v,
                                   const Planes& f) {
  add_run(run, at, f, [&](std::size_t i, double x, double y, double z, double l2) {
    const double rate = x * across(run, v.x, i) + y * across(run, v.y, i) + z * across(run, v.z, i);
    return run.k[i] * (1 - run.rest[i] / __builtin_sqrt(l2) + tau * rate / l2);
  });
}

typedef double Lanes4 __attribute__((vector_size(32)));

OMENTUM_GUT_INLINE Lanes4& lanes(PaddedNode& node) {
  return *reinterpret_cast<Lanes4*>(node.v);
}

// One row after the other waits for the one before: the last ones stay in registers.
template <std::size_t width>
OMENTUM_GUT_INLINE void solve_fixed(std::size_t size, const double* lower, const double* upper,
                                    const double* inverse, PaddedNode* b) {
  Lanes4 last[width] = {};  // last[j]: of row i - width + j
  for (std::size_t i = 0; i < size; ++i) {
    Lanes4 x = lanes(b[i]);
    for (std::size_t j = 0; j < width; ++j) x -= lower[i * width + j] * last[j];
    for (std::size_t j = 0; j + 1 < width; ++j) last[j] = last[j + 1];
    lanes(b[i]) = last[width - 1] = x;
  }
  Lanes4 next[width] = {};  // next[j]: of row i + width - j
  for (std::size_t i = size; i-- > 0;) {
    Lanes4 x = inverse[i] * lanes(b[i]);
    for (std::size_t j = 0; j < width; ++j) x -= upper[i * width + width - 1 - j] * next[j];
    for (std::size_t j = 0; j + 1 < width; ++j) next[j] = next[j + 1];
    lanes(b[i]) = next[width - 1] = x;
  }
}

OMENTUM_GUT_INLINE void solve_any(std::size_t size, std::size_t width, const double* lower,
                                  const double* upper, const double* inverse, PaddedNode* b) {
  for (std::size_t i = 0; i < size; ++i) {
    Lanes4 x = lanes(b[i]);
    for (std::size_t j = i < width ? width - i : 0; j < width; ++j)
      x -= lower[i * width + j] * lanes(b[i + j - width]);
    lanes(b[i]) = x;
  }
  for (std::size_t i = size; i-- > 0;) {
    Lanes4 x = inverse[i] * lanes(b[i]);
    for (std::size_t j = 0; j < width && i + 1 + j < size; ++j)
      x -= upper[i * width + j] * lanes(b[i + 1 + j]);
    lanes(b[i]) = x;
  }
}

}  // namespace

double measure(const SpringRun& run, Planes at, double* l) noexcept {
  return measure_run(run, at, l);
}

double measure(const BendRun& run, Planes at, double* l) noexcept {
  return measure_run(run, at, l);
}

void set_pull(std::size_t count, const double* k, const double* rest, double damping, const double* l,
              double* __restrict__ pull) noexcept {
  for (std::size_t i = 0; i < count; ++i) pull[i] = k[i] * (rest[i] + damping * l[i]);
}

void add_forces(const SpringRun& run, double stiffer, const double* pull, Planes at, Planes f) noexcept {
  add_pulls(run, stiffer, pull, at, f);
}

void add_forces(const BendRun& run, double stiffer, const double* pull, Planes at, Planes f) noexcept {
  add_pulls(run, stiffer, pull, at, f);
}

void add_damped_forces(const SpringRun& run, double tau_s, Planes at, Planes v, Planes f) noexcept {
  add_damped(run, tau_s, at, v, f);
}

void add_damped_forces(const BendRun& run, double tau_s, Planes at, Planes v, Planes f) noexcept {
  add_damped(run, tau_s, at, v, f);
}

void begin_forces(std::size_t count, Planes constant, const double* weight, Planes at, Planes f) noexcept {
  for (std::size_t i = 0; i < count; ++i) f.x[i] = constant.x[i] - weight[i] * at.x[i];
  for (std::size_t i = 0; i < count; ++i) f.y[i] = constant.y[i] - weight[i] * at.y[i];
  for (std::size_t i = 0; i < count; ++i) f.z[i] = constant.z[i] - weight[i] * at.z[i];
}

void solve_band(std::size_t size, std::size_t width, const double* lower, const double* upper,
                const double* inverse_diagonal, PaddedNode* b) noexcept {
  if (width == 6) return solve_fixed<6>(size, lower, upper, inverse_diagonal, b);  // the paper's four rows
  solve_any(size, width, lower, upper, inverse_diagonal, b);
}

}  // namespace omentum::physics::kernels
