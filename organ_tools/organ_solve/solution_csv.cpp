#include "organ_tools/organ_solve/solution_csv.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace omentum::organ_tools {

namespace {

using geometry::Vec3;

void append_row(std::string& text, std::int32_t node, const Vec3& v) {
  char row[100];
  std::snprintf(row, sizeof row, "%d,%.12e,%.12e,%.12e\n", node, v.x(), v.y(), v.z());
  text += row;
}

void write_whole(const std::string& file, const std::string& text) {
  const std::string partial = file + ".partial";
  std::FILE* out = std::fopen(partial.c_str(), "w");
  bool whole = out != nullptr && std::fwrite(text.data(), 1, text.size(), out) == text.size();
  if (out != nullptr) whole = std::fclose(out) == 0 && whole;
  if (whole && std::rename(partial.c_str(), file.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(partial.c_str());
  throw geometry::InputError(file + ": cannot be written: " + reason);
}

}  // namespace

void write_solution(const std::string& prefix, const organ::Organ& organ, Imposed imposed,
                    const physics::StaticSolution& solution) {
  std::vector<Vec3> by_file_node(organ.mesh.file_node_count, Vec3::Zero());
  for (std::size_t n = 0; n < solution.displacements.size(); ++n) {
    by_file_node[organ.mesh.file_node[n]] = solution.displacements[n];
  }
  std::string displacements = "node,ux,uy,uz\n";
  for (std::size_t n = 0; n < by_file_node.size(); ++n) {
    append_row(displacements, static_cast<std::int32_t>(n), by_file_node[n]);
  }
  std::string forces = "node,fx,fy,fz\n";
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    append_row(forces, organ.mesh.file_node[imposed[i].node], solution.holding_forces[i]);
  }
  write_whole(prefix + ".u.csv", displacements);
  write_whole(prefix + ".f.csv", forces);
}

}  // namespace omentum::organ_tools
