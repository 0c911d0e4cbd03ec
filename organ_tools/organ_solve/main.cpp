// organ_solve: imposed displacements in, displacements of every node and holding forces out.
#include "organ/csv.h"
#include "organ/tetrahedra_csv.h"
#include "organ_tools/fast_blas.h"
#include "organ_tools/numbering_option.h"
#include "organ_tools/organ_solve/hybrid_cut_solve.h"
#include "organ_tools/organ_solve/imposed_csv.h"
#include "organ_tools/organ_solve/move_to_rest.h"
#include "organ_tools/organ_solve/solution_csv.h"
#include "organ_tools/organ_solve/solve_cut.h"
#include "organ_tools/organ_solve/solve_models.h"
#include "runtime/command_line.h"

#include <iostream>

namespace {

using namespace omentum;

struct SolveCommand {
  std::filesystem::path organ;
  std::filesystem::path imposed;
  std::string model = "tensors";
  std::string law;
  std::string gravity;
  std::filesystem::path removed;
  std::string prefix;
  geometry::Numbering numbering = geometry::Numbering::kFile;
};

void add_options(runtime::CommandLine& line, SolveCommand& command) {
  line.option("organ", command.organ, "organ file").required().type_name("ORGAN.h5");
  line.option("--imposed", command.imposed, "CSV: node,ux,uy,uz (m), in this order or as a header names them")
      .type_name("FILE");
  organ_tools::add_numbering_option(line, command.numbering);
  line.option("--model", command.model,
              "tensors, direct, cut (the whole organ's factor, downdated), or one that moves until it rests: "
              "tensor-mass, corotational, spring-mass, or hybrid (of an organ with a dynamic part)")
      .type_name("MODEL")
      .show_default();
  line.option("--law", command.law, "of the dynamic part of --model hybrid: linear (default) or corotational")
      .type_name("LAW");
  line.option("--gravity", command.gravity, "acceleration x,y,z, m/s^2").type_name("X,Y,Z");
  line.option(
          "--remove", command.removed,
          "CSV: tetrahedra to take out first, with what then hangs on one node or edge; they weigh nothing "
          "any more, and nodes without any left stay where they are")
      .type_name("FILE");
  line.option(
          "-o,--output", command.prefix,
          "writes PREFIX.u.csv, displacements (m), and PREFIX.f.csv, all that holds each imposed node (N): "
          "where a support holds a component, the support's share")
      .required()
      .type_name("PREFIX");
}

void require_offered(const SolveCommand& command) {
  const bool tensors = command.model == "tensors";
  if (!tensors && command.model != "direct" && command.model != "cut" && command.model != "hybrid" &&
      !organ_tools::is_dynamic_model(command.model)) {
    throw geometry::InputError("--model " + command.model +
                               ": not part of this version; expected tensors, direct, cut, tensor-mass, "
                               "corotational, spring-mass or hybrid");
  }
  if (!command.law.empty() && command.model != "hybrid") {
    throw geometry::InputError("--law " + command.law + ": --model " + command.model +
                               " has no law to choose; expected --model hybrid");
  }
  if (!command.law.empty() && command.law != "linear" && command.law != "corotational")
    throw geometry::InputError("--law " + command.law + ": expected linear or corotational");
  if (tensors && !command.removed.empty()) {
    throw geometry::InputError("--remove " + command.removed.string() +
                               ": stored tensors are of the uncut organ; expected another --model");
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

organ_tools::CutOrgan cut_of(const SolveCommand& command, const organ::Organ& organ,
                             organ_tools::Imposed imposed) {
  std::vector<geometry::TetId> asked;
  if (!command.removed.empty())
    asked = organ::read_tetrahedra(command.removed, organ.mesh, command.numbering);
  organ_tools::CutOrgan cut = organ_tools::cut_organ(organ, asked, imposed, command.numbering);
  if (cut.repaired > 0) {
    std::cerr << "organ_solve: --remove " << command.removed.string() << ": " << cut.repaired
              << " more tetrahedra then hang on one node or edge, and are taken out too" << std::endl;
  }
  return cut;
}

physics::StaticSolution answer(const SolveCommand& command, const organ::Organ& organ,
                               const organ_tools::CutOrgan& cut, organ_tools::Imposed imposed,
                               const geometry::Vec3& gravity, std::string& warning) {
  if (command.model == "direct") return organ_tools::solve_directly(organ, cut, imposed, gravity);
  if (command.model == "cut") return organ_tools::solve_cut(organ, cut, imposed, gravity);
  if (command.model == "hybrid") {
    const auto law = command.law == "corotational" ? organ_tools::DynamicLaw::kCorotational
                                                   : organ_tools::DynamicLaw::kLinear;
    if (organ_tools::cuts_precomputed(organ, cut))
      return organ_tools::solve_hybrid_cut(organ, cut, imposed, gravity, law);
    return organ_tools::solve_hybrid(organ, command.organ, cut, imposed, gravity, command.numbering, law);
  }
  if (command.model != "tensors")
    return organ_tools::move_to_rest(command.model, organ, cut, imposed, gravity);
  return organ_tools::solve_with_tensors(organ, command.organ, imposed, gravity, command.numbering, warning);
}

void solve(const SolveCommand& command) {
  require_offered(command);
  const geometry::Vec3 gravity = parse_gravity(command.gravity);
  const organ::Organ organ = organ::load_organ(command.organ, organ::Load::kMeshOnly);
  organ_tools::require_knows_tie(organ, command.organ, command.model);
  std::vector<physics::ImposedDisplacement> imposed;
  if (!command.imposed.empty())
    imposed = organ_tools::read_imposed(command.imposed, organ, command.numbering);
  const organ_tools::CutOrgan cut = cut_of(command, organ, imposed);
  std::string warning;
  const physics::StaticSolution solution = answer(command, organ, cut, imposed, gravity, warning);
  organ_tools::require_sensible(organ, imposed, solution, command.numbering);
  if (!warning.empty()) std::cerr << "organ_solve: warning: " << warning << std::endl;
  organ_tools::write_solution(command.prefix, organ, imposed, solution, command.numbering);
  organ_tools::tell_fast_blas("organ_solve");
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
