// A scene for the real deform_node: one block, one probe.
#pragma once

#include "node_common/loaded_scene.h"
#include "organ/organ.h"

#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <fstream>

namespace omentum::deform_test {

using geometry::Vec3;

inline constexpr double kSideM = 0.1;

/// A block of 10 cm, held at z = 0, and a scene around it.
class BlockScene {
 public:
  BlockScene() {
    geometry::write_mesh(test::make_box_mesh(4, 4, 4, Vec3::Constant(kSideM)), folder_ / "block.msh");
    test::Process build("organ_build",
                        {folder_ / "block.msh", "-o", folder_ / "block.h5", "--young", "10000", "--poisson",
                         "0.45", "--density", "1000", "--scale", "1", "--fixed", "plane:z<0.001"});
    if (build.wait() != 0) throw std::runtime_error(build.messages());
    std::ofstream(folder_ / "scene.toml")
        << "name = \"a block\"\n"
           "[[organs]]\nname = \"block\"\nmesh = \"block.msh\"\nfile = \"block.h5\"\n"
           "young_pa = 10000\npoisson = 0.45\ndensity_kg_m3 = 1000\n"
           "fixed = \"plane:z<0.001\"\n"
           "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
  }
  std::string scene() const { return folder_ / "scene.toml"; }
  std::string report() const { return folder_ / "report.json"; }
  /// The same scene, but for a few letters.
  std::string scene_with(const std::string& text, const std::string& instead) const {
    std::string changed = test::read_text(scene());
    changed.replace(changed.find(text), text.size(), instead);
    std::ofstream(folder_ / "other.toml") << changed;
    return folder_ / "other.toml";
  }
  /// What a deform_node tells that serves this scene with the organ file of that hash.
  msg::SceneInfo info(const std::string& organ_hash) const {
    const scene::Scene loaded = scene::load_scene(scene());
    return node::to_message(node::loaded_scene(loaded, {{.name = "block", .hash = organ_hash}}), loaded.name);
  }
  organ::Organ organ() const { return organ::load_organ(folder_ / "block.h5", organ::Load::kWithTensors); }

 private:
  test::ScratchFolder folder_;
};

}  // namespace omentum::deform_test
