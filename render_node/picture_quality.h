// What each quality of a picture spends, from the finest to the coarsest.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// How light is computed, dearest first.
enum class Shading : std::uint8_t {
  kSoftShadows,  // at each pixel, with shadows whose edges are soft
  kHardShadows,  // at each pixel, one look into the shadow map
  kNoShadows,    // at each pixel, without a shadow map
  kPerVertex,    // at each vertex, without a shadow map: a pixel only mixes three colours
};
inline constexpr std::size_t kShadingCount = 4;

/// What they cost: docs/rendering.md.
struct QualityMeans {
  const char* word;  // in the report and on the panel
  int samples;       // per pixel, for smooth edges; 0: the pixel's middle
  float scale;       // of the picture's sides; below 1 it is stretched
  Shading shading;
  bool corners_alone = false;  // organs without the triangles that make them round (corner_triangles.h)
};

const QualityMeans& means_of(Quality quality);

/// Pixels that are drawn of a picture of that size.
Size drawn_size(Quality quality, Size picture);

}  // namespace omentum::render
