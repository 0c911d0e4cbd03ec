#include "organ_tools/phantom/label_volume.h"

#include "geometry/tetra_mesh.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

namespace omentum::phantom {
namespace {

// The fixed layout of a NIfTI-1 header; names as in nifti1.h, fields we leave at zero are only named.
struct NiftiHeader {
  std::int32_t sizeof_hdr = 348;
  char unused_analyze[36] = {};
  std::array<std::int16_t, 8> dim{};
  std::array<float, 3> intent_p{};
  std::int16_t intent_code = 1002;  // NIFTI_INTENT_LABEL
  std::int16_t datatype = 2;        // unsigned char
  std::int16_t bitpix = 8;
  std::int16_t slice_start = 0;
  std::array<float, 8> pixdim{};
  float vox_offset = 352;
  float scl_slope = 1, scl_inter = 0;
  std::int16_t slice_end = 0;
  char slice_code = 0;
  char xyzt_units = 2;  // millimetres
  float cal_max = 0, cal_min = 0, slice_duration = 0, toffset = 0;
  std::int32_t glmax = 0, glmin = 0;
  char descrip[80] = "Omentum phantom ";
  char aux_file[24] = {};
  std::int16_t qform_code = 0, sform_code = 1;
  std::array<float, 6> quaternion_and_offset{};
  std::array<float, 12> srow{};
  char intent_name[16] = {};
  char magic[4] = {'n', '+', '1', '\0'};
  char no_extension[4] = {};
};
static_assert(sizeof(NiftiHeader) == 352);

constexpr double kMillimetresPerMetre = 1000;
constexpr std::size_t kLongestName = 40;  // of an organ: what the description has room for

}  // namespace

LabelVolume sample(const ImplicitShape& shape, double spacing_m) {
  const Extent& extent = shape.extent;
  LabelVolume volume{shape.name, {}, extent.low, spacing_m, {}};
  for (int i = 0; i < 3; ++i) {
    volume.size[i] = static_cast<std::int16_t>(std::ceil((extent.high[i] - extent.low[i]) / spacing_m) + 1);
  }
  volume.labels.reserve(static_cast<std::size_t>(volume.size[0]) * volume.size[1] * volume.size[2]);
  for (int k = 0; k < volume.size[2]; ++k) {
    for (int j = 0; j < volume.size[1]; ++j) {
      for (int i = 0; i < volume.size[0]; ++i) {
        volume.labels.push_back(shape.distance(volume.origin + spacing_m * Vec3(i, j, k)) < 0 ? 1 : 0);
      }
    }
  }
  return volume;
}

void write_nifti(const LabelVolume& volume, const std::filesystem::path& file) {
  NiftiHeader header;
  volume.organ.copy(header.descrip + std::strlen(header.descrip), kLongestName);
  const auto spacing = static_cast<float>(kMillimetresPerMetre * volume.spacing_m);
  header.dim = {3, volume.size[0], volume.size[1], volume.size[2], 1, 1, 1, 1};
  header.pixdim = {1, spacing, spacing, spacing, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    header.srow[5 * i] = spacing;
    header.srow[4 * i + 3] =
        static_cast<float>(kMillimetresPerMetre * volume.origin[static_cast<Eigen::Index>(i)]);
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&header), sizeof(header));
  out.write(reinterpret_cast<const char*>(volume.labels.data()),
            static_cast<std::streamsize>(volume.labels.size()));
  out.close();
  if (!out) throw geometry::InputError(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace omentum::phantom
