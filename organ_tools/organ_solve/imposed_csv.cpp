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
        names_(organ.mesh.names_of_nodes(numbering)),
        columns_(displacement_columns(table)),
        width_(table.header ? table.header->fields.size() : 4),
        nodes_(organ.mesh.nodes_of_file()),
        limit_(largest_displacement(organ.mesh)) {}

  physics::ImposedDisplacement read(const organ::CsvLine& line) const {
    if (line.fields.size() != width_)
      refuse(line, "found " + std::to_string(line.fields.size()) + " fields; expected 4: node,ux,uy,uz");
    physics::ImposedDisplacement imposed{read_node(line), {}};
    for (int axis = 0; axis < 3; ++axis)
      imposed.displacement[axis] = read_component(line, organ_.fixed[imposed.node], axis);
    return imposed;
  }

  // Twins have two names, and go one way.
  bool is_same_of_twin(const organ::CsvLine& a, const organ::CsvLine& b) const {
    return node_column_.position(a) != node_column_.position(b) &&
           read(a).displacement == read(b).displacement;
  }

  std::string node(const organ::CsvLine& line) const {
    const std::int32_t position = node_column_.position(line);
    const NodeId n = nodes_[position];
    std::string name = "node " + node_column_.name(line);
    if (!n.valid() || organ_.mesh.file_node[n] == position) return name;
    return name + " (merged into node " + std::to_string(names_.of(organ_.mesh.file_node[n])) + ")";
  }
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
  geometry::FileNumbers names_;
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
  std::vector<const organ::CsvLine*> listed(organ.mesh.positions.size());
  std::vector<physics::ImposedDisplacement> imposed;
  for (const organ::CsvLine& line : table.lines) {
    const physics::ImposedDisplacement next = reader.read(line);
    const organ::CsvLine*& before = listed[next.node];
    if (before == nullptr) {
      before = &line;
      imposed.push_back(next);
    } else if (!reader.is_same_of_twin(*before, line)) {
      ImposedReader::refuse(line, reader.node(line) + " is listed twice, first at " + before->where);
    }
  }
  return imposed;
}

}  // namespace omentum::organ_tools
