#include "organ/tensor_check.h"

#include "organ/hdf5_file.h"
#include "organ/organ_layout.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>

namespace omentum::organ {

namespace {

using geometry::InputError;

// What is hashed between two calls of on_read, bytes.
constexpr std::size_t kPart = std::size_t{1} << 24;

// Rounding of a block that was stored in single precision, of its largest entry.
constexpr double kRounding = 1e-6;

class Xxh3 {
 public:
  Xxh3() : state_(XXH3_createState(), XXH3_freeState) {
    if (!state_) throw std::bad_alloc();
    XXH3_64bits_reset(state_.get());
  }
  void add(const void* data, std::size_t bytes) { XXH3_64bits_update(state_.get(), data, bytes); }
  std::string hexadecimal() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits_digest(state_.get())));
    return text;
  }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

std::span<const float> bounds_of(const StoredTensors& tensors, std::int32_t mobile) {
  const auto columns = static_cast<std::size_t>(mobile);
  return {tensors.bounds, columns * ((columns + geometry::kClusterSize - 1) / geometry::kClusterSize)};
}

// Whether a diagonal block can be one of a compliance. `held`: its node's supports; `bound`: of its norm,
// m/N.
bool is_compliance(const Eigen::Matrix3d& C_kk, std::uint8_t held, float bound) {
  const double largest = C_kk.cwiseAbs().maxCoeff();
  // written so that a NaN is refused
  if (!(largest > 0) || !(largest <= bound * (1 + kRounding))) return false;
  if (!((C_kk - C_kk.transpose()).cwiseAbs().maxCoeff() <= kRounding * largest)) return false;
  for (int i = 0; i < 3; ++i) {
    if (physics::is_fixed(held, i) ? !C_kk.col(i).isZero(0) : !(C_kk(i, i) > 0)) return false;
  }
  return true;
}

template <class Scalar>
void require_sound_diagonal(const physics::ComplianceTiles<Scalar>& tiles, std::span<const float> bounds,
                            const Organ& organ, const std::filesystem::path& file) {
  for (std::int32_t k = 0; k < tiles.mobile_count; ++k) {
    Eigen::Matrix3d C_kk;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) C_kk(i, j) = static_cast<double>(tiles.at(k, i, k, j));
    }
    const std::size_t own = static_cast<std::size_t>(k) * tiles.cluster_count() + k / geometry::kClusterSize;
    if (!is_compliance(C_kk, organ.tensor_fixed()[organ.tensor_surface().node[k]], bounds[own])) {
      throw InputError(file.string() + ": its tensors are damaged: column " + std::to_string(k) +
                       " has a diagonal that no elastic organ has; build it again");
    }
  }
}

}  // namespace

template <class Scalar>
std::string tensor_checksum(const physics::ComplianceTiles<Scalar>& tiles, std::span<const float> bounds,
                            const std::function<void(const void*, std::size_t)>& on_read) {
  Xxh3 hash;
  hash.add(bounds.data(), bounds.size_bytes());
  const auto* const begin = reinterpret_cast<const std::byte*>(tiles.values);
  const std::size_t bytes = tiles.size() * sizeof(Scalar);
  for (std::size_t at = 0; at < bytes; at += kPart) {
    const std::size_t part = std::min(kPart, bytes - at);
    hash.add(begin + at, part);
    if (on_read) on_read(begin + at, part);
  }
  return hash.hexadecimal();
}

void require_sound(const StoredTensors& tensors, const Organ& organ, const std::filesystem::path& file) {
  const std::span<const float> bounds = bounds_of(tensors, organ.tensor_surface().mobile_count);
  for (const float bound : bounds) {
    if (bound >= 0 && std::isfinite(bound)) continue;
    throw InputError(file.string() + ": its tensors are damaged: a bound is " + std::to_string(bound) +
                     "; build it again");
  }
  if (tensors.storage == Storage::kFloat) {
    require_sound_diagonal(tensors.single, bounds, organ, file);
  } else {
    require_sound_diagonal(tensors.twofold, bounds, organ, file);
  }
}

void require_whole(const StoredTensors& tensors, const std::filesystem::path& file) {
  const bool single = tensors.storage == Storage::kFloat;
  const std::span<const float> bounds =
      bounds_of(tensors, single ? tensors.single.mobile_count : tensors.twofold.mobile_count);
  const std::string found =
      single ? tensor_checksum(tensors.single, bounds) : tensor_checksum(tensors.twofold, bounds);
  const Hdf5File hdf5(file, Hdf5File::Mode::kRead);
  const std::string expected = hdf5.read_text(layout::kChecksum);
  if (found == expected) return;
  throw InputError(file.string() + ": its tensors are damaged (checksum " + found + ", expected " + expected +
                   "); build it again");
}

template std::string tensor_checksum(const physics::ComplianceTiles<float>&, std::span<const float>,
                                     const std::function<void(const void*, std::size_t)>&);
template std::string tensor_checksum(const physics::ComplianceTiles<double>&, std::span<const float>,
                                     const std::function<void(const void*, std::size_t)>&);
template std::string tensor_checksum(const physics::ComplianceTiles<const float>&, std::span<const float>,
                                     const std::function<void(const void*, std::size_t)>&);
template std::string tensor_checksum(const physics::ComplianceTiles<const double>&, std::span<const float>,
                                     const std::function<void(const void*, std::size_t)>&);

}  // namespace omentum::organ
