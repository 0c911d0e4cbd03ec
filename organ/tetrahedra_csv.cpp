#include "organ/tetrahedra_csv.h"

#include "organ/csv.h"

#include <array>

namespace omentum::organ {

namespace {

constexpr std::array kNames = {"tetrahedron", "tetrahedra", "tet", "tets", "element", "cell", "id"};

}  // namespace

std::vector<geometry::TetId> read_tetrahedra(const std::filesystem::path& file,
                                             const geometry::TetraMesh& mesh, geometry::Numbering numbering) {
  const CsvTable table = read_csv(file);
  if (table.numbering.value_or(numbering) != numbering) {
    throw geometry::InputError(table.lines.front().where +
                               ": a comment above says another numbering than --numbering does");
  }
  std::size_t column = 0;
  if (table.header)
    column = find_column(*table.header, kNames, "named tetrahedron (or tet, element, cell, id)");
  const geometry::FileNumbers names(mesh.tetrahedron_numbers, mesh.tetrahedra.size(), numbering);
  std::vector<geometry::TetId> listed;
  for (const CsvLine& line : table.lines) {
    const std::string& field = line.fields[column];
    const auto number = parse_integer(field);
    const auto position = number ? names.position_of(*number) : std::nullopt;
    if (!position) {
      throw geometry::InputError(line.where + ": found '" + field +
                                 "'; expected the number of a tetrahedron, " + names.range());
    }
    listed.emplace_back(*position);
  }
  return listed;
}

}  // namespace omentum::organ
