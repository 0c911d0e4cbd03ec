// An organ of the scene, loaded: the same for every node that moves, touches or draws it.
#pragma once

#include "node_common/loaded_scene.h"
#include "organ/organ.h"
#include "scene/scene.h"

#include <vector>

namespace omentum::node {

/// What the organ's kind says it is, at rest.
struct OrganSource {
  scene::OrganKind kind{};
  organ::Organ organ;                // name and hash, and what a tetrahedral mesh consists of
  std::vector<geometry::Vec3> rest;  // [S], of the surface's nodes in its order, in W, m
};

/// Loads one organ of `scene`. Throws geometry::InputError (organ file) or std::runtime_error (no file,
/// "FILE: organ NAME has no file; expected ...").
OrganSource load_organ_source(const scene::Scene& scene, const scene::OrganSpec& spec, organ::Load what);

/// What the states of an organ of that kind are: KIND_* of idl/organ.idl.
std::uint32_t state_kind(scene::OrganKind kind);

/// What other nodes are told of a loaded organ.
msg::OrganInfo describe(const OrganSource& source);

}  // namespace omentum::node
