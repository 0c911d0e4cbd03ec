#include "organ_tools/organ_solve/imposed_csv.h"

#include "organ/csv.h"
#include "organ/node_column.h"
#include "organ_tools/organ_solve/solve_models.h"

#include <array>
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

// Where ux, uy and uz stand.
std::array<std::size_t, 3> displacement_columns(const organ::CsvTable& table) {
  if (!table.header) return {1, 2, 3};
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name{'u', static_cast<char>('x' + axis)};
    const char* const names[] = {name.c_str()};
    columns[axis] = organ::find_column(*table.header, names, ("named " + name + " (m)").c_str());
  }
  return columns;
}

class ImposedReader {
 public:
  ImposedReader(const organ::CsvTable& table, const organ::Organ& organ, geometry::Numbering numbering)
      : organ_(organ),
        node_column_(table, organ.mesh, numbering),
        columns_(displacement_columns(table)),
        width_(table.header ? table.header->fields.size() : 4),
        nodes_(nodes_of_file(organ.mesh)),
        limit_(largest_displacement(organ.mesh)) {}

  physics::ImposedDisplacement read(const organ::CsvLine& line) const {
    if (line.fields.size() != width_)
      refuse(line, "found " + std::to_string(line.fields.size()) + " fields; expected 4: node,ux,uy,uz");
    physics::ImposedDisplacement imposed{read_node(line), {}};
    for (int axis = 0; axis < 3; ++axis)
      imposed.displacement[axis] = read_component(line, organ_.fixed[imposed.node], axis);
    return imposed;
  }

  std::string node(const organ::CsvLine& line) const { return "node " + node_column_.name(line); }
  [[noreturn]] static void refuse(const organ::CsvLine& line, const std::string& what) {
    throw InputError(line.where + ": " + what);
  }

 private:
  NodeId read_node(const organ::CsvLine& line) const {
    const NodeId n = nodes_[node_column_.position(line)];
    if (!n.valid()) refuse(line, node(line) + " belongs to no tetrahedron");
    if (organ_.fixed[n] == physics::kPinned)
      refuse(line, node(line) + " is held by a support in all components");
    return n;
  }

  double read_component(const organ::CsvLine& line, std::uint8_t held, int axis) const {
    const std::string& field = line.fields[columns_[axis]];
    const auto value = organ::parse_number(field);
    if (!value) refuse(line, "found '" + field + "'; expected a displacement in metres");
    if (*value != 0 && physics::is_fixed(held, axis)) {
      refuse(line, node(line) + " is held by a support along " + static_cast<char>('x' + axis) +
                       "; expected 0 there, found " + field);
    }
    if (std::abs(*value) > limit_)
      refuse(line, node(line) + ": found " + field + " m, a thousand times the organ's size or more");
    return *value;
  }

  const organ::Organ& organ_;
  organ::NodeColumn node_column_;
  std::array<std::size_t, 3> columns_;  // of ux, uy, uz
  std::size_t width_;
  std::vector<NodeId> nodes_;
  double limit_;  // m
};

}  // namespace

std::vector<physics::ImposedDisplacement> read_imposed(const std::filesystem::path& file,
                                                       const organ::Organ& organ,
                                                       geometry::Numbering numbering) {
  const organ::CsvTable table = organ::read_csv(file);
  const ImposedReader reader(table, organ, numbering);
  std::vector<std::string> listed_at(organ.mesh.positions.size());
  std::vector<physics::ImposedDisplacement> imposed;
  for (const organ::CsvLine& line : table.lines) {
    imposed.push_back(reader.read(line));
    std::string& before = listed_at[imposed.back().node];
    if (!before.empty())
      ImposedReader::refuse(line, reader.node(line) + " is listed twice, first at " + before);
    before = line.where;
  }
  return imposed;
}

}  // namespace omentum::organ_tools
