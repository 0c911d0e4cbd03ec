// What of the scene is seen: SceneView's answers to the scores.
#include "render_node/scene_view.h"
#include "render_node/scope_view.h"
#include "render_node/sight_line.h"

namespace omentum::render {
namespace {

// What is seen of a target is its near side: a tip's thickness and a dent's do not hide it, m.
constexpr double kSightMargin_m = 0.006;

}  // namespace

std::optional<double> SceneView::exposed_share(std::size_t organ, std::span<const ToolNow> tools,
                                               ExposureRaster& raster) const {
  ViewChoices own;
  own.orbit = first_camera();
  own.endoscope = scene_.camera.mode == "endoscope";
  raster.look(view_of(camera(own, tools), ball_, raster.size().aspect(), 0));
  for (const MeshData* mesh : meshes_of(*organs_[organ].drawing)) raster.add_thing(*mesh);
  for (std::size_t o = 0; o < organs_.size(); ++o) {
    if (o == organ) continue;
    for (const MeshData* mesh : meshes_of(*organs_[o].drawing)) raster.add_cover(*mesh);
  }
  for (const MeshData* mesh : scenery_.covers()) raster.add_cover(*mesh);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (!tools[t].seen || (own.endoscope && scene_.tools[t].scope)) continue;
    for (const auto& [part, mesh] : instruments_[t])
      raster.add_cover(part.mesh, part_pose(part, tools[t].p_WT, tools[t].q_WT, tools[t].grip_rad));
  }
  return raster.share();
}

bool SceneView::hidden_from_scope(const Vec3& eye, const Vec3& target, std::span<const ToolNow> tools) const {
  const auto stands_between = [&](const MeshData& mesh, const Mat4f& pose) {
    return hides(mesh, pose, eye, target, kSightMargin_m);
  };
  for (const DrawnOrgan& organ : organs_) {
    for (const MeshData* mesh : meshes_of(*organ.drawing))
      if (stands_between(*mesh, Mat4f::Identity())) return true;
  }
  for (const MeshData* mesh : scenery_.covers())
    if (stands_between(*mesh, Mat4f::Identity())) return true;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (!tools[t].seen || scene_.tools[t].scope) continue;
    for (const auto& [part, mesh] : instruments_[t])
      if (stands_between(part.mesh, part_pose(part, tools[t].p_WT, tools[t].q_WT, tools[t].grip_rad)))
        return true;
  }
  return false;
}

std::optional<CameraMoment> SceneView::scope_moment(const Vec3& target,
                                                    std::span<const ToolNow> tools) const {
  const auto scope = scope_of(scene_);
  if (!scope || !tools[*scope].seen) return std::nullopt;
  const Camera held = scope_camera(tools[*scope].p_WT, tools[*scope].q_WT, *scene_.tools[*scope].scope);
  return camera_moment(held, target, hidden_from_scope(held.eye, target, tools));
}

}  // namespace omentum::render
