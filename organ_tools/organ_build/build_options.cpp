#include "organ_tools/organ_build/build_options.h"

#include "organ_tools/numbering_option.h"

namespace omentum::organ_tools {
namespace {

// An error message, or nothing.
std::string parse_storage(const std::string& text, organ::Storage& storage) {
  if (text != "float" && text != "double") return "found " + text + ", expected float or double";
  storage = text == "float" ? organ::Storage::kFloat : organ::Storage::kDouble;
  return {};
}

}  // namespace

void add_build_options(runtime::CommandLine& line, BuildCommand& command) {
  line.option("mesh", command.mesh, "tetrahedra: .msh (1, 2.2, 4), .vtk, .vtu, .node/.ele")
      .required()
      .type_name("MESH");
  line.option("-o,--output", command.output, "organ file to write (HDF5)").required().type_name("ORGAN.h5");
  line.option("--young", command.material.young_pa, "Young's modulus, Pa").required().type_name("PA");
  line.option("--poisson", command.material.poisson, "Poisson's ratio").required().type_name("NU");
  line.option("--density", command.material.density_kg_m3, "density, kg/m^3").required().type_name("KG_M3");
  line.option("--scale", command.metres_per_unit, "metres per unit of the mesh file (0.001 for millimetres)")
      .required()
      .type_name("METRES");
  line.option("--merge", command.check.merge_m,
              "makes one node of those that are at most so far apart, m: for parts glued by copying")
      .not_negative()
      .type_name("METRES");
  line.flag("--repair", command.check.repair,
            "drops tetrahedra that hang on a node or an edge only, where these are refused; says which, and "
            "how much volume");
  line.option(
          "--fixed", command.fixed,
          "what holds the organ; repeat for a union: FILE.csv of node numbers (one a line, or the column "
          "that "
          "a header calls node or id), plane:x<0.03 or box:x0,y0,z0,x1,y1,z1 in metres, each optionally with "
          ":xz for single components; + joins planes and boxes")
      .required()
      .type_name("SPEC");
  line.option(
          "--region", command.regions,
          "tissue of another material; repeat for several, of which the last one holds where they overlap: "
          "'PLACE; young=PA; poisson=NU; density=KG_M3' with one or more of these three; PLACE is label=N "
          "(of "
          "the mesh file: Gmsh's physical group, VTK's cell data, TetGen's last attribute), "
          "box=x0,y0,z0,x1,y1,z1 or ball=x,y,z,r in metres (tetrahedra whose centre lies there)")
      .type_name("SPEC");
  line.option(
          "--dynamic", command.dynamic,
          "makes a hybrid organ: these tetrahedra have masses and can be cut, the others are precomputed; "
          "repeat for a union, also of several parts: plane:x<0.03 or box:x0,y0,z0,x1,y1,z1 in metres (of "
          "tetrahedra the centre; + joins them), label:N of the mesh file, or FILE.csv of tetrahedron "
          "numbers")
      .type_name("SPEC");
  line.option(
          "--dynamic-mesh", command.dynamic_mesh,
          "makes a hybrid organ of two meshes that lie on each other without sharing nodes: this one, the "
          "coarser where they touch, has masses and can be cut, and MESH is precomputed; its numbers go on "
          "behind those of MESH")
      .type_name("COARSE");
  line.option("--dynamic-gap", command.dynamic_gap_m,
              "how far the two meshes may lie apart or overlap where they touch, m (default: a twentieth of "
              "the mean edge of COARSE)")
      .not_negative()
      .type_name("METRES");
  add_numbering_option(line, command.check.numbering);
  line.flag(
      "--ignore-other-cells", command.check.ignore_other_cells,
      "leaves out hexahedra, prisms and other cells that fill space but are no tetrahedra, where these are "
      "refused; surface and line cells are always left out");
  line.option(
          "--store", [&](const std::string& text) { return parse_storage(text, command.storage); },
          "precision of the stored tensors: float (default) or double")
      .type_name("PRECISION");
  line.option("--name", command.name, "the organ's name (default: the output file's)").type_name("NAME");
  line.option("--threads", command.threads, "workers over the columns (default: one per processor)")
      .between(1, 256)
      .type_name("N");
  line.flag("--force", command.force, "build even when ORGAN.h5 is up to date");
  line.option("--law", command.law, "quasi-non-linear law: not part of this version").type_name("FILE");
}

void require_offered(const BuildCommand& command) {
  if (!command.dynamic_mesh.empty() && !command.dynamic.empty()) {
    throw geometry::InputError("--dynamic-mesh " + command.dynamic_mesh.string() +
                               ": is the dynamic part; expected no --dynamic beside it");
  }
  if (command.dynamic_mesh.empty() && command.dynamic_gap_m > 0)
    throw geometry::InputError("--dynamic-gap: expected --dynamic-mesh beside it");
  if (command.law.empty()) return;
  throw geometry::InputError("--law " + command.law +
                             ": not part of this version, which builds linear elastic organs");
}

void require_own_output(const BuildCommand& command) {
  // .node and .ele are one mesh, named by either
  for (const char* extension : {"", ".node", ".ele", ".NODE", ".ELE"}) {
    const std::filesystem::path input =
        *extension == '\0' ? command.mesh : std::filesystem::path(command.mesh).replace_extension(extension);
    std::error_code absent;
    if (std::filesystem::equivalent(input, command.output, absent))
      throw geometry::InputError("-o " + command.output.string() +
                                 ": is the mesh itself; expected another file");
  }
}

}  // namespace omentum::organ_tools
