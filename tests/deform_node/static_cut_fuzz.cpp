// Random cut sequences of organs that are always in equilibrium, pressed meanwhile, over three meshes:
// minutes, where deform_static_test takes a second.
//   static_cut_fuzz [SEQUENCES [FIRST_SEED]]     200 from 0 by default; exit code 1: something is wrong
#include "tests/deform_node/static_cut_trials.h"
#include "tests/support/real_mesh.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace omentum;

constexpr int kTicks = 200;

std::vector<deform::HeldOrgan> organs() {
  std::vector<deform::HeldOrgan> all;
  all.emplace_back(test::make_box_mesh(14, 5, 5, {0.14, 0.05, 0.05}), 0.001);
  for (const char* name : {"tet/sofa_liver2.msh", "tet/sofa_liver.msh"}) {
    constexpr double kUnit_m = 0.02;
    if (auto mesh = test::real_mesh(name, kUnit_m)) all.emplace_back(std::move(*mesh), 0.02);
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const int sequences = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const std::vector<deform::HeldOrgan> all = organs();
  for (int i = 0; i < sequences; ++i) {
    const deform::HeldOrgan& organ = all[static_cast<std::size_t>(i) % all.size()];
    const std::string wrong = deform::try_static_cuts(organ, static_cast<std::uint32_t>(first + i), kTicks);
    if (wrong.empty()) continue;
    std::printf("mesh %zu, seed %d: %s\n", static_cast<std::size_t>(i) % all.size(), first + i,
                wrong.c_str());
    return 1;
  }
  std::printf("%d cut sequences over %zu meshes: finite, bounded, manifold and held\n", sequences,
              all.size());
  return 0;
}
