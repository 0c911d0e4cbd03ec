// scene_prepare: fits a scene to its organs' files. The launcher also asks it what a scene or a mesh holds.
#include "files/whole_file.h"
#include "organ/plausibility.h"
#include "organ_tools/scene_prepare/loaded_organs.h"
#include "organ_tools/scene_prepare/own_material.h"
#include "organ_tools/scene_prepare/scene_fit.h"
#include "organ_tools/scene_prepare/scene_text.h"
#include "organ_tools/scene_prepare/tip_size.h"
#include "runtime/node_options.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <iostream>

namespace {

using namespace omentum;

struct Options {
  std::filesystem::path scene, output, measured;
  std::vector<std::string> organs, scenery;
  bool keep_points = false;
  bool describe = false;
};

/// Bounding box of the nodes that tetrahedra use, in the file's unit.
nlohmann::json measure(const std::filesystem::path& file) {
  const geometry::RawMesh raw = geometry::read_mesh(file);
  Eigen::AlignedBox3d box;
  for (const auto& tetrahedron : raw.tetrahedra)
    for (const std::int32_t n : tetrahedron) box.extend(raw.positions.at(static_cast<std::size_t>(n)));
  const auto corner = [](const geometry::Vec3& p) { return nlohmann::json{p.x(), p.y(), p.z()}; };
  return {{"min", corner(box.min())}, {"max", corner(box.max())}, {"tetrahedra", raw.tetrahedra.size()}};
}

void warn_of_what_can_hardly_be_meant(const organ::Organ& organ, const scene::Scene& scene) {
  for (const auto& sentences :
       {organ::implausible(organ.mesh, organ.material), scene_prepare::smaller_than_tips(organ, scene)}) {
    for (const std::string& sentence : sentences) std::cerr << "scene_prepare: warning: " << sentence << '\n';
  }
}

void fit(std::size_t i, bool is_its_own, scene::Scene& scene) {
  const organ::Organ organ = organ::load_organ(scene.organs[i].file, organ::Load::kMeshOnly);
  warn_of_what_can_hardly_be_meant(organ, scene);
  const scene_prepare::OrganSkin skin(organ);
  if (is_its_own) {
    scene_prepare::take_own_material(organ, i, scene);
    scene_prepare::project_hands(skin, i, scene);
    return;
  }
  for (const std::string& note : scene_prepare::replace_first(organ.name, skin, scene))
    std::cout << note << '\n';
  scene_prepare::take_material(organ.material, scene.organs.front());
}

void prepare(const Options& options) {
  scene::Scene scene = scene::load_scene(options.scene);
  scene_prepare::name_files(options.organs, scene);
  scene_prepare::name_scenery(options.scenery, scene);
  for (const std::size_t i : scene_prepare::organs_of_files(scene))
    fit(i, i > 0 || options.keep_points, scene);
  files::write_whole(options.output, scene_prepare::resolved_toml(scene));
}

void run(const Options& options) {
  if (!options.measured.empty()) {
    std::cout << measure(options.measured) << '\n';
  } else if (options.scene.empty()) {
    throw std::runtime_error("SCENE is missing (see scene_prepare --help)");
  } else if (options.describe) {
    std::cout << scene_prepare::describe(scene::load_scene(options.scene)) << '\n';
  } else if (options.output.empty()) {
    throw std::runtime_error("-o is needed (see scene_prepare --help)");
  } else {
    prepare(options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("scene_prepare", "Fits a scene to its organs: press points, trocars, camera.");
  Options options;
  line.option("scene", options.scene, "scene file (TOML)").type_name("SCENE");
  line.option("--organ", options.organs,
              "organ file that the scene's first organ becomes; given again, those that the next ones do")
      .type_name("ORGAN.h5");
  line.option("--scenery", options.scenery,
              "mesh file of the scene's first scenery; given again, those of the next")
      .type_name("MESH");
  line.option("-o,--output", options.output, "the fitted scene").type_name("OUT.toml");
  line.flag("--keep-points", options.keep_points,
            "the first organ is the scene's own: only project the press points onto its surface");
  line.flag("--describe", options.describe, "print what the scene needs (JSON) and end");
  line.option("--measure", options.measured, "print a mesh file's bounding box (JSON) and end")
      .type_name("MESH");
  return line.run(argc, argv, [&] { run(options); });
}
