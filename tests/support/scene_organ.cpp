#include "tests/support/scene_organ.h"

#include <nlohmann/json.hpp>

namespace omentum::test {
namespace {

std::string run(const std::string& program, const std::vector<std::string>& arguments) {
  Process process(program, arguments);
  if (process.wait() != 0) throw std::runtime_error(process.messages());
  return process.output();
}

}  // namespace

std::optional<std::filesystem::path> build_scene_organ(const std::string& name, Regions regions,
                                                       const std::filesystem::path& folder) {
  if (!std::filesystem::exists(OMENTUM_BIN_DIR "/organ_phantom")) return std::nullopt;
  const std::string scene = OMENTUM_SOURCE_DIR "/scenes/" + name + ".toml";
  const std::string mesh = (folder / "phantom.msh").string(), file = (folder / (name + ".h5")).string();
  const nlohmann::json organ =
      nlohmann::json::parse(run("scene_prepare", {scene, "--describe"}))["organs"][0];
  const std::string phantom = organ["mesh"];
  run("organ_phantom", {"--size", phantom.substr(phantom.find(':') + 1), "-o", mesh});
  std::vector<std::string> arguments = {mesh, "-o", file, "--fixed", organ["fixed"]};
  for (const auto& [option, key] :
       {std::pair("--young", "young_pa"), std::pair("--poisson", "poisson"),
        std::pair("--density", "density_kg_m3"), std::pair("--scale", "metres_per_unit")})
    arguments.insert(arguments.end(), {option, organ[key].dump()});
  if (regions == Regions::kOfTheScene) {
    for (const std::string region : organ["regions"]) arguments.insert(arguments.end(), {"--region", region});
  }
  run("organ_build", arguments);
  run("scene_prepare", {scene, "--organ", file, "--keep-points", "-o", (folder / (name + ".toml")).string()});
  return file;
}

}  // namespace omentum::test
