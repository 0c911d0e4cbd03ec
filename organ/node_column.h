// Which nodes of a mesh file the lines of a table mean.
#pragma once

#include "geometry/tetra_mesh.h"
#include "organ/csv.h"

namespace omentum::organ {

/// The column of node numbers: that which the header calls node, nodes, id, node id, node number, node tag,
/// tag, point id or vtkOriginalPointIds; the first one without a header. `table` and `mesh` must outlive it.
class NodeColumn {
 public:
  /// Throws geometry::InputError, naming file and line, for a header without such a column or with several,
  /// and for a table whose comment says another numbering.
  NodeColumn(const CsvTable& table, const geometry::TetraMesh& mesh, geometry::Numbering numbering);

  /// The field itself, for messages.
  const std::string& name(const CsvLine& line) const { return line.fields[column_]; }
  /// The position in the mesh file, from 0, of the node that a line of the table names. Throws
  /// geometry::InputError, naming file, line and expectation, where the mesh file has no such node.
  std::int32_t position(const CsvLine& line) const;

 private:
  geometry::Numbering numbering_;
  geometry::FileNumbers names_;
  std::size_t column_ = 0;
};

}  // namespace omentum::organ
