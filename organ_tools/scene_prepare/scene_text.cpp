#include "organ_tools/scene_prepare/scene_text.h"

#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>

namespace omentum::scene_prepare {

namespace {

toml::array to_array(const scene::Vec3& t) {
  return toml::array{t[0], t[1], t[2]};
}

toml::table& entry(toml::table& root, const char* list, std::size_t index) {
  return *root[list].as_array()->get(index)->as_table();
}

toml::array to_array(const std::vector<double>& numbers) {
  toml::array array;
  for (const double number : numbers) array.push_back(number);
  return array;
}

toml::table to_table(const scene::RegionSpec& region) {
  toml::table table;
  if (region.label) table.insert("label", *region.label);
  if (!region.box.empty()) table.insert("box", to_array(region.box));
  if (!region.ball.empty()) table.insert("ball", to_array(region.ball));
  if (region.young_pa) table.insert("young_pa", *region.young_pa);
  if (region.poisson) table.insert("poisson", *region.poisson);
  if (region.density_kg_m3) table.insert("density_kg_m3", *region.density_kg_m3);
  if (region.tears.volume_change) table.insert("tear_volume_change", *region.tears.volume_change);
  if (region.tears.mean_elongation) table.insert("tear_mean_elongation", *region.tears.mean_elongation);
  if (region.tears.edge_elongation) table.insert("tear_edge_elongation", *region.tears.edge_elongation);
  if (region.tears.stress_pa) table.insert("tear_stress_pa", *region.tears.stress_pa);
  return table;
}

// As organ_build --region takes it.
std::string region_text(const scene::RegionSpec& region) {
  std::ostringstream text;
  // JSON writes the shortest digits that come back as the same number
  const auto add_list = [&](const char* key, const std::vector<double>& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      text << (i == 0 ? key : ",") << nlohmann::json(numbers[i]);
  };
  const auto add = [&](const char* key, const std::optional<double>& number) {
    if (number) text << key << nlohmann::json(*number);
  };
  if (region.label) text << "label=" << *region.label;
  add_list("box=", region.box);
  add_list("ball=", region.ball);
  add("; young=", region.young_pa);
  add("; poisson=", region.poisson);
  add("; density=", region.density_kg_m3);
  return text.str();
}

void write_organ(const scene::OrganSpec& organ, toml::table& table) {
  table.insert_or_assign("name", organ.name);
  if (organ.kind != scene::OrganKind::kTetrahedralMesh) return;
  table.insert_or_assign("young_pa", organ.young_pa);
  table.insert_or_assign("poisson", organ.poisson);
  table.insert_or_assign("density_kg_m3", organ.density_kg_m3);
  toml::array regions;
  for (const scene::RegionSpec& region : organ.regions) regions.push_back(to_table(region));
  table.erase("regions");
  if (!regions.empty()) table.insert("regions", std::move(regions));
  if (!organ.mesh.starts_with("phantom:"))
    table.insert_or_assign("mesh", std::filesystem::absolute(organ.mesh).string());
  if (organ.dynamics && !organ.dynamics->dynamic_mesh.empty() &&
      !organ.dynamics->dynamic_mesh.starts_with("phantom:"))
    table.insert_or_assign("dynamic_mesh", std::filesystem::absolute(organ.dynamics->dynamic_mesh).string());
  // a file that took a mesh's place has its own
  if (scene::is_organ_file(organ.mesh))
    for (const char* key : {"metres_per_unit", "fixed", "dynamic", "dynamic_mesh"}) table.erase(key);
  if (!organ.file.empty()) table.insert_or_assign("file", std::filesystem::absolute(organ.file).string());
}

void write_hand(const scene::HandSpec& hand, toml::table& table) {
  table.insert_or_assign("organ", hand.organ);
  if (!hand.way.empty()) return;
  table.insert_or_assign("press_point", to_array(hand.press_point));
  table.insert_or_assign("press_normal", to_array(hand.press_normal));
  table.insert_or_assign("slide_direction", to_array(hand.slide_direction));
  table.insert_or_assign("depth_m", hand.depth_m);
  table.insert_or_assign("slide_m", hand.slide_m);
}

// As files, or, where an organ that is not the scene's took its place, none.
void write_scenery(const std::vector<scene::ScenerySpec>& scenery, toml::table& root) {
  if (scenery.empty()) root.erase("scenery");
  for (std::size_t i = 0; i < scenery.size(); ++i) {
    if (scenery[i].file.empty()) continue;  // of a word, and nobody made it
    toml::table& table = entry(root, "scenery", i);
    const std::string file = std::filesystem::absolute(scenery[i].file).string();
    table.insert_or_assign(scenery[i].mesh.starts_with("phantom:") ? "file" : "mesh", file);
  }
}

}  // namespace

std::string resolved_toml(const scene::Scene& scene) {
  // load_scene has accepted this file: every list below has the scene's length
  toml::table root = toml::parse_file(scene.file.string());
  root.insert_or_assign("name", scene.name);
  for (std::size_t i = 0; i < scene.organs.size(); ++i)
    write_organ(scene.organs[i], entry(root, "organs", i));
  for (std::size_t i = 0; i < scene.hands.size(); ++i) write_hand(scene.hands[i], entry(root, "hands", i));
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    if (scene.tools[i].trocar)
      entry(root, "tools", i).insert_or_assign("trocar", to_array(*scene.tools[i].trocar));
  if (toml::table* camera = root["camera"].as_table()) {
    camera->insert_or_assign("eye", to_array(scene.camera.eye));
    camera->insert_or_assign("target", to_array(scene.camera.target));
  }
  write_scenery(scene.scenery, root);
  std::ostringstream text;
  text << "# Fitted to its organs by scene_prepare; the nodes of one run read this.\n" << root << '\n';
  return text.str();
}

nlohmann::json describe(const scene::Scene& scene) {
  nlohmann::json organs = nlohmann::json::array();
  for (const scene::OrganSpec& organ : scene.organs) {
    nlohmann::json regions = nlohmann::json::array();
    for (const scene::RegionSpec& region : organ.regions) regions.push_back(region_text(region));
    organs.push_back({{"name", organ.name},
                      {"has_file", organ.kind == scene::OrganKind::kTetrahedralMesh},
                      {"mesh", organ.mesh},
                      {"file", organ.file.string()},
                      {"metres_per_unit", organ.metres_per_unit},
                      {"young_pa", organ.young_pa},
                      {"poisson", organ.poisson},
                      {"density_kg_m3", organ.density_kg_m3},
                      {"regions", regions},
                      {"fixed", organ.fixed},
                      {"dynamic", organ.dynamics ? organ.dynamics->dynamic_part : ""},
                      {"dynamic_mesh", organ.dynamics ? organ.dynamics->dynamic_mesh : ""}});
  }
  nlohmann::json scenery = nlohmann::json::array();
  for (const scene::ScenerySpec& piece : scene.scenery) scenery.push_back({{"mesh", piece.mesh}});
  return {{"name", scene.name}, {"organs", organs}, {"scenery", scenery}};
}

}  // namespace omentum::scene_prepare
