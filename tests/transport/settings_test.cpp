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

TEST(Interfaces, AreChosenByNameOrAddressAndOthersRefusedWithWhatThereIs) {
  const std::vector<Interface> present{{"lo", "127.0.0.1"}, {"lan0", "10.77.0.1"}};
  EXPECT_EQ(choose_interface("lan0", present).value().address, "10.77.0.1");
  EXPECT_EQ(choose_interface("10.77.0.1", present).value().name, "lan0");
  EXPECT_FALSE(choose_interface("", present));
  try {
    choose_interface("wlan0", present);
    FAIL() << "an interface that is not there was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("wlan0"));
    EXPECT_THAT(error.what(), HasSubstr("lo 127.0.0.1, lan0 10.77.0.1"));
  }
}

TEST(Interfaces, OfThisMachineIncludeTheLoopback) {
  EXPECT_TRUE(choose_interface("127.0.0.1", interfaces_of_this_machine()));
}

}  // namespace
}  // namespace omentum::transport
