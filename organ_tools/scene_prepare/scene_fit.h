// Moves a scene's hands, trocars and camera onto an organ.
#pragma once

#include "organ_tools/scene_prepare/organ_skin.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// For the scene's own organ: press points come to lie exactly on its surface, normals and slide directions
/// follow.
void project_hands(const OrganSkin& skin, scene::Scene& scene);

/// For another organ: press points are chosen anew (press_sites.h), trocars and camera move along, depth and
/// slide shrink where the organ is thin or small. Returns a line for everything that shrank.
std::vector<std::string> place_hands(const OrganSkin& skin, scene::Scene& scene);

/// For another organ: the scene says what that one is made of, its regions by the labels of the organ file.
void take_material(const physics::MaterialMap& material, scene::OrganSpec& organ);

/// For another organ: the scene and its first organ are called after it.
void name_after(const std::string& organ, scene::Scene& scene);

}  // namespace omentum::scene_prepare
