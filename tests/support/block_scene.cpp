#include "block_scene.h"

#include "node_common/loaded_scene.h"
#include "organ/build_organ.h"

#include "tests/support/meshes.h"

namespace omentum::test {

using geometry::Vec3;

BlockScene::BlockScene(int cells, const std::string& tools) {
  const geometry::TetraMesh mesh = make_box_mesh(cells, cells, cells, Vec3::Constant(kSide));
  organ::FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    if (mesh.positions[n].z() < 0.001) fixed[n] = physics::kPinned;
  }
  const organ::Organ organ =
      organ::make_organ("block", mesh, physics::Material{1e4, 0.45, 1000}, fixed, organ::Storage::kFloat);
  organ::build_organ(organ, file("block.h5"), {});
  hash_ = organ.hash;
  std::ofstream(scene()) << "name = \"a block\"\n"
                            "[[organs]]\nname = \"block\"\nmesh = \"block.msh\"\nfile = \"block.h5\"\n"
                            "young_pa = 10000\npoisson = 0.45\ndensity_kg_m3 = 1000\n"
                            "fixed = \"plane:z<0.001\"\n"
                         << tools;
}

msg::SceneInfo BlockScene::info(const std::string& organ_hash) const {
  const scene::Scene loaded = scene::load_scene(scene());
  return node::to_message(node::loaded_scene(loaded, {{.name = "block", .hash = organ_hash}}), loaded.name);
}

std::string BlockScene::scene_with(const std::string& text, const std::string& instead) const {
  std::string changed = read_text(scene());
  changed.replace(changed.find(text), text.size(), instead);
  std::ofstream(file("other.toml")) << changed;
  return file("other.toml");
}

}  // namespace omentum::test
