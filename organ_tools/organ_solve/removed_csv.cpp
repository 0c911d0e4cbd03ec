#include "organ_tools/organ_solve/removed_csv.h"

#include "organ/csv.h"

#include <array>

namespace omentum::organ_tools {

namespace {

constexpr std::array kNames = {"tetrahedron", "tetrahedra", "tet", "tets", "element", "cell", "id"};

}  // namespace

std::vector<geometry::TetId> read_removed(const std::filesystem::path& file, const organ::Organ& organ,
                                          geometry::Numbering numbering) {
  const organ::CsvTable table = organ::read_csv(file);
  if (table.numbering.value_or(numbering) != numbering) {
    throw geometry::InputError(table.lines.front().where +
                               ": a comment above says another numbering than --numbering does");
  }
  std::size_t column = 0;
  if (table.header)
    column = organ::find_column(*table.header, kNames, "named tetrahedron (or tet, element, cell, id)");
  const geometry::FileNumbers names(organ.mesh.tetrahedron_numbers, organ.mesh.tetrahedra.size(), numbering);
  std::vector<geometry::TetId> removed;
  for (const organ::CsvLine& line : table.lines) {
    const std::string& field = line.fields[column];
    const auto number = organ::parse_integer(field);
    const auto position = number ? names.position_of(*number) : std::nullopt;
    if (!position) {
      throw geometry::InputError(line.where + ": found '" + field +
                                 "'; expected the number of a tetrahedron, " + names.range());
    }
    removed.emplace_back(*position);
  }
  return removed;
}

}  // namespace omentum::organ_tools
