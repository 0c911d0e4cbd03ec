#include "node_common/organ_source.h"

#include <stdexcept>

namespace omentum::node {

OrganSource load_organ_source(const scene::Scene& scene, const scene::OrganSpec& spec, organ::Load what) {
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
  }
  throw std::invalid_argument("an organ of a kind without states");
}

msg::OrganInfo describe(const OrganSource& source) {
  return {.name = source.organ.name, .hash = source.organ.hash, .kind = state_kind(source.kind)};
}

}  // namespace omentum::node
