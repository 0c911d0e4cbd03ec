#include "organ_tools/organ_solve/imposed_csv.h"

#include "organ/csv.h"
#include "organ_tools/organ_solve/solve_models.h"

#include <cmath>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::NodeId;

// [file_node_count]: the mesh node of each of the file's; invalid where no tetrahedron uses it.
std::vector<NodeId> nodes_of_file(const geometry::TetraMesh& mesh) {
  std::vector<NodeId> node(mesh.file_node_count);
  for (std::size_t n = 0; n < mesh.file_node.size(); ++n) node[mesh.file_node[n]] = NodeId(n);
  return node;
}

NodeId parse_node(const organ::CsvLine& line, const std::vector<NodeId>& nodes) {
  const auto number = organ::parse_integer(line.fields[0]);
  if (!number || *number < 0 || *number >= static_cast<std::int32_t>(nodes.size())) {
    throw InputError(line.where + ": found node '" + line.fields[0] + "'; expected a number from 0 to " +
                     std::to_string(nodes.size() - 1));
  }
  if (!nodes[*number].valid()) {
    throw InputError(line.where + ": node " + line.fields[0] + " belongs to no tetrahedron");
  }
  return nodes[*number];
}

physics::ImposedDisplacement parse_line(const organ::CsvLine& line, const std::vector<NodeId>& nodes,
                                        const organ::Organ& organ, double limit) {
  if (line.fields.size() != 4) {
    throw InputError(line.where + ": found " + std::to_string(line.fields.size()) +
                     " fields; expected 4: node,ux,uy,uz");
  }
  physics::ImposedDisplacement imposed{parse_node(line, nodes), {}};
  const std::uint8_t held = organ.fixed[imposed.node];
  if (held == physics::kPinned) {
    throw InputError(line.where + ": node " + line.fields[0] + " is held by a support in all components");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& field = line.fields[axis + 1];
    const auto value = organ::parse_number(field);
    if (!value) throw InputError(line.where + ": found '" + field + "'; expected a displacement in metres");
    if (*value != 0 && physics::is_fixed(held, axis)) {
      throw InputError(line.where + ": node " + line.fields[0] + " is held by a support along " +
                       static_cast<char>('x' + axis) + "; expected 0 there, found " + field);
    }
    if (std::abs(*value) > limit) {
      throw InputError(line.where + ": node " + line.fields[0] + ": found " + field +
                       " m, a thousand times the organ's "
                       "size or more");
    }
    imposed.displacement[axis] = *value;
  }
  return imposed;
}

}  // namespace

std::vector<physics::ImposedDisplacement> read_imposed(const std::filesystem::path& file,
                                                       const organ::Organ& organ) {
  const std::vector<NodeId> nodes = nodes_of_file(organ.mesh);
  const double limit = largest_displacement(organ.mesh);
  std::vector<std::string> listed_at(organ.mesh.positions.size());
  std::vector<physics::ImposedDisplacement> imposed;
  for (const organ::CsvLine& line : organ::read_csv(file)) {
    imposed.push_back(parse_line(line, nodes, organ, limit));
    std::string& before = listed_at[imposed.back().node];
    if (!before.empty()) {
      throw InputError(line.where + ": node " + line.fields[0] + " is listed twice, first at " + before);
    }
    before = line.where;
  }
  return imposed;
}

}  // namespace omentum::organ_tools
