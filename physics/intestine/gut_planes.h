// A vector of each mass in the order that vector units like: all x, then all y, then all z.
#pragma once

#include "geometry/types.h"
#include "physics/intestine/gut_kernels.h"

#include <span>
#include <vector>

namespace omentum::physics {

class GutPlanes {
 public:
  explicit GutPlanes(std::size_t masses) : masses_(masses), values_(3 * masses) {}

  void take(std::span<const geometry::Vec3> vectors) noexcept;
  void give(std::span<geometry::Vec3> vectors) const noexcept;

  geometry::Vec3 at(std::size_t mass) const noexcept;
  void get(std::size_t mass, double* vector) const noexcept;
  void add(std::size_t mass, const double* vector) noexcept;
  kernels::Planes planes() noexcept;

 private:
  std::size_t masses_;
  std::vector<double> values_;  // [3][masses]
};

inline void GutPlanes::take(std::span<const geometry::Vec3> vectors) noexcept {
  for (std::size_t i = 0; i < masses_; ++i) {
    for (std::size_t k = 0; k < 3; ++k) values_[k * masses_ + i] = vectors[i][static_cast<Eigen::Index>(k)];
  }
}

inline void GutPlanes::give(std::span<geometry::Vec3> vectors) const noexcept {
  for (std::size_t i = 0; i < masses_; ++i) vectors[i] = at(i);
}

inline geometry::Vec3 GutPlanes::at(std::size_t mass) const noexcept {
  return {values_[mass], values_[masses_ + mass], values_[2 * masses_ + mass]};
}

inline void GutPlanes::get(std::size_t mass, double* vector) const noexcept {
  for (std::size_t k = 0; k < 3; ++k) vector[k] = values_[k * masses_ + mass];
}

inline void GutPlanes::add(std::size_t mass, const double* vector) noexcept {
  for (std::size_t k = 0; k < 3; ++k) values_[k * masses_ + mass] += vector[k];
}

inline kernels::Planes GutPlanes::planes() noexcept {
  return {values_.data(), values_.data() + masses_, values_.data() + 2 * masses_};
}

}  // namespace omentum::physics
