// A grasper's jaws, drawn where its points collide.
#pragma once

#include "render_node/renderer.h"
#include "scene/scene.h"

namespace omentum::render {

/// What jaws look like, made of the points p_TP that haptic_node moves with them (jaws closed), m: whoever
/// sees a jaw touch feels it touch.
struct JawForm {
  float radius = 0.0025f;    // across both closed jaws, at their widest
  float widest_z = 0.0025f;  // there
  bool round = true;         // a hemisphere's tip; else blunt, with these half sizes across
  float tip_x = 0, tip_y = 0;
  bool hollow = true;   // spoons, whose thin wall has the points; else flat inner faces
  bool blades = false;  // flat faces that stand apart even when closed, on arms from the hinge
  float gap = 0;        // half of what is between the closed jaws' inner faces or rims
};
JawForm jaw_form(const scene::ToolSpec& tool);

/// The jaw on the side of +x (`side` 1) or -x (-1), closed, in T: from the tip to the hinge, teeth inside.
MeshData jaw_mesh(const JawForm& form, float side);

/// What holds the jaws: two cheeks beside them, and the pin that they turn about, in T.
MeshData cheeks_mesh(float radius);
MeshData pin_mesh(float radius);

}  // namespace omentum::render
