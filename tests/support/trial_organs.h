// Organs of real shape for what measures contact: the phantom and the meshes beside the repository.
#pragma once

#include "haptic_node/haptic_model.h"
#include "organ/organ.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace omentum::test {

/// What an organ on trial is made of.
struct OrganRecipe {
  std::string name;  // "phantom", or a file of shared/data/tet without its ending
  std::string file;  // relative to shared/data; empty: the phantom
  double young_pa;
  std::string fixed;  // what holds it, as organ_build takes it
  geometry::Vec3 up;  // away from there, unit: the side to press
};

/// The phantom as in scenes/liver.toml first, then livers, kidney, prostate, stomach.
std::span<const OrganRecipe> organ_recipes();
/// Throws std::invalid_argument, naming those that there are.
const OrganRecipe& organ_recipe(const std::string& name);

/// Its organ file with tensors, kept in the build folder; nothing where the data or the phantom's program are
/// absent. Throws geometry::InputError.
std::optional<std::filesystem::path> trial_organ_file(const OrganRecipe& recipe);
/// The same, loaded.
std::optional<organ::Organ> make_trial_organ(const OrganRecipe& recipe);

/// The two tools of scenes/liver.toml, the right hand's probe first, with or without their trocars.
std::vector<haptic::ToolModel> scene_tools(bool with_trocars);

/// Without friction, by point contacts. The organ's tensors are shared.
haptic::HapticModel trial_model(const organ::Organ& organ, std::vector<haptic::ToolModel> tools);

/// The recipe's organ and the scene's tools, made once in a process: with their trocars in the phantom, whose
/// scene it is. Null where the organ cannot be made.
const haptic::HapticModel* scene_model(const std::string& recipe);

}  // namespace omentum::test
