// Random cut sequences of hybrid organs, through their border and inside their parts, pulled meanwhile, over
// three meshes and both laws: minutes, where deform_hybrid_test takes a second.
//   hybrid_cut_fuzz [SEQUENCES [FIRST_SEED [MODEL [SPEED]]]]
// 200 from 0 by default, of the model "hybrid", cut in its dynamic part alone, by a hand of 0.2 m/s; of
// "hybrid-cut" in both parts. Exit code 1: something is wrong.
#include "tests/deform_node/hybrid_cut_trials.h"
#include "tests/support/real_mesh.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace omentum;

constexpr int kTicks = 200;

struct RealMesh {
  const char* name;
  double unit_m;
};

// Held at its low end in x, with masses in its other half.
std::unique_ptr<test::HybridOrgan> halved(geometry::TetraMesh mesh) {
  double low = mesh.positions[0].x(), high = low;
  for (const geometry::Vec3& p : mesh.positions) {
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  physics::FixedComponents fixed = test::held_at_low_x(mesh, 0.15 * (high - low));
  const std::string dynamic = "plane:x>" + std::to_string((low + high) / 2);
  return std::make_unique<test::HybridOrgan>(std::move(mesh), std::move(fixed), dynamic,
                                             physics::Material{6000, 0.45, 1000});
}

std::vector<std::unique_ptr<test::HybridOrgan>> organs() {
  std::vector<std::unique_ptr<test::HybridOrgan>> all;
  for (const auto& [name, unit_m] : {RealMesh{"tet/sofa_liver2.msh", 0.02},
                                     {"tet/sofa_liver.msh", 0.02},
                                     {"tet/sofaenv_gallbladder.vtk", 0.02}}) {
    if (auto mesh = test::real_mesh(name, unit_m)) all.push_back(halved(std::move(*mesh)));
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const int sequences = argc > 1 ? std::atoi(argv[1]) : 200;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  deform::HybridTrial trial;
  if (argc > 3) trial.model = argv[3];
  if (argc > 4) trial.speed_m_s = std::atof(argv[4]);
  const auto all = organs();
  int failed = 0;
  for (int i = 0; i < sequences && !all.empty(); ++i) {
    const std::size_t mesh = static_cast<std::size_t>(i) % all.size();
    const int round = i / static_cast<int>(all.size());
    trial.law = round % 2 == 0 ? "corotational" : "linear";
    trial.pieces = round / 2 % 2 == 0 ? "fall" : "drop";
    const std::string wrong =
        deform::try_hybrid_cuts(*all[mesh], trial, static_cast<std::uint32_t>(first + i), kTicks);
    if (wrong.empty()) continue;
    std::printf("mesh %zu, %s, pieces %s, seed %d: %s\n", mesh, trial.law.c_str(), trial.pieces.c_str(),
                first + i, wrong.c_str());
    ++failed;
  }
  std::printf(
      "%s, %g m/s: %d of %d cut sequences over %zu meshes: finite, bounded, manifold, and nothing gone "
      "that has to stay\n",
      trial.model.c_str(), trial.speed_m_s, sequences - failed, sequences, all.size());
  return failed == 0 ? 0 : 1;
}
