// A network's samples as haptic_node and deform_node live through them, while an honest hand presses:
// whatever strangers say, no force is above its limit, none jumps, and none is left once the hand falls
// silent.
//
// The first byte chooses the organ's model; then come records: a byte, of a topic (of one of several writers)
// or of ticks that pass; behind a topic's two bytes of length and a sample as CDR.
#include "deform_node/deform_loop.h"
#include "haptic_node/haptic_loop.h"

#include "tests/fuzz/harness.h"
#include "tests/fuzz/topic_choice.h"
#include "tests/haptic_node/haptic_block.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <memory>
#include <optional>

namespace omentum::fuzz {

namespace {

using geometry::Vec3;
using haptic_test::vector;

constexpr double kHand_hz = 1000, kOrgan_hz = 100;
constexpr int kOrganEvery = static_cast<int>(kHand_hz / kOrgan_hz);
constexpr double kListens_s = 1.02;              // until both nodes serve
constexpr int kPressTicks = 60;                  // of the honest hand, before the first stranger
constexpr int kSilentTicks = 60;                 // stale, decayed, and some more
constexpr std::uint8_t kFirstPause = 200;        // this byte lets one tick pass, the next one two ...
constexpr double kMax_n = 10, kSlew_n_s = 2000;  // the scene's, by default
constexpr double kTolerance = 1 + 1e-9;
constexpr transport::WriterId kHonest{0x11};

const test::BlockScene& block() {
  static const test::BlockScene scene = haptic_test::block_scene();
  return scene;
}
const std::string& scene_file(bool moves) {
  static const std::string still = block().scene();
  static const std::string moving = block().scene_with("mesh = ", "model = \"tensor-mass\"\nmesh = ");
  return moves ? moving : still;
}
haptic::HapticOptions haptic_options(bool moves) {
  haptic::HapticOptions options;
  options.node.scene = scene_file(moves);
  return options;
}
deform::DeformOptions deform_options(bool moves) {
  deform::DeformOptions options;
  options.node.scene = scene_file(moves);
  return options;
}

// Hears every topic, so that a sample of any has somebody to go to, and judges the forces.
class Witness {
 public:
  explicit Witness(const transport::OpenBus& open) : bus_(open()) {
    msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M>) {
      auto reader = bus_->reader<M>([this](const M& sample) {
        if constexpr (std::is_same_v<M, msg::ToolForce>) hear(sample);
      });
      readers_.push_back(std::make_shared<decltype(reader)>(std::move(reader)));
    });
  }

  /// Forces that strangers write are their own affair.
  void look_away(bool away) { away_ = away; }
  void require_silent_hands() const {
    for (const Vec3& force : newest_)
      if (force.norm() > 0) broken("a force is left though the hand is silent");
  }

 private:
  void hear(const msg::ToolForce& sample) {
    if (away_ || sample.tool >= newest_.size()) return;
    const Vec3 force = vector(sample.force);
    if (!force.allFinite() || !vector(sample.torque).allFinite() || !std::isfinite(sample.grip_torque))
      broken("a force is not finite");
    if (force.norm() > kMax_n * kTolerance) broken("a force is above its limit");
    if ((force - newest_[sample.tool]).norm() > kSlew_n_s / kHand_hz * kTolerance) broken("a force jumps");
    newest_[sample.tool] = force;
  }

  std::unique_ptr<transport::Bus> bus_;
  std::vector<std::shared_ptr<void>> readers_;
  std::array<Vec3, msg::MAX_TOOLS> newest_ = [] {
    std::array<Vec3, msg::MAX_TOOLS> none;
    none.fill(Vec3::Zero());
    return none;
  }();
  bool away_ = false;
};

class Session {
 public:
  explicit Session(bool moves)
      : witness_(bus_.opener()),
        hand_(kHand_hz, haptic_options(moves), bus_.opener()),
        organ_(kOrgan_hz, deform_options(moves), bus_.opener()) {
    for (double left_s = kListens_s; left_s > 0; left_s -= 1 / kHand_hz) tick();
    for (int i = 0; i < kPressTicks; ++i) press();
  }
  ~Session() {
    for (int i = 0; i < kSilentTicks; ++i) tick();
    if (lives_) witness_.require_silent_hands();
  }

  /// One millisecond in which the honest hand presses on.
  void press() {
    ++seq_;
    const double share = std::min(1.0, static_cast<double>(seq_) / kPressTicks);
    const Vec3 tip = haptic_test::kAbove + share * (haptic_test::kPressed - haptic_test::kAbove);
    msg::ToolPose pose{};
    pose.seq = seq_;
    pose.stamp_ns = hand_.pace().now_ns();
    pose.valid = true;
    pose.position = {tip.x(), tip.y(), tip.z()};
    pose.orientation.w = 1;
    bus_.post(pose, kHonest);
    tick();
  }

  template <class M>
  void say(const M& sample, std::uint8_t writer) {
    witness_.look_away(true);
    bus_.post(sample, transport::WriterId{writer});
    witness_.look_away(false);
  }

 private:
  void tick() {
    lives_ = hand_.tick() && lives_;  // a node may leave the domain to somebody: that is an answer
    if (++ticks_ % kOrganEvery == 0) organ_.tick();
    msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M>) { bus_.take_all<M>(); });
  }

  test::FakeBus bus_;
  Witness witness_;
  test::StagedLoop<haptic::HapticLoop> hand_;
  test::StagedLoop<deform::DeformLoop> organ_;
  std::uint64_t seq_ = 0, ticks_ = 0;
  bool lives_ = true;
};

// What is left of the input, piece by piece.
class Records {
 public:
  explicit Records(std::span<const std::uint8_t> input) : left_(input) {}

  std::optional<std::uint8_t> byte() {
    if (left_.empty()) return std::nullopt;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  std::vector<char> sample() {
    const std::size_t low = byte().value_or(0), high = byte().value_or(0);
    const std::size_t length = std::min(low + 256 * high, left_.size());
    std::vector<char> bytes(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(length));
    left_ = left_.subspan(length);
    return bytes;
  }

 private:
  std::span<const std::uint8_t> left_;
};

void live_through(Records& records, Session& session) {
  while (const auto kind = records.byte()) {
    if (*kind >= kFirstPause) {
      for (int i = kFirstPause; i <= *kind; ++i) session.press();
      continue;
    }
    std::vector<char> bytes = records.sample();
    with_topic(*kind, [&]<class M>(msg::MessageTag<M>) {
      M sample;
      if (transport::fast::decode(bytes.data(), bytes.size(), false, sample))
        session.say(sample, static_cast<std::uint8_t>(*kind / kTopics));
    });
  }
}

}  // namespace

void try_input(std::span<const std::uint8_t> input) {
  if (input.empty()) return;
  Records records(input.subspan(1));
  Session session((input[0] & 1U) != 0);
  live_through(records, session);
}

std::vector<std::string> seeds() {
  std::vector<std::string> samples = encoded_topics([](char topic) { return std::string{topic}; });
  std::vector<std::string> inputs;
  for (const char model : {0, 1}) {
    std::string all(1, model);
    for (const std::string& sample : samples) {
      const std::size_t length = sample.size() - 1;
      all += sample.front();
      all += static_cast<char>(length % 256);
      all += static_cast<char>(length / 256);
      all += sample.substr(1) + static_cast<char>(kFirstPause + 3);
    }
    inputs.push_back(all);
  }
  return inputs;
}

}  // namespace omentum::fuzz
