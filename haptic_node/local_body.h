// A small linear model of a piece of an organ that changes, as deform_node tells of it.
#pragma once

#include "haptic_node/deformed_surface.h"
#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// The surface around a place and how it yields, x = positions + C (f - forces): a LocalModel
/// (idl/contact.idl) whose velocities are left out.
struct LocalPatch {
  std::uint32_t organ = 0;
  std::uint64_t topology_version = 0;
  std::vector<std::uint32_t> nodes;           // [n] places in the mesh file
  std::vector<Vec3> positions;                // [n] m, in W, under `forces`
  std::vector<Vec3> forces;                   // [n] by tools, N
  std::vector<geometry::Triangle> triangles;  // outward; an open surface
  std::vector<float> compliance;              // upper triangle of the symmetric C, by rows, m/N
};

/// Why a patch is none in a session with so many organs: an organ that is not there, too many nodes or
/// triangles, lengths that do not fit, corners that are no nodes or fall together, a number that is not
/// finite or farther away than any scene, a compliance that is not positive definite: with it pressing would
/// give energy. Nothing when it is one.
std::optional<std::string> reason_against(const LocalPatch& patch, std::size_t organ_count);

/// The body that a patch is. Not for the loop's thread: it allocates. The patch must be one.
std::unique_ptr<Body> make_local_body(const LocalPatch& patch);

}  // namespace omentum::haptic
