#include "render_node/state_count.h"

#include <nlohmann/json.hpp>

namespace omentum::render {

StateCounts& StateCounts::operator+=(const StateCounts& other) {
  whole += other.whole;
  incomplete += other.incomplete;
  missing += other.missing;
  return *this;
}

nlohmann::json to_json(const StateCounts& counts) {
  return {{"whole", counts.whole}, {"incomplete", counts.incomplete}, {"missing", counts.missing}};
}

void StateCount::shown(std::uint64_t seq, std::uint32_t missing_blocks) noexcept {
  if (newest_ > 0 && seq > newest_) counts_.missing += seq - newest_ - 1;
  newest_ = seq;
  ++(missing_blocks > 0 ? counts_.incomplete : counts_.whole);
}

}  // namespace omentum::render
