// Long random cut sequences over five meshes, the editor's books compared with books made from scratch and
// the surface looked at after every change: minutes, where mesh_editor_test takes seconds.
//   mesh_editor_fuzz [SEQUENCES [FIRST_SEED]]     500 from 0 by default; exit code 1: something is wrong
#include "tests/geometry/cut_trials.h"
#include "tests/support/real_mesh.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace omentum;

struct Trial {
  std::string name;
  geometry::TetraMesh mesh;
};

std::vector<Trial> trials() {
  std::vector<Trial> all;
  all.push_back({"box", test::make_box_mesh(4, 3, 3, {0.4, 0.3, 0.3})});
  all.push_back({"plate", test::make_box_mesh(7, 7, 1, {0.7, 0.7, 0.1})});
  all.push_back({"bar", test::make_box_mesh(12, 2, 2, {1.2, 0.2, 0.2})});
  for (const char* name : {"tet/sofa_liver.msh", "tet/sofaenv_liver_coarse.vtk"}) {
    if (auto mesh = test::real_mesh(name, 1e-3)) all.push_back({name, std::move(*mesh)});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const int sequences = argc > 1 ? std::atoi(argv[1]) : 500;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const std::vector<Trial> all = trials();
  for (int i = 0; i < sequences; ++i) {
    const Trial& trial = all[static_cast<std::size_t>(i) % all.size()];
    const std::string wrong = geometry::try_cut_sequence(trial.mesh, static_cast<std::uint32_t>(first + i));
    if (wrong.empty()) continue;
    std::printf("%s, seed %d: %s\n", trial.name.c_str(), first + i, wrong.c_str());
    return 1;
  }
  std::printf("%d cut sequences over %zu meshes: no difference, always manifold\n", sequences, all.size());
  return 0;
}
