#include "organ_tools/organ_solve/solution_csv.h"

#include "organ/csv.h"
#include "organ/partial_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace omentum::organ_tools {

namespace {

using geometry::Vec3;

void append_row(std::string& text, std::int64_t node, const Vec3& v) {
  char row[120];
  std::snprintf(row, sizeof row, "%lld,%.12e,%.12e,%.12e\n", static_cast<long long>(node), v.x(), v.y(),
                v.z());
  text += row;
}

void write(const organ::PartialFile& partial, const std::string& text) {
  std::ofstream out(partial.path(), std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw geometry::InputError(partial.path().string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

void write_solution(const std::string& prefix, const organ::Organ& organ, Imposed imposed,
                    const physics::StaticSolution& solution, geometry::Numbering numbering) {
  const geometry::FileNumbers names = organ.mesh.names_of_nodes(numbering);
  const std::vector<geometry::NodeId> nodes = organ.mesh.nodes_of_file();
  std::string displacements = organ::numbering_comment(numbering) + "node,ux,uy,uz\n";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 u = nodes[i].valid() ? solution.displacements[nodes[i]] : Vec3(Vec3::Zero());
    append_row(displacements, names.of(i), u);
  }
  std::string forces = organ::numbering_comment(numbering) + "node,fx,fy,fz\n";
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    append_row(forces, names.of(organ.mesh.file_node[imposed[i].node]), solution.holding_forces[i]);
  }
  // nothing is in its place before both are whole
  organ::PartialFile u(prefix + ".u.csv"), f(prefix + ".f.csv");
  write(u, displacements);
  write(f, forces);
  u.move_to_its_place();
  f.move_to_its_place();
}

}  // namespace omentum::organ_tools
