// Whose pose an answer is for.
#pragma once

#include "transport/bus.h"

#include <array>
#include <cstdint>
#include <optional>

namespace omentum::node {

/// Keeps the newest poses of a tool, by who sent them: an answer names a pose by number and stamp, and not
/// its device. One thread at a time; allocates nothing.
class AnsweredPoses {
 public:
  /// Devices that are told apart; of more, those that were heard last.
  static constexpr std::size_t kMost = 8;
  /// Of each, so many: at 1 kHz an answer may come an eighth of a second after its pose.
  static constexpr std::size_t kPoses = 128;

  void heard(const transport::ParticipantId& who, std::uint64_t seq, std::int64_t stamp_ns) noexcept;
  /// Who sent that pose, if it is one of the newest.
  std::optional<transport::ParticipantId> sender_of(const msg::Echo& answered) const noexcept;

 private:
  struct Sent {
    bool was = false;
    std::uint64_t seq = 0;
    std::int64_t stamp_ns = 0;
  };
  struct Device {
    transport::ParticipantId who{};
    std::uint64_t heard = 0;        // when, counted in poses; 0: nobody
    std::array<Sent, kPoses> sent;  // a number has its place
  };

  std::array<Device, kMost> devices_;
  std::uint64_t poses_ = 0;
};

}  // namespace omentum::node
