#include "organ/node_column.h"

#include <array>

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::Numbering;

constexpr std::array kNames = {
    "node", "nodes", "id", "nodeid", "nodenumber", "nodetag", "tag", "pointid", "vtkoriginalpointids"};
constexpr const char* kExpected = "named node or id (or node id, node number, node tag, tag, point id)";

void require_same(const CsvTable& table, Numbering numbering) {
  if (table.numbering.value_or(numbering) == numbering) return;
  const bool by_position = numbering == Numbering::kFile;
  throw InputError(table.lines.front().where + ": a comment above says that nodes are numbered by " +
                   (by_position ? "position" : "the mesh file") + "; expected numbers " +
                   (by_position ? "of the mesh file (or --numbering position)"
                                : "by position (or no --numbering position)"));
}

}  // namespace

NodeColumn::NodeColumn(const CsvTable& table, const geometry::TetraMesh& mesh, Numbering numbering)
    : numbering_(numbering), names_(mesh.names_of_nodes(numbering)) {
  require_same(table, numbering);
  if (table.header) column_ = find_column(*table.header, kNames, kExpected);
}

std::int32_t NodeColumn::position(const CsvLine& line) const {
  const auto number = parse_integer(name(line));
  const auto position = number ? names_.position_of(*number) : std::nullopt;
  if (position) return *position;
  const bool own = numbering_ == Numbering::kFile;
  throw InputError(line.where + ": found '" + name(line) + "'; expected a node number " +
                   (own ? "of the mesh file's own, " : "") + names_.range() +
                   (own ? " (--numbering position counts from 0)" : ", by position"));
}

}  // namespace omentum::organ
