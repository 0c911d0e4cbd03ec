// The policies of DDS' quality of service by which a writer and a reader may not fit together.
#pragma once

#include <array>
#include <cstdint>

namespace omentum::transport {

/// A writer must offer at least what a reader requests of each (DDS 1.4, 2.2.3). The order of both vendors'
/// numbers, which are the same up to 22.
enum class QosPolicy : std::uint8_t {
  kOther,
  kDurability,
  kPresentation,
  kDeadline,
  kLatencyBudget,
  kOwnership,
  kLiveliness,
  kReliability,
  kDestinationOrder,
  kDataRepresentation,
};

/// As DDS writes it, e.g. "LIVELINESS".
constexpr const char* name_of(QosPolicy policy) noexcept {
  constexpr std::array kNames{"another policy",    "DURABILITY",         "PRESENTATION", "DEADLINE",
                              "LATENCY_BUDGET",    "OWNERSHIP",          "LIVELINESS",   "RELIABILITY",
                              "DESTINATION_ORDER", "DATA_REPRESENTATION"};
  return kNames[static_cast<std::size_t>(policy)];
}

/// By its number in a vendor's status of incompatible quality of service. `data_representation`: that
/// vendor's number of it; the others differ nowhere.
constexpr QosPolicy policy_of(std::uint32_t number, std::uint32_t data_representation) noexcept {
  switch (number) {
    case 2:
      return QosPolicy::kDurability;
    case 3:
      return QosPolicy::kPresentation;
    case 4:
      return QosPolicy::kDeadline;
    case 5:
      return QosPolicy::kLatencyBudget;
    case 6:
      return QosPolicy::kOwnership;
    case 8:
      return QosPolicy::kLiveliness;
    case 11:
      return QosPolicy::kReliability;
    case 12:
      return QosPolicy::kDestinationOrder;
    default:
      return number == data_representation ? QosPolicy::kDataRepresentation : QosPolicy::kOther;
  }
}

}  // namespace omentum::transport
