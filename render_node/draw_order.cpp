#include "render_node/draw_order.h"

#include <algorithm>
#include <array>

namespace omentum::render {
namespace {

// The mesentery is the last of the opaque ones: where it is blended they are all but that one.
constexpr std::array kOpaque{Look::kSolid,  Look::kGut,    Look::kTissue,   Look::kCut,
                             Look::kBared,  Look::kBlood,  Look::kMap,      Look::kWall,
                             Look::kGround, Look::kSignal, Look::kMesentery};
constexpr std::array kBlended{Look::kMesentery, Look::kSmoke};

}  // namespace

std::span<const Look> opaque_looks(Quality quality) {
  const std::span<const Look> all = kOpaque;
  return quality >= Quality::kCoarse ? all : all.first(all.size() - 1);
}

std::span<const Look> blended_looks(Quality quality) {
  return quality >= Quality::kCoarse ? std::span<const Look>() : kBlended;
}

bool casts_shadow(Look look) {
  constexpr std::array kLetThrough{Look::kWall, Look::kGround, Look::kSignal, Look::kMesentery, Look::kSmoke};
  return std::ranges::find(kLetThrough, look) == kLetThrough.end();
}

}  // namespace omentum::render
