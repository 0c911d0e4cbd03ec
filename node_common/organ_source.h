// An organ of the scene, loaded: the same for every node that moves, touches or draws it.
#pragma once

#include "geometry/gut_shape.h"
#include "node_common/loaded_scene.h"
#include "organ/organ.h"
#include "scene/scene.h"

#include <memory>
#include <vector>

namespace omentum::node {

/// What the organ's kind says it is, at rest.
struct OrganSource {
  scene::OrganKind kind{};
  organ::Organ organ;                // name and hash, and what a tetrahedral mesh consists of
  std::vector<geometry::Vec3> rest;  // of what its states are of, surface nodes or masses, in W, m
  // Of a tube, which is made from the scene's numbers and has no file; else null. Shared, because who draws,
  // moves and touches it keeps it.
  std::shared_ptr<const geometry::GutShape> gut{};
};

/// Loads, or makes, one organ of `scene`. Throws geometry::InputError (organ file) or std::runtime_error (no
/// file, "FILE: organ NAME has no file; expected ...", or a tube that cannot be, "FILE:LINE: ...").
OrganSource load_organ_source(const scene::Scene& scene, const scene::OrganSpec& spec, organ::Load what);

/// What the states of an organ of that kind are: KIND_* of idl/organ.idl.
std::uint32_t state_kind(scene::OrganKind kind);

/// What other nodes are told of a loaded organ.
msg::OrganInfo describe(const OrganSource& source);

}  // namespace omentum::node
