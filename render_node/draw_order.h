// In which order looks are drawn, and which of them what lies behind shines through.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// What hides the rest comes first, so that hidden pixels are never shaded; then the backdrop, and over it
/// what is blended.
std::span<const Look> opaque_looks(Quality quality);
/// Drawn after all that, the farthest first, without hiding each other: nothing from the coarse quality on,
/// where a mesentery is opaque and there is no smoke.
std::span<const Look> blended_looks(Quality quality);
/// Whether it darkens what is behind it: neither ground, wall nor signals, nor what light goes through.
bool casts_shadow(Look look);

}  // namespace omentum::render
