#include "render_node/camera_target.h"

#include <algorithm>

namespace omentum::render {
namespace {

template <class Named, class Key, class Member>
std::size_t place_of(const std::vector<Named>& things, const Key& key, Member member) {
  return static_cast<std::size_t>(std::ranges::find(things, key, member) - things.begin());
}

std::size_t nearest_vertex(const MeshData& mesh, const Vec3& place) {
  const auto apart = [&](const Vertex& v) { return (v.position - place.cast<float>()).squaredNorm(); };
  return static_cast<std::size_t>(std::ranges::min_element(mesh.vertices, {}, apart) - mesh.vertices.begin());
}

}  // namespace

CameraTarget::CameraTarget(const scene::Scene& scene, const SceneView& view) {
  const scene::CameraScoreSpec& spec = *scene.score.camera;
  if (spec.tool) {
    tool_ = place_of(scene.tools, *spec.tool, &scene::ToolSpec::id);
    return;
  }
  organ_ = place_of(scene.organs, spec.organ, &scene::OrganSpec::name);
  vertex_ = nearest_vertex(view.mesh(organ_), spec.place);
}

std::optional<Vec3> CameraTarget::place(const SceneView& view, std::span<const ToolNow> tools) const {
  if (!tool_) return view.mesh(organ_).vertices[vertex_].position.cast<double>();
  if (!tools[*tool_].seen) return std::nullopt;
  return tools[*tool_].p_WT;
}

}  // namespace omentum::render
