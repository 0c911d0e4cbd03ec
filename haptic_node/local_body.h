// A small linear model of a piece of an organ that changes, as deform_node tells of it.
#pragma once

#include "haptic_node/deformed_surface.h"
#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// The surface around a tool, how it moves and how it yields,
///     x = positions + t velocities + C (f - forces):
/// a LocalModel (idl/contact.idl).
struct LocalPatch {
  std::uint32_t organ = 0;
  std::optional<std::size_t> tool;  // of the model: it alone touches the patch; none: any does
  std::int64_t arrival_ns = 0;      // when t was 0, on HapticState's clock
  std::uint64_t topology_version = 0;
  std::vector<std::uint32_t> nodes;  // [n] places in the mesh file
  std::vector<Vec3> at_rest;         // [n] in the organ's file, m, in W; or empty: not known
  bool bends_freely = false;         // where it lies without forces says which way it pushes, not its rest
  std::vector<Vec3> positions;       // [n] m, in W, under `forces`
  std::vector<Vec3> velocities;      // [n] m/s, in W; or empty: at rest
  std::vector<Vec3> forces;          // [n] by the tool, N
  std::vector<geometry::Triangle> triangles;  // outward; an open surface
  std::vector<float> compliance;              // upper triangle of the symmetric C, by rows, m/N
};

/// Why a patch is none in a session with so many organs: an organ that is not there, too many nodes or
/// triangles, lengths that do not fit, corners that are no nodes or fall together, a number that is not
/// finite, farther away than any scene, faster or softer than any tissue, a compliance that is not positive
/// definite: with it pressing would give energy. Nothing when it is one.
std::optional<std::string> reason_against(const LocalPatch& patch, std::size_t organ_count);

/// A surface goes on by its velocities for so long; the next model is late then, and it stands, s.
inline constexpr double kLongestDrift_s = 0.02;
/// Where a model replaces another one, its surface comes from where that stood to its own place in so long,
/// s: about what lies between two models, so that a hand feels no step of either.
inline constexpr double kBlend_s = 0.01;

/// The body that a patch is. Not for the loop's thread: it allocates. The patch must be one.
std::unique_ptr<Body> make_local_body(const LocalPatch& patch);

}  // namespace omentum::haptic
