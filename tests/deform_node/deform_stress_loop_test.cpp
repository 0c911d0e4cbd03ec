// OrganStress of the whole loop, while somebody reads it.
#include "tests/deform_node/deform_stage.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace omentum::deform_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A reader of its own participant, gone with it.
class StressReader {
 public:
  explicit StressReader(test::FakeBus& bus)
      : bus_(bus.opener()()),
        reader_(bus_->reader<msg::OrganStress>([this](const msg::OrganStress& s) { heard.push_back(s); })) {}
  std::vector<msg::OrganStress> heard;

 private:
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Reader<msg::OrganStress>> reader_;
};

TEST_F(DeformLoopTest, StressIsToldWhileSomebodyReadsIt) {
  const auto node = serving();
  node->pass(1);
  EXPECT_THAT(bus_.take_all<msg::OrganStress>(), IsEmpty());
  std::uint64_t told = 0;
  for (int join = 0; join < 2; ++join) {  // the second one joins late
    {
      StressReader reader(bus_);
      bus_.post(push(organ(), static_cast<std::uint64_t>(1 + join)));
      node->tick(20);
      const msg::OrganState state = next_state(*node);
      ASSERT_FALSE(reader.heard.empty());
      const msg::OrganStress& newest = reader.heard.back();
      EXPECT_EQ(newest.seq, state.seq);
      EXPECT_EQ(newest.stamp_ns, state.stamp_ns);
      EXPECT_EQ(newest.topology_version, state.topology_version);
      EXPECT_EQ(newest.node_count, state.node_count);
      EXPECT_GT(*std::ranges::max_element(newest.strains), 0.001F);
      EXPECT_THAT(newest.stresses, IsEmpty()) << "nobody knows the inside of a precomputed organ";
      told += reader.heard.size();
    }
    node->tick(20);
    bus_.take_all<msg::OrganStress>();
    node->tick(20);
    EXPECT_THAT(bus_.take_all<msg::OrganStress>(), IsEmpty());
  }
  EXPECT_EQ(node->end(), "");
  const std::uint64_t measured = node->loop().report()["stress_states"];
  EXPECT_GE(measured, told);
  EXPECT_LE(measured, told + 4) << "what was measured when a reader had just left";
}

}  // namespace
}  // namespace omentum::deform_test
