// The project's own liver: an implicit shape, so that the phantom's meshes and volumes come from one
// definition.
#pragma once

#include "geometry/types.h"

namespace omentum::phantom {

using geometry::Vec3;

/// Negative inside the liver, positive outside, zero on its surface; about the distance in metres near it.
/// The scene's frame: z up, the patient's cranial side towards +y and right side towards -x. The convex
/// diaphragmatic face looks up, the visceral face down, the sharp inferior edge lies towards -y: big right
/// lobe, thinner left lobe, a notch in the edge between them, a fossa for the gallbladder on the underside.
/// About 18 cm across.
double liver_distance(const Vec3& p);

/// A box that holds the liver with a margin of a few millimetres, m.
struct Extent {
  Vec3 low, high;
};
Extent liver_extent();

}  // namespace omentum::phantom
