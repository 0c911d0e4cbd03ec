#include "tests/support/scene_organ.h"

#include <nlohmann/json.hpp>

namespace omentum::test {
namespace {

std::string run(const std::string& program, const std::vector<std::string>& arguments) {
  Process process(program, arguments);
  if (process.wait() != 0) throw std::runtime_error(process.messages());
  return process.output();
}

std::string build(const nlohmann::json& organ, Regions regions, const std::filesystem::path& folder) {
  const std::string name = organ["name"], mesh = organ["mesh"], word = mesh.substr(mesh.find(':') + 1);
  const std::string made = (folder / (name + ".msh")).string(), file = (folder / (name + ".h5")).string();
  run("organ_phantom", {word == "gallbladder" ? "--part" : "--size", word, "-o", made});
  std::vector<std::string> arguments = {made, "-o", file, "--fixed", organ["fixed"]};
  for (const auto& [option, key] :
       {std::pair("--young", "young_pa"), std::pair("--poisson", "poisson"),
        std::pair("--density", "density_kg_m3"), std::pair("--scale", "metres_per_unit")})
    arguments.insert(arguments.end(), {option, organ[key].dump()});
  if (regions == Regions::kOfTheScene) {
    for (const std::string region : organ["regions"]) arguments.insert(arguments.end(), {"--region", region});
  }
  run("organ_build", arguments);
  return file;
}

}  // namespace

std::optional<std::filesystem::path> build_scene_organs(const std::string& name, Regions regions,
                                                        const std::filesystem::path& folder) {
  if (!std::filesystem::exists(OMENTUM_BIN_DIR "/organ_phantom")) return std::nullopt;
  const std::string scene = OMENTUM_SOURCE_DIR "/scenes/" + name + ".toml";
  std::vector<std::string> prepare = {scene, "--keep-points", "-o", (folder / (name + ".toml")).string()};
  const nlohmann::json described = nlohmann::json::parse(run("scene_prepare", {scene, "--describe"}));
  for (const nlohmann::json& organ : described["organs"])
    prepare.insert(prepare.end(), {"--organ", build(organ, regions, folder)});
  run("scene_prepare", prepare);
  return prepare[5];
}

}  // namespace omentum::test
