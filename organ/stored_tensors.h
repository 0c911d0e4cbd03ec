// The tensors of an organ file in the precision that they are stored in, mapped.
#pragma once

#include "organ/organ.h"
#include "physics/compliance_tiles.h"

#include <memory>

namespace omentum::organ {

/// Read-only; any thread. One of the two tile views is empty, by `storage`.
struct StoredTensors {
  Storage storage = Storage::kFloat;
  physics::ComplianceTiles<const float> single;    // kFloat
  physics::ComplianceTiles<const double> twofold;  // kDouble
  const float* bounds = nullptr;                   // [mobile][clusters]
  std::shared_ptr<const void> keep_alive;          // shared: whoever reads the tiles keeps the file mapped
};

/// Throws geometry::InputError as load_organ does, require_sound included. `organ` is what load_organ gave
/// for the same file.
StoredTensors map_tensors(const std::filesystem::path& file, const Organ& organ);

/// Float tensors as they are; double ones rounded into memory of their own.
physics::SurfaceCompliance surface_compliance(const StoredTensors& tensors);

}  // namespace omentum::organ
