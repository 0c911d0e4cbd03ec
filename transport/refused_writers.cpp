#include "transport/refused_writers.h"

#include "transport/complaints.h"

#include <exception>

namespace omentum::transport {
namespace {

std::string least(const TopicSpec& requested, QosPolicy policy) {
  switch (policy) {
    case QosPolicy::kLiveliness:
      return "automatic, a lease of at most " + std::to_string(requested.liveliness_lease.count()) + " ms";
    case QosPolicy::kReliability:
      return requested.reliability == Reliability::kReliable ? "reliable" : "best effort";
    case QosPolicy::kDurability:
      return requested.durability == Durability::kTransientLocal ? "transient local" : "volatile";
    case QosPolicy::kDataRepresentation:
      return "XCDR1 (plain CDR)";
    default:
      return "DDS' default";
  }
}

}  // namespace

std::string what_to_offer(const TopicSpec& requested, QosPolicy policy) {
  return std::string(name_of(policy)) + " must be " + least(requested, policy);
}

void tell_refused_writer(const TopicSpec& requested, QosPolicy policy) noexcept {
  try {
    const std::string topic = requested.name;
    tell_once(topic, topic + " refuses by " + name_of(policy),
              "a writer is not heard, " + what_to_offer(requested, policy) +
                  " (docs/devices.md, Quality of service)");
  } catch (const std::exception&) {
    // no memory for a line
  }
}

}  // namespace omentum::transport
