// What an organ is: mesh, material, supports, tensors; and its file.
#pragma once

#include "geometry/surface.h"
#include "organ/split_organ.h"
#include "physics/material_map.h"
#include "physics/supports.h"
#include "physics/surface_compliance.h"

#include <filesystem>
#include <optional>
#include <string>

namespace omentum::organ {

using geometry::SurfaceId;
using physics::FixedComponents;

/// The precision that the tensors are stored in.
enum class Storage { kFloat, kDouble };

struct Organ {
  std::string name;  // from the file's stem, unless organ_build --name
  geometry::TetraMesh mesh;
  geometry::Surface surface;                             // pinned nodes last; loaded, without split->covered
  physics::MaterialMap material;                         // without regions of its own the mesh has no labels
  FixedComponents fixed;                                 // [N]
  std::optional<OrganSplit> split;                       // of a hybrid organ, whose tensors are of a part
  std::optional<physics::SurfaceCompliance> compliance;  // float; absent when not asked for
  std::string hash;  // SHA-256 (hexadecimal) over everything the tensors depend on: mesh, material,
                     // supports, storage, format version, dynamic part
  Storage storage = Storage::kFloat;  // of the tensors in the file; in memory they are float

  std::vector<SurfaceId> surface_of_file_node()
      const;  // [file_node_count], by position in the file; invalid where none;
              // of a merged node, that which took its place

  /// The mesh that the tensors were computed from, its boundary and its supports: of a hybrid organ those of
  /// its precomputed part.
  const geometry::TetraMesh& tensor_mesh() const { return split ? split->parts.precomputed.mesh : mesh; }
  const geometry::Surface& tensor_surface() const { return split ? split->surface : surface; }
  const FixedComponents& tensor_fixed() const { return split ? split->fixed : fixed; }
};

/// Of whole organs the tensors, or of hybrid ones those of their precomputed part (Organ::split).
enum class Load { kMeshOnly, kWithTensors, kWithPart };

/// Reads an organ file (HDF5). Tensors stored as float are mapped, not read: processes share them.
/// Throws geometry::InputError when the file is missing, truncated, unfinished, of another format version,
/// when its hash does not match its contents, when its tensors are of a part and not of the whole, or the
/// other way round from what is asked for, or when they contradict each other: whoever wrote it, every
/// index that it gives is in range (organ_check.h). Of the tensors, the bounds and the diagonal are looked at
/// (tensor_check.h); all of them only by is_up_to_date and by programs that have the time to read them.
Organ load_organ(const std::filesystem::path& file, Load what);

}  // namespace omentum::organ
