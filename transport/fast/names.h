// Fast DDS from 2.9 to 3.x under one set of names. With domain_names.h and plain_type.h all that knows of its
// versions; of Fast CDR's, cdr_names.h does.
#pragma once

#if __has_include(<fastdds/LibrarySettings.hpp>)
#define OMENTUM_FAST_DDS_3  // what was fastrtps in headers and namespaces is fastdds
#include <fastdds/dds/core/ReturnCode.hpp>
#include <fastdds/dds/core/Time_t.hpp>
#include <fastdds/dds/core/status/LivelinessChangedStatus.hpp>
#include <fastdds/rtps/attributes/ResourceManagement.hpp>
#else
#include <fastdds/rtps/resources/ResourceManagement.h>
#include <fastrtps/qos/LivelinessChangedStatus.h>
#include <fastrtps/rtps/common/Time_t.h>
#include <fastrtps/types/TypesBase.h>
#endif
#include <fastdds/dds/common/InstanceHandle.hpp>

namespace omentum::transport::fast {

namespace dds = eprosima::fastdds::dds;

#ifdef OMENTUM_FAST_DDS_3

namespace rtps = eprosima::fastdds::rtps;
using dds::Duration_t;
using dds::LivelinessChangedStatus;
using dds::ReturnCode_t;
inline constexpr ReturnCode_t kOk = dds::RETCODE_OK;
/// Whether DataWriter::write() took the sample.
inline bool written(ReturnCode_t code) {
  return code == kOk;
}

#else

namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::LivelinessChangedStatus;
using eprosima::fastrtps::types::ReturnCode_t;
inline constexpr auto kOk = ReturnCode_t::RETCODE_OK;
/// Whether DataWriter::write() took the sample.
inline bool written(bool taken) {
  return taken;
}

#endif

}  // namespace omentum::transport::fast
