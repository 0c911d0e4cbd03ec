// A toy organ in the whole loop: what it offers comes out at the other end of a wire.
#include "deform_node/deform_loop.h"

#include "tests/nodes/deform_block.h"
#include "tests/nodes/deform_toy.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <mutex>
#include <optional>
#include <thread>

namespace omentum::deform {
namespace {

using deform_test::HangingMass;

constexpr double kRate_hz = 200;

class ToyInTheLoop : public ::testing::Test {
 protected:
  ToyInTheLoop() {
    options_.node.scene = block_.scene();
    options_.node.dds = "cyclone";
    options_.node.domain = domain_;
    options_.models = kModels;
    loop_ = std::make_unique<DeformLoop>(options_, pace_);
    thread_ = std::thread([this] { loop_->run(); });
  }
  ~ToyInTheLoop() override { end(); }
  void end() {
    pace_.stop();
    if (thread_.joinable()) thread_.join();
  }

  template <class M>
  struct Newest {
    explicit Newest(transport::Bus& bus)
        : reader(bus.reader<M>([this](const M& sample) {
            const std::lock_guard lock(mutex);
            value = sample;
          })) {}
    std::optional<M> get() {
      const std::lock_guard lock(mutex);
      return value;
    }
    std::mutex mutex;
    std::optional<M> value;
    std::unique_ptr<transport::Reader<M>> reader;
  };

  // where the scene says "quasi-static"
  static constexpr std::array kModels{
      ModelEntry{"quasi-static", organ::Load::kMeshOnly, deform_test::make_hanging_mass}};
  const deform_test::BlockScene block_;
  const int domain_ = test::domain_of_test();
  DeformOptions options_;
  runtime::RateLoop pace_{kRate_hz};
  std::unique_ptr<DeformLoop> loop_;
  std::thread thread_;
  std::unique_ptr<transport::Bus> bus_ =
      transport::Bus::open({.vendor = transport::Vendor::kCyclone, .domain = domain_, .name = "test"});
};

TEST_F(ToyInTheLoop, ItsStatesItsTopologyAndItsLocalModelsComeToWhoHearsThem) {
  Newest<msg::OrganState> states(*bus_);
  Newest<msg::Topology> topologies(*bus_);
  Newest<msg::LocalModel> models(*bus_);
  const auto poses = bus_->writer<msg::ToolPose>();
  const organ::Organ organ = block_.organ();
  const Vec3 rest = organ.mesh.positions[organ.surface.node.front()];
  msg::ToolPose pose{};
  pose.valid = true;
  pose.position = {rest.x(), rest.y(), rest.z()};
  EXPECT_TRUE(test::comes_true([&] {
    ++pose.seq;
    poses->write(pose);
    return states.get() && topologies.get() && models.get();
  }));
  EXPECT_EQ(states.get()->kind, msg::KIND_TUBE);
  EXPECT_EQ(states.get()->node_count, 1u);
  EXPECT_EQ(topologies.get()->tetrahedron_count, organ.mesh.tetrahedra.size());
  EXPECT_EQ(models.get()->tool, 0u);
  EXPECT_EQ(models.get()->nodes.size(), 1u);
  end();
  EXPECT_GT(loop_->report()["steps"], 0);
}

}  // namespace
}  // namespace omentum::deform
