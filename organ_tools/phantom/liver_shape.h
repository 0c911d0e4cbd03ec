// The project's own liver: an implicit shape, so that the phantom's meshes and volumes come from one
// definition.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

namespace omentum::phantom {

/// The scene's frame: z up, the patient's cranial side towards +y and right side towards -x. The convex
/// diaphragmatic face looks up, the visceral face down, the sharp inferior edge lies towards -y: big right
/// lobe, thinner left lobe, a notch in the edge between them, a fossa for the gallbladder on the underside.
/// About 18 cm across.
double liver_distance(const Vec3& p);

ImplicitShape liver();

}  // namespace omentum::phantom
