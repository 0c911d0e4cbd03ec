// A small linear model of a piece of an organ that changes, as deform_node tells of it.
#pragma once

#include "haptic_node/deformed_surface.h"
#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// The surface around a place and how it yields: x = positions + C (f - load).
struct LocalPatch {
  std::uint32_t organ = 0;
  std::uint64_t topology_version = 0;
  std::vector<Vec3> positions;                // [n] m, in W, under `load`
  std::vector<Vec3> load;                     // [n] forces by tools, N
  std::vector<geometry::Triangle> triangles;  // outward; an open surface
  std::vector<float> compliance;         // upper triangle of the symmetric C, [3n (3n + 1) / 2], by rows, m/N
  std::vector<std::uint32_t> file_node;  // [n] place in the mesh file
};

/// More nodes than this are no small model: its compliance would take 9 MB.
inline constexpr std::size_t kMaxPatchNodes = 512;

/// Why a patch is none: lengths that do not fit, a node that is in no triangle, a number that is not finite,
/// a node that a force on it would draw the other way; nothing when it is one. What is refused here never
/// reaches a hand.
std::optional<std::string> reason_against(const LocalPatch& patch);

/// The body that a patch is. Not for the loop's thread: it allocates. The patch must be one.
std::unique_ptr<Body> make_local_body(const LocalPatch& patch);

}  // namespace omentum::haptic
