// What Cyclone DDS writes to its log, told with measure.
#pragma once

#include <cstdint>
#include <string_view>

namespace omentum::transport::cyclone {

/// From now on each kind of message of Cyclone's log is told once on stderr in this process, and what
/// readers could not decode is counted: one bad writer would otherwise fill a disk. Any thread.
void tell_complaints_once();

/// How many samples of the topic Cyclone could not decode for this process' readers: over a bound of the IDL,
/// or no such message. Of all domains together: Cyclone 0.10 does not say which. 0 before
/// tell_complaints_once(). Any thread; short lock.
std::uint64_t undecodable(std::string_view topic);

}  // namespace omentum::transport::cyclone
