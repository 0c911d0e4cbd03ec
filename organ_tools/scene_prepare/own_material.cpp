#include "organ_tools/scene_prepare/own_material.h"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>

namespace omentum::scene_prepare {
namespace {

std::string words(double number) {
  char digits[32];  // the shortest form of a double has at most 24
  return {digits, std::to_chars(std::begin(digits), std::end(digits), number).ptr};
}

// `where`: the key that is wrong, or of the regions the wrong one.
[[noreturn]] void refuse(const scene::Scene& scene, const std::string& where, const std::string& found,
                         const std::string& expected) {
  const toml::table root = toml::parse_file(scene.file.string());
  const auto line = root.at_path(where).node()->source().begin.line;
  throw std::runtime_error(scene.file.string() + ":" + std::to_string(line) + ": " + where + ": found " +
                           found + ", expected " + expected + ": the organ file is built already");
}

bool same(const scene::RegionSpec& region, const physics::Material& common,
          const physics::RegionMaterial& built) {
  return region.label == built.label &&
         region.young_pa.value_or(common.young_pa) == built.material.young_pa &&
         region.poisson.value_or(common.poisson) == built.material.poisson &&
         region.density_kg_m3.value_or(common.density_kg_m3) == built.material.density_kg_m3;
}

}  // namespace

void take_own_material(const organ::Organ& organ, std::size_t k, scene::Scene& scene) {
  scene::OrganSpec& said = scene.organs.at(k);
  if (!scene::is_organ_file(said.mesh)) return;
  const toml::table root = toml::parse_file(scene.file.string());
  const physics::Material& built = organ.material.common;
  const std::string place = "organs[" + std::to_string(k) + "].";
  const auto take = [&](const char* key, double& found, double expected) {
    if (root.at_path(place + key) && found != expected)
      refuse(scene, place + key, words(found), words(expected));
    found = expected;
  };
  take("young_pa", said.young_pa, built.young_pa);
  take("poisson", said.poisson, built.poisson);
  take("density_kg_m3", said.density_kg_m3, built.density_kg_m3);
  const auto alike = [&](const scene::RegionSpec& region) {
    return std::ranges::any_of(organ.material.regions,
                               [&](const auto& own) { return same(region, built, own); });
  };
  for (std::size_t r = 0; r < said.regions.size(); ++r) {
    if (!alike(said.regions[r]))
      refuse(scene, place + "regions[" + std::to_string(r) + "]", "another material",
             "one of those that organ_check lists, by its label");
  }
}

}  // namespace omentum::scene_prepare
