#include "organ/support_spec.h"

#include "organ/csv.h"
#include "organ/node_column.h"
#include "organ/place_spec.h"
#include "organ/plausibility.h"

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::TetraMesh;

[[noreturn]] void refuse(const std::string& spec, const std::string& what) {
  throw InputError("--fixed " + spec + ": " + what);
}

struct Spec {
  std::string whole;
  std::string place;  // without the components
  std::uint8_t components = physics::kPinned;
};

// Splits a trailing ":xz" off.
Spec split_components(const std::string& text) {
  Spec spec{text, text, physics::kPinned};
  const std::size_t colon = text.rfind(':');
  // the colon of "plane:x" is not that of components
  if (colon == std::string::npos || text.substr(0, colon) == "plane" || text.substr(0, colon) == "box")
    return spec;
  const std::string letters = text.substr(colon + 1);
  if (letters.empty() || letters.size() > 3 || letters.find_first_not_of("xyz") != std::string::npos)
    return spec;
  spec.place = text.substr(0, colon);
  spec.components = 0;
  for (const char c : letters) spec.components |= static_cast<std::uint8_t>(1 << (c - 'x'));
  return spec;
}

// What SPECs are about.
struct SupportedMesh {
  const TetraMesh& mesh;
  geometry::Numbering numbering;
};

// Which nodes of the mesh file a CSV lists, by position, [file_node_count].
std::vector<bool> listed_nodes(const Spec& spec, const SupportedMesh& supported) {
  std::vector<bool> listed(supported.mesh.file_node_count);
  const CsvTable table = read_csv(spec.place);
  const NodeColumn nodes(table, supported.mesh, supported.numbering);
  for (const CsvLine& line : table.lines) {
    // which of several columns holds nodes is not for guessing
    if (!table.header && line.fields.size() > 1) {
      throw InputError(
          line.where + ": found " + std::to_string(line.fields.size()) +
          " columns without a header; expected one node number a line, or a first line that calls "
          "a column node or id");
    }
    listed[nodes.position(line)] = true;
  }
  for (const auto& [dropped, kept] : supported.mesh.merged) {
    if (listed[dropped]) listed[kept] = true;
  }
  return listed;
}

void add_supports(const Spec& spec, const SupportedMesh& supported, physics::FixedComponents& fixed) {
  const TetraMesh& mesh = supported.mesh;
  const Place there = place_of(spec.place, "--fixed", spec.whole);
  const std::vector<bool> listed = there ? std::vector<bool>{} : listed_nodes(spec, supported);
  std::int32_t held = 0;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (!(there ? there(mesh.positions[n]) : listed[mesh.file_node[n]])) continue;
    fixed[n] |= spec.components;
    ++held;
  }
  if (held == 0) refuse(spec.whole, "holds no node; the mesh extends over " + extent_text(mesh));
}

}  // namespace

physics::FixedComponents parse_supports(std::span<const std::string> specs, const TetraMesh& mesh,
                                        geometry::Numbering numbering) {
  physics::FixedComponents fixed(mesh.positions.size(), 0);
  for (const std::string& joined : specs)
    for (const std::string& spec : split_joined(joined))
      add_supports(split_components(spec), {mesh, numbering}, fixed);
  return fixed;
}

}  // namespace omentum::organ
