// What names.h does, for what only a participant's settings need.
#pragma once

#include "transport/fast/names.h"

#ifdef OMENTUM_FAST_DDS_3
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/rtps/attributes/WriterAttributes.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/attributes/WriterAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

namespace omentum::transport::fast {

using eprosima::fastdds::rtps::UDPv4TransportDescriptor;

/// Of all participants that are made later in this process.
inline void turn_off_delivery_inside_the_process() {
#ifdef OMENTUM_FAST_DDS_3
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  dds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#else
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#endif
}

inline void set_heartbeat_period(rtps::WriterTimes& times, const Duration_t& period) {
#ifdef OMENTUM_FAST_DDS_3
  times.heartbeat_period = period;
#else
  times.heartbeatPeriod = period;
#endif
}

}  // namespace omentum::transport::fast
