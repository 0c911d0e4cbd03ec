// Moves a scene's hands, trocars and camera onto its organs.
#pragma once

#include "organ_tools/scene_prepare/organ_skin.h"
#include "runtime/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// For one of the scene's own organs: the press points of its hands come to lie exactly on its surface,
/// normals and slide directions follow.
void project_hands(const OrganSkin& skin, std::size_t organ, runtime::Scene& scene);

/// Another organ takes the place of the scene's first one, which is called `name` from now on, and the scene
/// after it: the press points of its hands are chosen anew (press_sites.h), their trocars and the camera move
/// along, depth and slide shrink where the organ is thin or small. Returns a line for everything that shrank.
/// Throws geometry::InputError where another organ of the scene has that name.
std::vector<std::string> replace_first(const std::string& name, const OrganSkin& skin, runtime::Scene& scene);

}  // namespace omentum::scene_prepare
