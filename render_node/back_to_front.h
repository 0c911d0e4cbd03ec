// The order in which what light shines through is drawn.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// What is blended over what lies behind it has to come after it: of the triangles that face the eye the
/// farthest by its middle comes first. Those that face away are never drawn and come before all others. Right
/// for triangles that are small against their distances. `ordered`: the mesh's, once each.
class BackToFront {
 public:
  std::span<const MeshTriangle> order(const MeshData& mesh, const Vec3f& eye);

 private:
  struct Far {
    float squared_m2;  // from the eye
    std::uint32_t triangle;
  };
  std::vector<Far> facing_;
  std::vector<MeshTriangle> ordered_;
};

}  // namespace omentum::render
