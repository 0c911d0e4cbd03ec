#include "node/organ_source.h"

#include <stdexcept>

namespace omentum::node {

namespace {

constexpr std::size_t kTextBytes = 64;  // string<64> of OrganInfo in idl/organ.idl

}  // namespace

OrganSource load_organ_source(const runtime::Scene& scene, const runtime::OrganSpec& spec, organ::Load what) {
  if (spec.file.empty())
    throw std::runtime_error(scene.file.string() + ": organ " + spec.name +
                             " has no file; expected a resolved scene (scene_prepare) or --organ FILE.h5");
  OrganSource source{.kind = spec.kind, .organ = organ::load_organ(spec.file, what), .rest = {}};
  source.rest = geometry::surface_positions(source.organ.mesh, source.organ.surface);
  return source;
}

std::uint32_t state_kind(runtime::OrganKind kind) {
  switch (kind) {
    case runtime::OrganKind::kTetrahedralMesh:
      return msg::KIND_SURFACE;
  }
  throw std::invalid_argument("an organ of a kind without states");
}

msg::OrganInfo describe(const OrganSource& source) {
  return {.name = source.organ.name.substr(0, kTextBytes), .hash = source.organ.hash.substr(0, kTextBytes)};
}

}  // namespace omentum::node
