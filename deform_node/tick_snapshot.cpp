#include "deform_node/tick_snapshot.h"

#include "geometry/precondition.h"

#include <algorithm>

namespace omentum::deform {

namespace {

// `bits` are none where the view has none.
void take_bits(std::span<const std::uint8_t> from, std::vector<std::uint8_t>& bits) {
  const std::size_t count = std::min(from.size(), bits.size());
  std::fill(std::copy_n(from.begin(), count, bits.begin()), bits.end(), std::uint8_t{0});
}

}  // namespace

void OrganSnapshot::take(const OrganView& view) noexcept {
  geometry::require(view.values.size() <= values.size() && view.removed_bits.size() <= removed_bits.size(),
                    "a view no larger than the model said");
  kind = view.kind;
  value_count = std::min(view.values.size(), values.size());
  std::copy_n(view.values.begin(), value_count, values.begin());
  if (topology_version == view.topology_version) return;  // this slot has them from an earlier tick
  topology_version = view.topology_version;
  take_bits(view.removed_bits, removed_bits);
  take_bits(view.burnt_bits, burnt_bits);
}

void Echoes::take(std::span<const msg::Echo> newest) noexcept {
  count = std::min(newest.size(), of_tools.size());
  std::copy_n(newest.begin(), count, of_tools.begin());
}

}  // namespace omentum::deform
