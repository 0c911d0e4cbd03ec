#include "organ/stored_tensors.h"

#include "organ/hdf5_file.h"
#include "organ/mapped_file.h"
#include "organ/organ_layout.h"
#include "organ/tensor_check.h"

#include <algorithm>
#include <new>

namespace omentum::organ {

namespace {

constexpr std::size_t kCacheLine = 64;  // bytes; what the superpose kernels ask for

template <class T>
const T* numbers_at(const MappedFile& mapped, const Extent& extent, const std::filesystem::path& file) {
  if (extent.offset > mapped.size() || extent.bytes > mapped.size() - extent.offset) {
    throw geometry::InputError(file.string() + ": is truncated: " + std::to_string(mapped.size()) +
                               " bytes do not hold " + std::to_string(extent.bytes) + " at " +
                               std::to_string(extent.offset));
  }
  if (extent.offset % kCacheLine != 0) {
    throw geometry::InputError(file.string() +
                               ": its tensors are not aligned; expected multiples of 64 bytes");
  }
  return reinterpret_cast<const T*>(mapped.data() + extent.offset);
}

}  // namespace

StoredTensors map_tensors(const std::filesystem::path& file, const Organ& organ) {
  const std::int32_t columns = organ.tensor_surface().mobile_count;
  const auto mobile = static_cast<std::uint64_t>(columns);
  const std::uint64_t clusters = (mobile + geometry::kClusterSize - 1) / geometry::kClusterSize;
  const std::vector<std::uint64_t> shape{mobile, clusters, 9, geometry::kClusterSize};

  StoredTensors tensors;
  tensors.storage = organ.storage;
  const Hdf5File hdf5(file, Hdf5File::Mode::kRead);
  const auto mapped = std::make_shared<MappedFile>(file, MappedFile::Access::kRead);
  if (organ.storage == Storage::kFloat) {
    tensors.single = {columns,
                      numbers_at<float>(*mapped, hdf5.locate<float>(layout::kCompliance, shape), file)};
  } else {
    tensors.twofold = {columns,
                       numbers_at<double>(*mapped, hdf5.locate<double>(layout::kCompliance, shape), file)};
  }
  tensors.bounds = numbers_at<float>(*mapped, hdf5.locate<float>(layout::kBounds, {mobile, clusters}), file);
  tensors.keep_alive = mapped;
  require_sound(tensors, organ, file);
  return tensors;
}

physics::SurfaceCompliance surface_compliance(const StoredTensors& tensors) {
  if (tensors.storage == Storage::kFloat) {
    return {tensors.single.mobile_count, tensors.single.values, tensors.bounds, tensors.keep_alive};
  }
  // Tiles and bounds in one block of their own.
  const std::size_t tiles = tensors.twofold.size();
  const std::size_t bounds = tiles / physics::ComplianceTiles<float>::kTileSize;
  constexpr std::align_val_t kAligned{kCacheLine};
  auto* const values = static_cast<float*>(::operator new((tiles + bounds) * sizeof(float), kAligned));
  const std::shared_ptr<const void> owner(
      values, [](const void* p) { ::operator delete (const_cast<void*>(p), std::align_val_t{kCacheLine}); });
  std::copy_n(tensors.twofold.values, tiles, values);
  std::copy_n(tensors.bounds, bounds, values + tiles);
  return {tensors.twofold.mobile_count, values, values + tiles, owner};
}

}  // namespace omentum::organ
