#include "render_node/scene_files.h"

#include "node_common/node_identity.h"
#include "node_common/organ_source.h"
#include "render_node/organ_look.h"
#include "render_node/plausible.h"

#include <algorithm>

namespace omentum::render {
namespace {

OrganShape shape_of(node::OrganSource source, const std::string& look) {
  std::vector<geometry::SurfaceId> surface_of_file_node = source.organ.surface_of_file_node();
  std::vector<geometry::CoveredFace> covered;
  if (source.organ.split) covered = std::move(source.organ.split->covered);
  return {source.kind,
          std::move(source.organ.surface),
          std::move(source.rest),
          std::move(surface_of_file_node),
          tissue_material(look),
          bared_material(look),
          std::make_shared<const geometry::TetraMesh>(std::move(source.organ.mesh)),
          std::move(covered),
          std::move(source.gut)};
}

// The largest value of a state: displacements, or places in the scene.
double most_m(const node::OrganSource& source) {
  double farthest = 0;
  if (source.gut)
    for (const geometry::Vec3& x : source.rest) farthest = std::max(farthest, x.lpNorm<Eigen::Infinity>());
  return farthest + reach_of(source.rest);
}

LoadedOrgan loaded_organ(const node::OrganSource& source) {
  return {.name = source.organ.name,
          .hash = source.organ.hash,
          .node_count = source.rest.size(),
          .reach_m = most_m(source),
          .state_kind = node::state_kind(source.kind),
          .tetrahedron_count = source.organ.mesh.tetrahedra.size(),
          .most_nodes = source.organ.mesh.positions.size()};
}

}  // namespace

SceneFiles read_scene_files(const runtime::NodeOptions& options) {
  SceneFiles loaded{node::load_scene(options), {}, {}};
  for (const scene::OrganSpec& spec : loaded.scene.organs) {
    node::OrganSource source = node::load_organ_source(loaded.scene, spec, organ::Load::kMeshOnly);
    loaded.organs.push_back(loaded_organ(source));
    loaded.shapes.push_back(shape_of(std::move(source), spec.look));
  }
  return loaded;
}

}  // namespace omentum::render
