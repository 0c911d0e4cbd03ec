// organ_phantom: makes the project's own organs, each as a tetrahedral mesh and as a labelled volume.
#include "files/whole_file.h"
#include "organ_tools/phantom/cavity_shape.h"
#include "organ_tools/phantom/colon_shape.h"
#include "organ_tools/phantom/gallbladder_shape.h"
#include "organ_tools/phantom/label_volume.h"
#include "organ_tools/phantom/liver_shape.h"
#include "organ_tools/phantom/tetrahedralize.h"
#include "organ_tools/phantom/tissue_samples.h"
#include "organ_tools/phantom/two_parts.h"
#include "runtime/command_line.h"

#include <cstdio>
#include <stdexcept>

namespace {

using namespace omentum;

constexpr double kVoxelSpacing = 1.5e-3;  // m: that of a good abdominal scan
constexpr double kMiddleOfCylinder_m = -0.06;

template <class Write>
void write_whole(const std::filesystem::path& file, Write&& write) {
  files::WholeFile whole(file);
  write(whole.draft());
  whole.move_to_its_place();
}

struct Part {
  phantom::ImplicitShape shape;
  phantom::MeshSize mesh_size;
};

Part chosen(const std::string& part, const std::string& size) {
  if (part == "liver")
    return {phantom::liver(), size == "fine" ? phantom::fine_size() : phantom::paper_size()};
  if (!size.empty()) throw std::runtime_error("--size " + size + ": the " + part + " comes in one size");
  if (part == "gallbladder") return {phantom::gallbladder(), phantom::gallbladder_size()};
  if (part == "colon") return {phantom::colon(), phantom::colon_size()};
  if (part == "cavity") return {phantom::cavity(), phantom::cavity_size()};
  if (part == "omentum") return {phantom::omentum(), phantom::omentum_size()};
  if (part == "plate") return {phantom::plate(), phantom::plate_size()};
  return {phantom::cylinder(), phantom::cylinder_size()};
}

geometry::TetraMesh half_of(const std::string& part, geometry::TetraMesh mesh) {
  if (part == "cylinder-upper")
    return phantom::eight_times_finer(phantom::parted_at(mesh, kMiddleOfCylinder_m).upper);
  if (part == "cylinder-lower") return phantom::parted_at(mesh, kMiddleOfCylinder_m).lower;
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "organ_phantom",
      "Makes the phantom's organs, in one frame: a liver of about 18 cm, z up, the "
      "inferior edge towards -y, its gallbladder and the colon; the cavity and the omentum "
      "around them; and two pieces of tissue to cut and tear, a plate and a cylinder; in "
      "metres.");
  std::string part = "liver", size;
  std::filesystem::path mesh_file, labels_file;
  line.option("--part", part,
              "liver, gallbladder (700-1,000 nodes), colon (1,400-1,900), cavity (1,200-3,000), "
              "omentum (800-2,500), plate (700-820) or cylinder (238-262); cylinder-lower: its lower half, "
              "cylinder-upper: the other one, eight times finer, which lies on that without sharing nodes")
      .one_of({"liver", "gallbladder", "colon", "cavity", "omentum", "plate", "cylinder", "cylinder-upper",
               "cylinder-lower"})
      .show_default();
  line.option("--size", size, "of the liver: paper (the default: 1,500-1,800 nodes) or fine (above 16,000)")
      .one_of({"paper", "fine"});
  line.option("-o,--output", mesh_file, "the mesh, Gmsh 2.2 (.msh)").required().writes_file();
  line.option("--labels", labels_file, "also the labelled volume, NIfTI-1 (.nii)").writes_file();
  return line.run(argc, argv, [&] {
    const auto [shape, mesh_size] = chosen(part, size);
    const geometry::TetraMesh mesh = half_of(part, phantom::tetrahedralize(shape, mesh_size));
    write_whole(mesh_file, [&](const auto& file) { geometry::write_mesh(mesh, file); });
    std::printf("%s: %zu nodes, %zu tetrahedra, smallest dihedral angle %.1f degrees\n", mesh_file.c_str(),
                mesh.positions.size(), mesh.tetrahedra.size(), phantom::smallest_dihedral_angle(mesh));
    if (!labels_file.empty()) {
      const phantom::LabelVolume labels = phantom::sample(shape, kVoxelSpacing);
      write_whole(labels_file, [&](const auto& file) { phantom::write_nifti(labels, file); });
    }
  });
}
