// Labels that mesh files give their tetrahedra: which tissue each belongs to.
#pragma once

#include "geometry/mesh_io/file_cursor.h"
#include "geometry/tetra_mesh.h"

#include <optional>

namespace omentum::geometry {

/// Whether an array of cell data is one of labels: label, region or material, in the plural or followed by id
/// or ids, and gmsh:physical, medit:ref, CellEntityIds; capitals, blanks and signs do not count.
bool is_label_name(std::string_view name);

/// A whole number of 32 bits, "2.0" included; nothing otherwise.
std::optional<std::int32_t> label_in(const std::string& word);

/// `value`, or FileCursor's refusal where it has more than 32 bits.
std::int32_t checked_label(const FileCursor& in, std::int64_t value, const char* expected);

/// The labels of one list of cells, out of those of its arrays that are called so.
class CellLabels {
 public:
  /// An array of a label's name: its values, [cells].
  void add(const std::string& name, const std::vector<std::int64_t>& values);
  /// A part of the file that might have held labels and cannot be read.
  void miss(const std::string& why);

  /// [cells], or empty; `why` gets a sentence where there are several answers, or one that cannot be used.
  std::vector<std::int32_t> take(std::string& why);

 private:
  void refuse(const std::string& why);

  std::string name_, why_;
  std::vector<std::int32_t> labels_;
};

/// Of a mesh that was read: no labels at all where the file's cannot be used, or where all are 0, which is
/// what writers put where nobody gave any.
void settle_labels(RawMesh& mesh);

}  // namespace omentum::geometry
