// Presses a single tetrahedron with the installed libraries: mesh, physics and organ file.
#include "organ/build_organ.h"
#include "physics/direct_solve.h"

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
  using namespace omentum;
  if (argc != 2) return 2;
  geometry::RawMesh raw;
  raw.source = "consumer";
  raw.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  raw.tetrahedra = {{0, 1, 2, 3}};
  geometry::TetraMesh mesh = geometry::check_mesh(raw, 0.01).mesh;
  const physics::Material material{3000, 0.45, 1000};
  const organ::FixedComponents fixed{7, 7, 7, 0};

  const auto stiffness = physics::assemble_stiffness(mesh, material);
  const physics::ImposedDisplacement press{geometry::NodeId(3), {0, 0, -1e-3}};
  const auto pressed = physics::direct_solve(stiffness, fixed, {&press, 1}, {});

  const organ::Organ made =
      organ::make_organ("tetrahedron", std::move(mesh), material, fixed, organ::Storage::kFloat);
  organ::build_organ(made, argv[1], {});
  const organ::Organ found = organ::load_organ(argv[1], organ::Load::kWithTensors);
  const Eigen::Matrix3d C = found.compliance->block(geometry::SurfaceId(0), geometry::SurfaceId(0));
  const geometry::Vec3 force = C.inverse() * press.displacement;
  std::printf("%g N directly, %g N by the tensors\n", pressed.holding_forces[0].norm(), force.norm());
  return (force - pressed.holding_forces[0]).norm() < 1e-5 * force.norm() ? 0 : 1;
}
