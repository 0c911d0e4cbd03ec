#include "organ/support_spec.h"

#include "organ/csv.h"
#include "organ/node_column.h"
#include "organ/plausibility.h"

#include <functional>
#include <optional>

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::TetraMesh;
using geometry::Vec3;

[[noreturn]] void refuse(const std::string& spec, const std::string& what) {
  throw InputError("--fixed " + spec + ": " + what);
}

struct Spec {
  std::string whole;
  std::string place;  // without the components
  std::uint8_t components = physics::kPinned;
};

// "box:...+plane:..." in its parts; a plus in a number or in a file's name is none between parts.
std::vector<std::string> split_joined(const std::string& joined) {
  std::vector<std::string> parts{joined};
  for (std::size_t at = joined.size(); at-- > 0;) {
    if (joined.compare(at, 5, "+box:") != 0 && joined.compare(at, 7, "+plane:") != 0) continue;
    parts.push_back(parts.front().substr(at + 1));
    parts.front().resize(at);
  }
  return parts;
}

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

bool starts_with(const std::string& text, const char* head) {
  return text.rfind(head, 0) == 0;
}

using Match = std::function<bool(const Vec3&)>;

Match plane_match(const Spec& spec) {
  const std::string body = spec.place.substr(std::string("plane:").size());
  const auto limit = body.size() > 2 ? parse_number(body.substr(2)) : std::nullopt;
  if (!limit || body[0] < 'x' || body[0] > 'z' || (body[1] != '<' && body[1] != '>')) {
    refuse(spec.whole, "not a plane; expected one such as plane:x<0.03 (x, y or z; < or >; metres)");
  }
  const int axis = body[0] - 'x';
  if (body[1] == '<') return [axis, limit](const Vec3& p) { return p[axis] < *limit; };
  return [axis, limit](const Vec3& p) { return p[axis] > *limit; };
}

Match box_match(const Spec& spec) {
  const auto corners = parse_numbers(spec.place.substr(std::string("box:").size()));
  if (!corners || corners->size() != 6) {
    refuse(spec.whole, "not a box; expected box:x0,y0,z0,x1,y1,z1 (metres)");
  }
  const Vec3 a((*corners)[0], (*corners)[1], (*corners)[2]), b((*corners)[3], (*corners)[4], (*corners)[5]);
  const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  return [low, high](const Vec3& p) {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  };
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
  std::vector<bool> listed;
  Match matches;
  if (starts_with(spec.place, "plane:")) {
    matches = plane_match(spec);
  } else if (starts_with(spec.place, "box:")) {
    matches = box_match(spec);
  } else {
    listed = listed_nodes(spec, supported);
  }
  std::int32_t held = 0;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (!(matches ? matches(mesh.positions[n]) : listed[mesh.file_node[n]])) continue;
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
