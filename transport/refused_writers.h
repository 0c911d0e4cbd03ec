// Writers that offer less than a reader requests, whose samples DDS therefore hands to nobody.
#pragma once

#include "transport/topics.h"

#include <string>

namespace omentum::transport {

/// What a reader with these requests needs of a writer: "LIVELINESS must be automatic, a lease of at most 100
/// ms".
std::string what_to_offer(const TopicSpec& requested, QosPolicy policy);

/// A line on stderr, once in a process for each topic and policy: which topic, which policy, what to offer.
/// The status of both vendors does not say whose writer it is. Any thread; short lock.
void tell_refused_writer(const TopicSpec& requested, QosPolicy policy) noexcept;

}  // namespace omentum::transport
