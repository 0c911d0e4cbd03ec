// How topics.h reads in Fast DDS' terms.
#include "transport/fast/entities.h"

#include "transport/fast/cdr.h"

#include <gtest/gtest.h>

namespace omentum::transport::fast {
namespace {

template <class M>
dds::PublishModeQosPolicyKind publish_mode(Profile profile) {
  return writer_qos(kTopicSpec<M>, profile, kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes)
      .publish_mode()
      .kind;
}

TEST(FastWriterQos, WhoWritesWhatIsNotRepeatedSendsIt) {
  for (const Profile profile : {Profile::kLoopback, Profile::kLan}) {
#define OMENTUM_EXPECT_SENT(M)                                                                          \
  if (kTopicSpec<msg::M>.reliability == Reliability::kBestEffort) {                                     \
    EXPECT_EQ(publish_mode<msg::M>(profile), dds::SYNCHRONOUS_PUBLISH_MODE) << kTopicSpec<msg::M>.name; \
  }
    OMENTUM_FOR_EACH_TOPIC(OMENTUM_EXPECT_SENT)
#undef OMENTUM_EXPECT_SENT
  }
}

TEST(FastWriterQos, WhatIsRepeatedAndFitsNoMessageIsLeftToFastDds) {
  EXPECT_EQ(publish_mode<msg::Topology>(Profile::kLoopback), dds::ASYNCHRONOUS_PUBLISH_MODE);
  EXPECT_EQ(publish_mode<msg::SessionCommand>(Profile::kLoopback), dds::SYNCHRONOUS_PUBLISH_MODE);
}

}  // namespace
}  // namespace omentum::transport::fast
