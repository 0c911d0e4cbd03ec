// A labelled volume of one of the phantom's organs, as a segmented scan would give it.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace omentum::phantom {

/// Labels of voxels; x runs fastest. 0: outside, 1: the organ.
struct LabelVolume {
  std::string organ;
  std::array<std::int16_t, 3> size;
  Vec3 origin;  // centre of voxel (0,0,0), m
  double spacing_m;
  std::vector<std::uint8_t> labels;  // [size[0] * size[1] * size[2]]
};

/// Samples the organ at voxel centres.
LabelVolume sample(const ImplicitShape& shape, double spacing_m);

/// Writes NIfTI-1 (https://nifti.nimh.nih.gov/nifti-1), a single uncompressed .nii, in millimetres as is
/// usual there. Throws geometry::InputError when the file cannot be written.
void write_nifti(const LabelVolume& volume, const std::filesystem::path& file);

}  // namespace omentum::phantom
