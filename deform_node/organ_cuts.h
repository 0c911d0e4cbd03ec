// What is removed of an organ, apart from the model that it was removed from.
#pragma once

#include <cstdint>
#include <vector>

namespace omentum::deform {

struct OrganCuts {
  std::uint64_t version = 0;  // OrganView.topology_version; 0: nothing was ever removed
  std::vector<std::uint8_t> removed_bits{}, burnt_bits{};  // as OrganView's; both empty: it is whole
};

}  // namespace omentum::deform
