// How deep a tool dents an organ.
#pragma once

#include "render_node/organ_skin.h"

#include <optional>

namespace omentum::render {

/// The place that a tool presses, in W.
struct Dent {
  double depth_m = 0;              // of the pressed surface below its surroundings; never negative
  Vec3f bottom = Vec3f::Zero();    // of the deformed surface, m
  Vec3f outward = Vec3f::UnitZ();  // of the rest surface there, unit
};

/// A node that a tool presses, and the force that it bears, N.
struct PressedNode {
  geometry::SurfaceId node;
  float force_n = 0;
};

/// The dent's depth is what the tool adds to the bending of the whole organ:
///   depth = (u_c - mean of u over the ring) . (-n)
/// with u_c and n the displacement and the rest surface's outward normal at the contact (means over its
/// nodes, each weighted by its force; for a contact inside one triangle u_c is the displacement of the
/// contact point itself), and the ring all nodes of the same side of the organ that lie kRingRadius_m from
/// the contact at rest, give or take kRingHalfWidth. Where a mesh is too coarse to have any, the surroundings
/// count as being at rest. None where no node bears a force. Costs a pass over the surface.
std::optional<Dent> measure_dent(const OrganSkin& skin, std::span<const PressedNode> pressed);

// A point load's dent falls off as one over the distance: 35 mm from a tip of 4 mm radius a ninth of it is
// left. On an organ smaller than a liver the ring is a share of its longest side, so that it stays on the
// organ.
inline constexpr double kRingRadius_m = 0.035, kRingRadiusShare = 0.2;
inline constexpr double kRingHalfWidth = 0.15;  // of the radius: one triangle wide on a coarse liver

}  // namespace omentum::render
