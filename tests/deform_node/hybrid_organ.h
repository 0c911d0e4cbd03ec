// A hybrid organ as a program has it: built into a file, and loaded with its part's tensors.
#pragma once

#include "node_common/organ_source.h"
#include "organ/build_organ.h"
#include "organ/dynamic_spec.h"
#include "tests/support/process.h"

namespace omentum::test {

/// Of `mesh`, held where `fixed` says, with masses where `dynamic` says (organ_build --dynamic). Cuts go at
/// once, and it lies in weight.
struct HybridOrgan {
  ScratchFolder folder;
  node::OrganSource source;
  scene::OrganSpec spec;

  HybridOrgan(geometry::TetraMesh mesh, physics::FixedComponents fixed, const std::string& dynamic,
              const physics::Material& tissue = {20000, 0.4, 1000}) {
    std::vector<std::uint8_t> part = organ::parse_dynamic(std::vector<std::string>{dynamic}, mesh);
    organ::take_what_would_hang(mesh, part);
    organ::build_organ(organ::make_organ("organ", std::move(mesh), tissue, std::move(fixed),
                                         organ::Storage::kFloat, std::move(part)),
                       folder / "organ.h5", {});
    source.organ = organ::load_organ(folder / "organ.h5", organ::Load::kWithPart);
    source.rest = geometry::surface_positions(source.organ.mesh, source.organ.surface);
    spec.dynamics.emplace();
    spec.dynamics->gravity_m_s2 = geometry::Vec3(0, 0, -9.81);
    spec.dynamics->mass_damping_per_s = 10;
    spec.dynamics->cut_delay_s = 0;
    spec.dynamics->cut_rate_per_s = 1e6;
  }
};

/// Held within `depth_m` of its smallest x.
inline physics::FixedComponents held_at_low_x(const geometry::TetraMesh& mesh, double depth_m) {
  double low = mesh.positions[0].x();
  for (const geometry::Vec3& p : mesh.positions) low = std::min(low, p.x());
  physics::FixedComponents fixed;
  for (const geometry::Vec3& p : mesh.positions)
    fixed.push_back(p.x() <= low + depth_m ? physics::kPinned : 0);
  return fixed;
}

}  // namespace omentum::test
