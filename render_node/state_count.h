// How many states of the organs came, by their numbers.
#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

namespace omentum::render {

/// As StateAssembly shows them.
struct StateCounts {
  std::uint64_t whole = 0;
  std::uint64_t incomplete = 0;  // some of their blocks did not come
  std::uint64_t missing = 0;     // none did: numbers between the first state and the newest

  StateCounts& operator+=(const StateCounts& other);
};

nlohmann::json to_json(const StateCounts& counts);

/// One organ's, from the first state on. One thread.
class StateCount {
 public:
  /// A state, in the order of their numbers; a smaller one is that of a deform_node that counts anew.
  void shown(std::uint64_t seq, std::uint32_t missing_blocks) noexcept;
  const StateCounts& counts() const noexcept { return counts_; }

 private:
  StateCounts counts_;
  std::uint64_t newest_ = 0;  // 0: none came
};

}  // namespace omentum::render
