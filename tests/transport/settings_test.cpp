#include "transport/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::transport {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReceiveBufferWarning, SaysWhatToSetWhereTheKernelAllowsTooLittle) {
  const std::string warning = receive_buffer_warning(212992);
  EXPECT_THAT(warning, HasSubstr("212992"));
  EXPECT_THAT(warning, HasSubstr("net.core.rmem_max=4194304"));
}

TEST(ReceiveBufferWarning, IsSilentWhereItSufficesOrIsUnknown) {
  EXPECT_THAT(receive_buffer_warning(kSocketBufferBytes), IsEmpty());
  EXPECT_THAT(receive_buffer_warning(-1), IsEmpty());
}

TEST(Peers, AreAddressesSeparatedByCommas) {
  EXPECT_THAT(parse_peers("10.0.0.2,10.0.0.3"), testing::ElementsAre("10.0.0.2", "10.0.0.3"));
  EXPECT_THAT(parse_peers(""), IsEmpty());
}

TEST(Peers, ARefusedWordIsNamed) {
  try {
    parse_peers("10.0.0.2,haptic-pc");
    FAIL() << "a host name was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("haptic-pc"));
  }
}

}  // namespace
}  // namespace omentum::transport
