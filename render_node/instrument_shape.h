// How instruments look: parts in the tool's frame T (origin at the tip, z towards the handle, x opens the
// jaws).
#pragma once

#include "render_node/renderer.h"
#include "scene/scene.h"

#include <Eigen/Geometry>

namespace omentum::render {

/// One rigid piece of one material.
struct InstrumentPart {
  MeshData mesh;  // in T, m, jaws closed
  Material material;
  float jaw = 0;      // 0: fixed to the shaft; +1 and -1: opens towards +x and -x by half the grip angle
  float hinge_z = 0;  // where it turns about y, m
  Vec3f glow_cutting = Vec3f::Zero();  // while its tool cuts
};

/// "grasper": insulated shaft, two toothed jaws (jaw_shape.h) between cheeks; a tool with an edge: an
/// electric hook (hook_shape.h), whose wire glows while it cuts; "endoscope": a steel tube with a lens
/// (scope_shape.h); everything else: a probe of steel with a round tip and a mark each centimetre. A band
/// near the tip carries the tool's colour.
std::vector<InstrumentPart> instrument_parts(const scene::ToolSpec& tool, const Vec3f& band_colour);

/// Where a part is, when the tool's tip is at p_WT with orientation q_WT and the jaws are open by grip_rad.
Mat4f part_pose(const InstrumentPart& part, const Eigen::Vector3d& p_WT, const Eigen::Quaterniond& q_WT,
                double grip_rad);

/// The colour of tool `id` wherever it appears (linear): band, arrow, curve.
Vec3f tool_colour(std::uint32_t id);

}  // namespace omentum::render
