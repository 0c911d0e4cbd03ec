#include "physics/intestine/gut_chords.h"

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Of a gap that is less than that room: what is left of it, so that it can open again.
constexpr double kLeft = 0.1;

// Calls visit(mass, the parts' masses before and behind it, its share of the way between these).
template <class Visit>
void visit_between(const GutParts& parts, const Visit& visit) {
  const geometry::GutLayout& gut = parts.gut;
  for (MassId m(0); m < gut.mass_count(); m = MassId(m + 1)) {
    const std::int32_t row = gut.row(m), column = gut.column(m), since = column % parts.stride;
    if (since == 0) continue;
    const std::int32_t first = column - since, last = std::min(first + parts.stride, gut.columns - 1);
    visit(m, gut.mass(row, first), gut.mass(row, last), static_cast<double>(since) / (last - first));
  }
}

}  // namespace

void spread_gaps(const GutParts& parts, std::span<double> gap_m) noexcept {
  if (parts.stride == 1) return;
  const double room_m = kOffChord * parts.reach.tube_m;  // twice of the radius
  for (double& gap : gap_m) gap = std::max(gap - room_m, kLeft * gap);
  visit_between(parts, [&](MassId m, MassId before, MassId behind, double) {
    gap_m[m] = std::min({gap_m[m], gap_m[before], gap_m[behind]});
  });
}

void keep_near_chords(const GutParts& parts, double step_s, std::span<Vec3> x, std::span<Vec3> v,
                      std::span<std::uint8_t> held) noexcept {
  if (parts.stride == 1) return;
  const double most_m = kOffChord * parts.reach.tube_m / 2;
  visit_between(parts, [&](MassId m, MassId before, MassId behind, double share) {
    if (parts.gut.is_held(m)) return;
    const Vec3 chord = (1 - share) * x[before] + share * x[behind], off = x[m] - chord;
    const double off_m = off.norm();
    if (off_m <= most_m) return;
    const Vec3 back = (most_m / off_m - 1) * off;
    x[m] += back;
    v[m] += back / step_s;
    held[m] = 1;
  });
}

}  // namespace omentum::physics
