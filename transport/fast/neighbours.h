// Who else is in the domain, and whether shared memory reaches him.
#pragma once

#include "transport/fast/shared_memory.h"

#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <map>
#include <mutex>

namespace omentum::transport::fast {

/// Finds participants that announce a port of shared memory at which we do not reach them: another user's, or
/// those of a container with a /dev/shm of its own. Fast DDS matches them and sends to nobody. Any thread.
class Neighbours final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// Whether there was such a neighbour at the last look too, and is still there: who only leaves at this
  /// moment, or was killed, is none. To be asked from time to time.
  bool out_of_reach();

 private:
  using Guid = eprosima::fastrtps::rtps::GUID_t;

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;

  SharedMemory memory_;
  std::mutex mutex_;
  std::map<Guid, bool> strangers_;  // true: seen at an earlier look
};

}  // namespace omentum::transport::fast
