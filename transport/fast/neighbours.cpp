#include "transport/fast/neighbours.h"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>

#include <algorithm>
#include <string>

namespace omentum::transport::fast {

namespace {

using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
using eprosima::fastrtps::rtps::ParticipantProxyData;

bool is_shared_memory(const Locator_t& locator) {
  return locator.kind == LOCATOR_KIND_SHM;
}

// A neighbour of ours marks himself. Of another one only his ports are known, and whether somebody is there:
// their numbers are not his alone, since each /dev/shm counts its own.
bool is_reached(const SharedMemory& memory, const ParticipantProxyData& neighbour) {
  const auto& ports = neighbour.default_locators.unicast;
  if (std::none_of(ports.begin(), ports.end(), is_shared_memory)) return true;
  const std::string mark(neighbour.m_userData.begin(), neighbour.m_userData.end());
  if (mark.starts_with(SharedMemory::kMark)) return mark == memory.mark();
  return std::all_of(ports.begin(), ports.end(), [&](const Locator_t& port) {
    return !is_shared_memory(port) || memory.reaches(port.port);
  });
}

}  // namespace

void Neighbours::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                          ParticipantDiscoveryInfo&& info) {
  const bool appeared = info.status == ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT;
  const bool changed = info.status == ParticipantDiscoveryInfo::CHANGED_QOS_PARTICIPANT;
  const std::lock_guard lock(mutex_);
  if (appeared && !is_reached(memory_, info.info)) strangers_.try_emplace(info.info.m_guid, false);
  if (!appeared && !changed) strangers_.erase(info.info.m_guid);
}

bool Neighbours::out_of_reach() {
  const std::lock_guard lock(mutex_);
  const bool found =
      std::any_of(strangers_.begin(), strangers_.end(), [](const auto& stranger) { return stranger.second; });
  for (auto& [guid, looked_at] : strangers_) looked_at = true;
  return found;
}

}  // namespace omentum::transport::fast
