// The command line of organ_build.
#pragma once

#include "organ/organ.h"
#include "runtime/command_line.h"

#include <filesystem>
#include <string>
#include <vector>

namespace omentum::organ_tools {

struct BuildCommand {
  std::filesystem::path mesh;
  std::filesystem::path output;
  physics::Material material;
  double metres_per_unit = 0;
  geometry::CheckOptions check;
  std::vector<std::string> fixed;
  std::vector<std::string> regions;
  organ::Storage storage = organ::Storage::kFloat;
  std::string name;  // empty: the output file's stem
  int threads = 0;   // 0: one per processor
  bool force = false;
  std::vector<std::string> dynamic;
  std::filesystem::path dynamic_mesh;  // empty: none
  double dynamic_gap_m = 0;            // 0: as join_parts takes it
  std::string law;                     // refused
};

/// Adds the options to `line`.
void add_build_options(runtime::CommandLine& line, BuildCommand& command);

/// Throws geometry::InputError for what this version does not offer, rather than ignoring it.
void require_offered(const BuildCommand& command);

/// Throws geometry::InputError where the organ file would replace the mesh that it is made from.
void require_own_output(const BuildCommand& command);

}  // namespace omentum::organ_tools
