#include "organ_tools/organ_build/build_options.h"

#include <CLI/CLI.hpp>

namespace omentum::organ_tools {

void add_build_options(CLI::App& app, BuildCommand& command) {
  app.add_option("mesh", command.mesh, "tetrahedra: .msh (1, 2.2, 4), .vtk, .vtu, .node/.ele")
      ->required()
      ->type_name("MESH");
  app.add_option("-o,--output", command.output, "organ file to write (HDF5)")
      ->required()
      ->type_name("ORGAN.h5");
  app.add_option("--young", command.material.young_pa, "Young's modulus, Pa")->required()->type_name("PA");
  app.add_option("--poisson", command.material.poisson, "Poisson's ratio")->required()->type_name("NU");
  app.add_option("--density", command.material.density_kg_m3, "density, kg/m^3")
      ->required()
      ->type_name("KG_M3");
  app.add_option("--scale", command.metres_per_unit,
                 "metres per unit of the mesh file (0.001 for millimetres)")
      ->required()
      ->type_name("METRES");
  app.add_option("--fixed", command.fixed,
                 "what holds the organ; repeat for a union: FILE.csv of node numbers, plane:x<0.03 or "
                 "box:x0,y0,z0,x1,y1,z1 in metres, each optionally with :xz for single components")
      ->required()
      ->type_name("SPEC")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--store", command.storage, "precision of the stored tensors: float (default) or double")
      ->transform(CLI::CheckedTransformer(std::map<std::string, organ::Storage>{
          {"float", organ::Storage::kFloat}, {"double", organ::Storage::kDouble}}))
      ->type_name("PRECISION");
  app.add_option("--name", command.name, "the organ's name (default: the output file's)")->type_name("NAME");
  app.add_option("--threads", command.threads, "workers over the columns (default: one per processor)")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  app.add_flag("--force", command.force, "build even when ORGAN.h5 is up to date");
  app.add_option("--law", command.law, "quasi-non-linear law: not part of this version")->type_name("FILE");
  app.add_option("--dynamic", command.dynamic, "dynamic part: not part of this version")->type_name("SPEC");
}

void require_offered(const BuildCommand& command) {
  const auto refuse = [](const std::string& option) {
    throw geometry::InputError(option + ": not part of this version, which builds linear elastic organs");
  };
  if (!command.law.empty()) refuse("--law " + command.law);
  if (!command.dynamic.empty()) refuse("--dynamic " + command.dynamic);
}

void require_own_output(const BuildCommand& command) {
  // .node and .ele are one mesh, named by either
  for (const char* extension : {"", ".node", ".ele"}) {
    const std::filesystem::path input =
        *extension == '\0' ? command.mesh : std::filesystem::path(command.mesh).replace_extension(extension);
    std::error_code absent;
    if (std::filesystem::equivalent(input, command.output, absent))
      throw geometry::InputError("-o " + command.output.string() +
                                 ": is the mesh itself; expected another file");
  }
}

}  // namespace omentum::organ_tools
