#include "tests/support/trial_organs.h"

#include "organ/build_organ.h"
#include "organ/support_spec.h"
#include "scene/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <thread>

namespace omentum::test {
namespace {

using geometry::Vec3;

constexpr double kMillimetre = 1e-3, kPoisson = 0.45, kDensity_kg_m3 = 1060;
const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";

std::optional<geometry::TetraMesh> mesh_of(const OrganRecipe& recipe) {
  if (!recipe.file.empty()) {
    const auto file = data_file(recipe.file);
    if (!std::filesystem::exists(file)) return std::nullopt;
    return geometry::check_mesh(geometry::read_mesh(file), kMillimetre).mesh;
  }
  if (!std::filesystem::exists(OMENTUM_BIN_DIR "/organ_phantom")) return std::nullopt;
  const ScratchFolder folder;
  Process phantom("organ_phantom", {"-o", folder / "phantom.msh"});
  if (phantom.wait() != 0) throw std::runtime_error(phantom.messages());
  return geometry::check_mesh(geometry::read_mesh(folder / "phantom.msh"), 1).mesh;
}

}  // namespace

std::span<const OrganRecipe> organ_recipes() {
  // each lies in a bed of about the lowest third, as the phantom does in its scene; the prostate, which hangs
  // on its urethra along z, on its back
  static const std::array<OrganRecipe, 6> recipes = {{
      {"phantom", "", 6e3, "plane:z<-0.02", Vec3::UnitZ()},
      {"openhelp_liver_7k", "tet/openhelp_liver_7k.msh", 50e3, "plane:z<0.091", Vec3::UnitZ()},
      {"openhelp_kidney_left_22k", "tet/openhelp_kidney_left_22k.msh", 10e3, "plane:z<0.063", Vec3::UnitZ()},
      {"sofamcp_prostate", "tet/sofamcp_prostate.vtk", 20e3, "plane:y>0.0045", -Vec3::UnitY()},
      {"openhelp_liver_25k", "tet/openhelp_liver_25k.msh", 5e3, "plane:z<0.091", Vec3::UnitZ()},
      {"openhelp_stomach_15k", "tet/openhelp_stomach_15k.msh", 3e3, "plane:z<0.118", Vec3::UnitZ()},
  }};
  return recipes;
}

const OrganRecipe& organ_recipe(const std::string& name) {
  std::string known;
  for (const OrganRecipe& recipe : organ_recipes()) {
    if (recipe.name == name) return recipe;
    known += (known.empty() ? "" : ", ") + recipe.name;
  }
  throw std::invalid_argument("organ '" + name + "', expected one of " + known);
}

std::optional<std::filesystem::path> trial_organ_file(const OrganRecipe& recipe) {
  std::optional<geometry::TetraMesh> mesh = mesh_of(recipe);
  if (!mesh) return std::nullopt;
  auto fixed = organ::parse_supports(std::array{recipe.fixed}, *mesh);
  const organ::Organ organ = organ::make_organ(recipe.name, std::move(*mesh),
                                               physics::Material{recipe.young_pa, kPoisson, kDensity_kg_m3},
                                               std::move(fixed), organ::Storage::kFloat);
  const std::filesystem::path folder = OMENTUM_BIN_DIR "/../trial_organs";
  std::filesystem::create_directories(folder);
  const auto file = folder / (organ.hash + ".h5");
  organ::BuildOptions options;
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (!organ::is_up_to_date(file, organ)) {
    // tests that run at the same time may need the same organ
    const auto mine = folder / (organ.hash + "-" + std::to_string(getpid()) + ".h5");
    organ::build_organ(organ, mine, options);
    std::filesystem::rename(mine, file);
  }
  return file;
}

std::optional<organ::Organ> make_trial_organ(const OrganRecipe& recipe) {
  const auto file = trial_organ_file(recipe);
  if (!file) return std::nullopt;
  return organ::load_organ(*file, organ::Load::kWithTensors);
}

std::vector<haptic::ToolModel> scene_tools(bool with_trocars) {
  std::vector<haptic::ToolModel> tools;
  for (const scene::ToolSpec& spec : scene::load_scene(kScene).tools) {
    haptic::ToolModel tool;
    tool.points = spec.points;
    tool.grasps = spec.shape == "grasper";
    if (with_trocars) tool.trocar = spec.trocar;
    tools.push_back(std::move(tool));
  }
  return tools;
}

haptic::HapticModel trial_model(const organ::Organ& organ, std::vector<haptic::ToolModel> tools) {
  haptic::ElasticSurface surface{
      organ.surface, geometry::surface_positions(organ.mesh, organ.surface), *organ.compliance, {}};
  for (const geometry::NodeId n : organ.surface.node)
    surface.file_node.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[n]));
  return {.organs = {std::move(surface)}, .tools = std::move(tools)};
}

const haptic::HapticModel* scene_model(const std::string& name) {
  static std::map<std::string, std::unique_ptr<haptic::HapticModel>> models;
  const auto known = models.find(name);
  if (known != models.end()) return known->second.get();
  auto& model = models[name];
  const OrganRecipe& recipe = organ_recipe(name);
  if (const auto organ = make_trial_organ(recipe))
    model = std::make_unique<haptic::HapticModel>(trial_model(*organ, scene_tools(recipe.file.empty())));
  return model.get();
}

}  // namespace omentum::test
