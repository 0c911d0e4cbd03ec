// What was removed of an organ in the versions that its states may belong to.
#pragma once

#include "transport/messages.h"

#include <array>
#include <cstdint>
#include <vector>

namespace omentum::render {

/// The tetrahedra that an organ lacks. Bit t % 8 of byte t / 8 is tetrahedron t; missing bytes are zero.
struct RemovedSet {
  std::vector<std::uint8_t> bits;
  std::vector<std::uint8_t> burnt;  // those of them that a hot edge took

  bool whole() const;
  friend bool operator==(const RemovedSet&, const RemovedSet&) = default;
};

/// The two topologies of one organ that came last. Not only the highest version: a deform_node that starts
/// without having heard of another one counts from 0 again, and what is drawn belongs to its states, not to
/// the order of versions. Before any came, version 0 is the whole organ. One thread.
class KnownTopologies {
 public:
  /// `tetrahedron_count`: of the uncut organ; 0: it is never cut.
  explicit KnownTopologies(std::size_t tetrahedron_count) : tetrahedron_count_(tetrahedron_count) {}

  /// False: of another organ (count of tetrahedra, bits beyond them, burnt ones that are there): nothing was
  /// changed.
  [[nodiscard]] bool take(const msg::Topology& topology);
  /// Null where no such version is known. Valid until the next take().
  const RemovedSet* removed_in(std::uint64_t version) const;
  /// Of those that are known.
  std::uint64_t highest() const;

 private:
  struct Known {
    std::uint64_t version = 0;
    RemovedSet removed;
  };
  bool fits(const std::vector<std::uint8_t>& bits) const;

  std::size_t tetrahedron_count_;
  std::array<Known, 2> known_;  // the newest first
};

}  // namespace omentum::render
