// Moves a scene's hands, trocars and camera onto its organs.
#pragma once

#include "organ_tools/scene_prepare/organ_skin.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// For one of the scene's own organs: the press points of its hands come to lie exactly on its surface,
/// normals and slide directions follow.
void project_hands(const OrganSkin& skin, std::size_t organ, scene::Scene& scene);

/// Another organ takes the place of the scene's first one, which is called `name` from now on, and the scene
/// after it: the press points of its hands are chosen anew (press_sites.h), their trocars and the camera move
/// along, depth and slide shrink where the organ is thin or small. Returns a line for everything that shrank.
/// Throws geometry::InputError where another organ of the scene has that name.
std::vector<std::string> replace_first(const std::string& name, const OrganSkin& skin, scene::Scene& scene);

/// For another organ: the scene says what that one is made of, its regions by the labels of the organ file.
void take_material(const physics::MaterialMap& material, scene::OrganSpec& organ);

}  // namespace omentum::scene_prepare
