// What time, presses and cuts change of what the renderer holds of organs.
#include "render_node/draw_order.h"
#include "render_node/scene_view.h"

namespace omentum::render {

void SceneView::live(std::size_t organ, std::span<const NodeForce> forces, double dt_s) {
  organs_[organ].stale |= organs_[organ].drawing->live(forces, dt_s);
}

void SceneView::refresh(std::size_t organ) {
  if (!organs_[organ].stale) return;
  send_vertices(organs_[organ]);
  if (const auto& bared = organs_[organ].bared)
    renderer_.update_vertices(*bared, organs_[organ].drawing->bared()->vertices);
}

void SceneView::smoke(std::span<const ToolNow> tools, double dt_s) {
  std::vector<std::optional<Vec3f>> burning;
  for (const ToolNow& tool : tools) {
    auto& at = burning.emplace_back();
    if (tool.seen && tool.burning_at) at = tool.burning_at->cast<float>();
  }
  smoke_.advance(burning, dt_s);
}

void SceneView::show_cut(DrawnOrgan& organ) {
  for (const auto& [first, count] : organ.drawing->changed())
    renderer_.update_triangles(organ.mesh, first,
                               std::span(organ.drawing->mesh().triangles).subspan(first, count));
  const MeshData& bared = *organ.drawing->bared();
  if (organ.bared) {
    renderer_.replace_mesh(*organ.bared, bared);
  } else {
    organ.bared = renderer_.add_mesh(bared);
  }
  if (const MeshData* blood = organ.drawing->blood(); blood && !organ.blood)
    organ.blood = renderer_.add_mesh(*blood);
}

void SceneView::order_translucent(const Frame& frame) {
  if (blended_looks(frame.quality).empty()) return;
  for (const DrawnOrgan& organ : organs_) {
    const std::vector<OrganPart> parts = organ.drawing->parts();
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (parts[p].look == Look::kMesentery)
        renderer_.update_triangles(organ.parts[p], 0, back_to_front_.order(*parts[p].mesh, frame.view.eye));
  }
}

}  // namespace omentum::render
