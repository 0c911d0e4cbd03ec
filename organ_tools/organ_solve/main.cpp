// organ_solve: imposed displacements in, displacements of every node and holding forces out.
#include "organ/csv.h"
#include "organ_tools/fast_blas.h"
#include "organ_tools/numbering_option.h"
#include "organ_tools/organ_solve/imposed_csv.h"
#include "organ_tools/organ_solve/solution_csv.h"
#include "organ_tools/organ_solve/solve_models.h"
#include "runtime/command_line.h"

#include <iostream>

namespace {

using namespace omentum;

struct SolveCommand {
  std::filesystem::path organ;
  std::filesystem::path imposed;
  std::string model = "tensors";
  std::string gravity;
  std::string removed;
  std::string prefix;
  geometry::Numbering numbering = geometry::Numbering::kFile;
};

void add_options(runtime::CommandLine& line, SolveCommand& command) {
  line.option("organ", command.organ, "organ file").required().type_name("ORGAN.h5");
  line.option("--imposed", command.imposed, "CSV: node,ux,uy,uz (m), in this order or as a header names them")
      .type_name("FILE");
  organ_tools::add_numbering_option(line, command.numbering);
  line.option("--model", command.model, "tensors or direct").type_name("MODEL").show_default();
  line.option("--gravity", command.gravity, "acceleration x,y,z, m/s^2").type_name("X,Y,Z");
  line.option("--remove", command.removed, "removed tetrahedra: not part of this version").type_name("FILE");
  line.option(
          "-o,--output", command.prefix,
          "writes PREFIX.u.csv, displacements (m), and PREFIX.f.csv, all that holds each imposed node (N): "
          "where a support holds a component, the support's share")
      .required()
      .type_name("PREFIX");
}

void require_offered(const SolveCommand& command) {
  if (command.model != "tensors" && command.model != "direct") {
    throw geometry::InputError("--model " + command.model +
                               ": not part of this version; expected tensors or direct");
  }
  if (!command.removed.empty()) {
    throw geometry::InputError("--remove " + command.removed +
                               ": not part of this version, which cuts nothing");
  }
  if (command.imposed.empty() && command.gravity.empty()) {
    throw geometry::InputError("nothing to solve: expected --imposed, --gravity or both");
  }
}

geometry::Vec3 parse_gravity(const std::string& text) {
  geometry::Vec3 gravity = geometry::Vec3::Zero();
  if (text.empty()) return gravity;
  const std::vector<std::string> fields = organ::split_fields(text);
  for (std::size_t axis = 0; axis < fields.size() || axis < 3; ++axis) {
    const auto value = fields.size() == 3 ? organ::parse_number(fields[axis]) : std::nullopt;
    if (!value) throw geometry::InputError("--gravity " + text + ": expected three numbers x,y,z in m/s^2");
    gravity[static_cast<Eigen::Index>(axis)] = *value;
  }
  return gravity;
}

void solve(const SolveCommand& command) {
  require_offered(command);
  const geometry::Vec3 gravity = parse_gravity(command.gravity);
  const organ::Organ organ = organ::load_organ(command.organ, organ::Load::kMeshOnly);
  std::vector<physics::ImposedDisplacement> imposed;
  if (!command.imposed.empty())
    imposed = organ_tools::read_imposed(command.imposed, organ, command.numbering);
  if (const std::string note = organ_tools::fast_blas_note(); !note.empty())
    std::cerr << "organ_solve: " << note << std::endl;
  std::string warning;
  const physics::StaticSolution solution =
      command.model == "direct" ? organ_tools::solve_directly(organ, imposed, gravity)
                                : organ_tools::solve_with_tensors(organ, command.organ, imposed, gravity,
                                                                  command.numbering, warning);
  organ_tools::require_sensible(organ, imposed, solution, command.numbering);
  if (!warning.empty()) std::cerr << "organ_solve: warning: " << warning << std::endl;
  organ_tools::write_solution(command.prefix, organ, imposed, solution, command.numbering);
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);
  organ_tools::require_blas_memory("organ_solve", 1);
  runtime::CommandLine line("organ_solve", "Solves an organ for imposed displacements and gravity.");
  SolveCommand command;
  add_options(line, command);
  return line.run(argc, argv, [&] { solve(command); });
}
