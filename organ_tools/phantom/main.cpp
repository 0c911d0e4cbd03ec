// organ_phantom: makes the project's own liver, as a tetrahedral mesh and as a labelled volume.
#include "files/whole_file.h"
#include "organ_tools/phantom/label_volume.h"
#include "organ_tools/phantom/tetrahedralize.h"
#include "runtime/command_line.h"

#include <cstdio>

namespace {

using namespace omentum;

constexpr double kVoxelSpacing = 1.5e-3;  // m: that of a good abdominal scan

template <class Write>
void write_whole(const std::filesystem::path& file, Write&& write) {
  files::WholeFile whole(file);
  write(whole.draft());
  whole.move_to_its_place();
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "organ_phantom",
      "Makes the phantom liver: about 18 cm, in metres, z up, the inferior edge towards -y.");
  std::string size = "paper";
  std::filesystem::path mesh_file, labels_file;
  line.option("--size", size, "paper (1,500-1,800 nodes) or fine (above 16,000)").one_of({"paper", "fine"});
  line.option("-o,--output", mesh_file, "the mesh, Gmsh 2.2 (.msh)").required().writes_file();
  line.option("--labels", labels_file, "also the labelled volume, NIfTI-1 (.nii)").writes_file();
  return line.run(argc, argv, [&] {
    const geometry::TetraMesh mesh =
        phantom::tetrahedralize_liver(size == "fine" ? phantom::fine_size() : phantom::paper_size());
    write_whole(mesh_file, [&](const auto& file) { geometry::write_mesh(mesh, file); });
    std::printf("%s: %zu nodes, %zu tetrahedra, smallest dihedral angle %.1f degrees\n", mesh_file.c_str(),
                mesh.positions.size(), mesh.tetrahedra.size(), phantom::smallest_dihedral_angle(mesh));
    if (!labels_file.empty()) {
      write_whole(labels_file, [&](const auto& file) {
        phantom::write_nifti(phantom::sample_liver(kVoxelSpacing), file);
      });
    }
  });
}
