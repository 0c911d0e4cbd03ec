// organ_check: whether an organ file is whole, to its last byte, and what it is made of.
#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "physics/element_tensors.h"
#include "runtime/command_line.h"

#include <cstdio>

namespace {

using namespace omentum;

constexpr double kCubicCentimetre = 1e-6;  // m^3

void print_tissue(const organ::Organ& organ, const physics::Material& material) {
  std::size_t count = 0;
  double volume = 0;
  for (std::size_t t = 0; t < organ.mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    if (&organ.material.of(organ.mesh, id) != &material) continue;
    const physics::Corners c = physics::corners_of(organ.mesh, id);
    volume += geometry::signed_volume(c[0], c[1], c[2], c[3]);
    ++count;
  }
  std::printf("%zu tetrahedra, %.3g cm^3: %g Pa, Poisson's ratio %g, %g kg/m^3\n", count,
              volume / kCubicCentimetre, material.young_pa, material.poisson, material.density_kg_m3);
}

void check(const std::filesystem::path& file) {
  const organ::Organ organ = organ::load_organ(file, organ::Load::kMeshOnly);
  organ::require_whole(organ::map_tensors(file, organ), file);
  std::printf("%s: whole: %zu nodes, %d of %d surface nodes mobile, tensors in %s, hash %s\n",
              organ.name.c_str(), organ.mesh.positions.size(), organ.surface.mobile_count,
              organ.surface.node_count(), organ.storage == organ::Storage::kDouble ? "double" : "float",
              organ.hash.c_str());
  if (organ.split) {
    std::printf("hybrid: %zu tetrahedra are dynamic, the tensors are of %zu others; %zu connection nodes\n",
                organ.split->parts.dynamic.tetrahedron.size(),
                organ.split->parts.precomputed.tetrahedron.size(), organ.split->connection.size());
  }
  if (organ.split && organ.split->tie) {
    std::printf("its parts share no nodes: the connection nodes follow %zu nodes of the dynamic part\n",
                organ.split->tie->map.masters.size());
  }
  std::printf("%s: ", organ.material.regions.empty() ? "everywhere" : "elsewhere");
  print_tissue(organ, organ.material.common);
  for (const physics::RegionMaterial& region : organ.material.regions) {
    std::printf("region %d: ", region.label);
    print_tissue(organ, region.material);
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "organ_check", "Reads all of an organ file against its hash and checksum, and says what it holds.");
  std::filesystem::path file;
  line.option("organ", file, "organ file").required().type_name("ORGAN.h5");
  return line.run(argc, argv, [&] { check(file); });
}
