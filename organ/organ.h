// What an organ is: mesh, material, supports, tensors; and its file.
#pragma once

#include "geometry/surface.h"
#include "physics/material.h"
#include "physics/surface_compliance.h"

#include <filesystem>
#include <optional>
#include <string>

namespace omentum::organ {

/// Which components of which nodes are held: [N] bit sets, 1 = x, 2 = y, 4 = z; 7 = pinned.
using FixedComponents = std::vector<std::uint8_t>;

struct Organ {
  std::string name;                       // from the file's stem
  geometry::TetraMesh mesh;
  geometry::Surface surface;              // pinned nodes last
  physics::Material material;
  FixedComponents fixed;                  // [N]
  std::optional<physics::SurfaceCompliance> compliance;  // float; absent when not asked for
  std::string hash;                       // SHA-256 (hexadecimal) over everything the tensors depend on: mesh, material,
                                          // supports, storage, format version
  std::vector<SurfaceId> surface_of_file_node() const;   // [file_node_count], invalid where none
};
using physics::SurfaceId;

enum class Load { kMeshOnly, kWithTensors };

/// Reads an organ file (HDF5). Tensors stored as float are mapped, not read: processes share them.
/// Throws geometry::InputError when the file is missing, truncated, unfinished, of another format version,
/// or when its hash does not match its contents.
Organ load_organ(const std::filesystem::path& file, Load what);

}  // namespace omentum::organ
