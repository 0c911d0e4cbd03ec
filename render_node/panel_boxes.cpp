#include "render_node/panel_boxes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

PixelBox around(const PixelBox& a, const PixelBox& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

PixelBox box_of(const ImDrawList& list, const ImDrawData& drawn) {
  if (list.VtxBuffer.empty()) return {};
  ImVec2 low = list.VtxBuffer[0].pos, high = low;
  for (const ImDrawVert& vertex : list.VtxBuffer) {
    low = {std::min(low.x, vertex.pos.x), std::min(low.y, vertex.pos.y)};
    high = {std::max(high.x, vertex.pos.x), std::max(high.y, vertex.pos.y)};
  }
  const auto pixel = [](float at, float origin, float scale, float most) {
    return static_cast<int>(std::clamp((at - origin) * scale, 0.0f, most));
  };
  const ImVec2 origin = drawn.DisplayPos, scale = drawn.FramebufferScale;
  const ImVec2 most{drawn.DisplaySize.x * scale.x, drawn.DisplaySize.y * scale.y};
  return {pixel(std::floor(low.x), origin.x, scale.x, most.x),
          pixel(std::floor(low.y), origin.y, scale.y, most.y),
          pixel(std::ceil(high.x), origin.x, scale.x, most.x),
          pixel(std::ceil(high.y), origin.y, scale.y, most.y)};
}

}  // namespace

std::vector<PixelBox> disjoint(std::vector<PixelBox> boxes) {
  std::erase_if(boxes, [](const PixelBox& box) { return box.empty(); });
  std::vector<PixelBox> apart;
  while (!boxes.empty()) {
    PixelBox box = boxes.back();
    boxes.pop_back();
    const auto hit = std::ranges::find_if(apart, [&](const PixelBox& other) { return overlap(box, other); });
    if (hit == apart.end()) {
      apart.push_back(box);
      continue;
    }
    boxes.push_back(around(box, *hit));  // which may reach another one
    apart.erase(hit);
  }
  return apart;
}

std::vector<PixelBox> boxes_of(const ImDrawData& drawn) {
  std::vector<PixelBox> boxes;
  for (int i = 0; i < drawn.CmdListsCount; ++i) boxes.push_back(box_of(*drawn.CmdLists[i], drawn));
  return disjoint(std::move(boxes));
}

}  // namespace omentum::render
