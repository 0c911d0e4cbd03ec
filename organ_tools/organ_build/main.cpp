// organ_build: a tetrahedral mesh, a material and supports become an organ file with its force tensors.
#include "organ/build_organ.h"
#include "organ/dynamic_spec.h"
#include "organ/joined_parts.h"
#include "organ/plausibility.h"
#include "organ/region_spec.h"
#include "organ/support_spec.h"
#include "organ_tools/fast_blas.h"
#include "organ_tools/organ_build/build_options.h"
#include "organ_tools/organ_build/interruption.h"
#include "organ_tools/organ_build/progress_line.h"
#include "physics/blas_threads.h"
#include "runtime/command_line.h"

#include <algorithm>
#include <iostream>
#include <thread>

namespace {

using namespace omentum;

constexpr int kExitInterrupted = 130;  // what shells expect after Ctrl-C
constexpr double kBytesPerMegabyte = 1e6;

int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void warn(const std::string& what) {
  std::cerr << "organ_build: warning: " << what << std::endl;
}

std::vector<std::uint8_t> dynamic_part(const organ_tools::BuildCommand& command,
                                       const geometry::TetraMesh& mesh) {
  std::vector<std::uint8_t> dynamic = organ::parse_dynamic(command.dynamic, mesh, command.check.numbering);
  if (dynamic.empty()) return dynamic;
  const std::size_t more = organ::take_what_would_hang(mesh, dynamic);
  if (more > 0) {
    warn("--dynamic: " + std::to_string(more) +
         " more tetrahedra would hang on one node or edge beside the dynamic part, and are made dynamic too");
  }
  return dynamic;
}

geometry::TetraMesh read_checked(const organ_tools::BuildCommand& command,
                                 const std::filesystem::path& file) {
  geometry::CheckedMesh checked =
      geometry::check_mesh(geometry::read_mesh(file), command.metres_per_unit, command.check);
  for (const std::string& warning : checked.warnings) warn(warning);
  return std::move(checked.mesh);
}

// The whole mesh, what of it is dynamic, and where parts touch that share no nodes.
organ::JoinedParts read_parts(const organ_tools::BuildCommand& command) {
  geometry::TetraMesh mesh = read_checked(command, command.mesh);
  if (command.dynamic_mesh.empty()) {
    // before regions take labels of the file over
    std::vector<std::uint8_t> dynamic = dynamic_part(command, mesh);
    return {std::move(mesh), std::move(dynamic), {}};
  }
  const std::string where = "--dynamic-mesh " + command.dynamic_mesh.string() + ": ";
  organ::JoinedParts joined =
      organ::join_parts(mesh, read_checked(command, command.dynamic_mesh), command.dynamic_gap_m, where);
  if (command.check.numbering == geometry::Numbering::kFile) {
    std::printf("organ_build: nodes of %s have their numbers + %lld in the organ, tetrahedra + %lld\n",
                command.dynamic_mesh.filename().c_str(), static_cast<long long>(joined.node_shift),
                static_cast<long long>(joined.tetrahedron_shift));
  }
  return joined;
}

organ::Organ read_organ(const organ_tools::BuildCommand& command) {
  organ::JoinedParts parts = read_parts(command);
  physics::FixedComponents fixed = organ::parse_supports(command.fixed, parts.mesh, command.check.numbering);
  const physics::MaterialMap material = organ::parse_regions(command.regions, command.material, parts.mesh);
  const std::string name = command.name.empty() ? command.output.stem().string() : command.name;
  organ::Organ made = organ::make_organ(name, std::move(parts.mesh), material, std::move(fixed),
                                        command.storage, std::move(parts.dynamic), std::move(parts.border));
  for (const std::string& sentence : organ::implausible(made.mesh, made.material)) warn(sentence);
  return made;
}

void print_summary(const organ::Organ& organ, const organ::BuildResult& built,
                   const std::filesystem::path& file) {
  const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / kBytesPerMegabyte;
  std::printf("%s: %s: %zu nodes, %zu tetrahedra, %d surface nodes (%d mobile), %d columns, %.1f MB",
              file.c_str(), built.up_to_date ? "up to date" : "built", organ.mesh.positions.size(),
              organ.mesh.tetrahedra.size(), organ.surface.node_count(), organ.surface.mobile_count,
              built.columns, megabytes);
  if (organ.split) {
    std::printf("; tensors of %zu precomputed tetrahedra, %zu dynamic ones, %zu connection nodes",
                organ.split->parts.precomputed.tetrahedron.size(),
                organ.split->parts.dynamic.tetrahedron.size(), organ.split->connection.size());
  }
  if (!built.up_to_date) {
    std::printf("; factorized in %.2f s, columns in %.2f s, in all %.2f s", built.factor_s, built.columns_s,
                built.total_s);
  }
  std::printf("\n");
}

void build(const organ_tools::BuildCommand& command) {
  organ_tools::require_offered(command);
  organ_tools::require_own_output(command);
  if (command.threads > default_threads()) organ_tools::require_blas_memory("organ_build", command.threads);
  if (const std::string warning = physics::blas_warning(); !warning.empty()) warn(warning);
  organ_tools::ProgressLine progress("organ_build");
  const organ::Organ organ = read_organ(command);

  organ::BuildOptions options;
  options.force = command.force;
  options.threads = command.threads > 0 ? command.threads : default_threads();
  options.on_progress = [&](const std::string& stage, double fraction) { progress(stage, fraction); };
  options.stopped = organ_tools::interrupted;
  print_summary(organ, organ::build_organ(organ, command.output, options), command.output);
  organ_tools::tell_fast_blas("organ_build");
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);
  organ_tools::require_blas_memory("organ_build", default_threads());
  organ_tools::watch_for_interruption();
  runtime::CommandLine line("organ_build",
                            "Computes the force tensors of an organ from its mesh, material and supports.");
  organ_tools::BuildCommand command;
  organ_tools::add_build_options(line, command);
  const int code = line.run(argc, argv, [&] { build(command); });
  return organ_tools::interrupted() && code != 0 ? kExitInterrupted : code;
}
