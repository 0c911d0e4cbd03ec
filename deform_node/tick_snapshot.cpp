#include "deform_node/tick_snapshot.h"

#include "geometry/precondition.h"

#include <algorithm>

namespace omentum::deform {

void OrganSnapshot::take(const OrganView& view) noexcept {
  geometry::require(view.values.size() <= values.size() && view.removed_bits.size() <= removed_bits.size(),
                    "a view no larger than the model said");
  kind = view.kind;
  value_count = std::min(view.values.size(), values.size());
  std::copy_n(view.values.begin(), value_count, values.begin());
  if (topology_version == view.topology_version) return;  // this slot has them from an earlier tick
  topology_version = view.topology_version;
  std::fill(removed_bits.begin(), removed_bits.end(), std::uint8_t{0});
  std::copy_n(view.removed_bits.begin(), std::min(view.removed_bits.size(), removed_bits.size()),
              removed_bits.begin());
}

void Echoes::take(std::span<const msg::Echo> newest) noexcept {
  count = std::min(newest.size(), of_tools.size());
  std::copy_n(newest.begin(), count, of_tools.begin());
}

}  // namespace omentum::deform
