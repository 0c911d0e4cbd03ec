#include "organ/place_spec.h"

#include "geometry/boxes.h"
#include "geometry/tetra_mesh.h"
#include "organ/csv.h"

namespace omentum::organ {

namespace {

using geometry::Vec3;

constexpr std::string_view kPlane = "plane:", kBox = "box:";

Place plane_of(const std::string& body, const std::string& who) {
  const auto limit = body.size() > 2 ? parse_number(body.substr(2)) : std::nullopt;
  if (!limit || body[0] < 'x' || body[0] > 'z' || (body[1] != '<' && body[1] != '>')) {
    throw geometry::InputError(
        who + ": not a plane; expected one such as plane:x<0.03 (x, y or z; < or >; metres)");
  }
  const int axis = body[0] - 'x';
  if (body[1] == '<') return [axis, limit](const Vec3& p) { return p[axis] < *limit; };
  return [axis, limit](const Vec3& p) { return p[axis] > *limit; };
}

Place box_of(const std::string& body, const std::string& who) {
  const auto corners = parse_numbers(body);
  if (!corners || corners->size() != 6)
    throw geometry::InputError(who + ": not a box; expected box:x0,y0,z0,x1,y1,z1 (metres)");
  const Vec3 a(corners->data()), b(corners->data() + 3);
  return [a, b](const Vec3& p) { return geometry::in_box(p, a, b); };
}

}  // namespace

std::vector<std::string> split_joined(const std::string& joined) {
  std::vector<std::string> parts{joined};
  for (std::size_t at = joined.size(); at-- > 0;) {
    if (joined.compare(at, 5, "+box:") != 0 && joined.compare(at, 7, "+plane:") != 0) continue;
    parts.push_back(parts.front().substr(at + 1));
    parts.front().resize(at);
  }
  return parts;
}

Place place_of(const std::string& place, const std::string& option, const std::string& whole) {
  const std::string who = option + " " + whole;
  if (place.starts_with(kPlane)) return plane_of(place.substr(kPlane.size()), who);
  if (place.starts_with(kBox)) return box_of(place.substr(kBox.size()), who);
  return {};
}

}  // namespace omentum::organ
