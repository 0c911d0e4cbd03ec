#include "node_common/organ_source.h"

#include "geometry/gut_anatomy.h"
#include "organ/gut_hash.h"

#include <stdexcept>

namespace omentum::node {
namespace {

OrganSource make_tube(const scene::OrganSpec& spec) {
  OrganSource source{.kind = spec.kind, .organ = {}, .rest = {}};
  try {
    source.gut = std::make_shared<const geometry::GutShape>(geometry::make_gut(spec.intestine->anatomy));
  } catch (const std::exception& e) {
    throw std::runtime_error(spec.intestine->where + ": organ " + spec.name + ": " + e.what());
  }
  source.organ.name = spec.name;
  source.organ.hash = organ::gut_hash(spec.intestine->anatomy);
  source.rest = source.gut->positions;
  return source;
}

}  // namespace

OrganSource load_organ_source(const scene::Scene& scene, const scene::OrganSpec& spec, organ::Load what) {
  if (spec.kind == scene::OrganKind::kTube) return make_tube(spec);
  if (spec.file.empty())
    throw std::runtime_error(scene.file.string() + ": organ " + spec.name +
                             " has no file; expected a resolved scene (scene_prepare) or --organ FILE.h5");
  OrganSource source{.kind = spec.kind, .organ = organ::load_organ(spec.file, what), .rest = {}};
  source.rest = geometry::surface_positions(source.organ.mesh, source.organ.surface);
  return source;
}

std::uint32_t state_kind(scene::OrganKind kind) {
  switch (kind) {
    case scene::OrganKind::kTetrahedralMesh:
      return msg::KIND_SURFACE;
    case scene::OrganKind::kTube:
      return msg::KIND_TUBE;
  }
  throw std::invalid_argument("an organ of a kind without states");
}

msg::OrganInfo describe(const OrganSource& source) {
  return {.name = source.organ.name, .hash = source.organ.hash, .kind = state_kind(source.kind)};
}

}  // namespace omentum::node
