// Programs that hear the same devices come to agree whose a tool is, whatever each of them missed.
#include "node_common/following_holder.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace omentum::node {
namespace {

using transport::ParticipantId;

constexpr std::int64_t kStep_ns = 1'000'000, kHandOver_ns = 50'000'000;
constexpr std::size_t kDevices = 4;  // two that nobody asked for, and two of the wanted name

transport::WriterId writer_of(std::size_t device) {
  return {static_cast<std::uint8_t>(device + 1)};
}
bool is_wanted(std::size_t device) {
  return device >= 2;
}
msg::DeviceInfo info_of(std::size_t device) {
  msg::DeviceInfo info{};
  info.name = is_wanted(device) ? "omega" : "guest";
  return info;
}

/// What all programs have in common: their own ears.
struct Ears {
  DeviceRegister names{"omega"};
  std::array<std::int64_t, kDevices> deaf_until_ns{};
  std::int64_t still_until_ns = 0;

  bool hear(std::size_t device, std::int64_t now_ns) const {
    return now_ns >= deaf_until_ns[device] && now_ns >= still_until_ns;
  }
};

/// haptic_node, which serves the hands.
struct Server : Ears {
  ToolHolder holder{kHandOver_ns};
  std::map<std::size_t, std::int64_t> served_ns;  // the newest time of each

  bool serves(std::size_t device, std::int64_t now_ns) {
    const PoseRight right = holder.judge(transport::participant_of(writer_of(device)), now_ns, names.known());
    if (right != PoseRight::kHolds && right != PoseRight::kTakes) return false;
    holder.heard(now_ns);
    served_ns[device] = now_ns;
    return true;
  }
};

/// Another program.
struct Follower : Ears {
  FollowingHolder holder{kHandOver_ns};

  bool serves(std::size_t device, const msg::ToolPose& pose, std::int64_t now_ns) {
    const PoseRight right =
        holder.judge(transport::participant_of(writer_of(device)), pose, now_ns, names.known());
    if (right != PoseRight::kHolds && right != PoseRight::kTakes) return false;
    holder.heard(now_ns);
    return true;
  }
};

/// Devices of 1 kHz and three programs, on a wire that fails each of them at times.
class Domain {
 public:
  explicit Domain(unsigned seed) : random_(seed) {}

  /// Whether in that time every program served the same ones.
  bool go(int ms, bool fails) {
    bool agree = true;
    for (int i = 0; i < ms; ++i) {
      now_ns_ += kStep_ns;
      if (fails) fail();
      for (std::size_t device = 0; device < kDevices; ++device)
        if (sends_[device]) agree = pose(device) && agree;
    }
    return agree;
  }
  /// From now on everybody hears what there is.
  void mend() {
    for (Ears* ears : programs()) {
      ears->deaf_until_ns = {};
      ears->still_until_ns = 0;
      for (std::size_t device = 0; device < kDevices; ++device) tell(*ears, device);
    }
  }
  /// The shortest time between two hands at the server, ns.
  std::int64_t shortest_hand_over_ns() const { return shortest_ns_; }
  int hand_overs() const { return static_cast<int>(server_.holder.last().count); }

 private:
  std::vector<Ears*> programs() { return {&server_, &followers_[0], &followers_[1]}; }
  bool happens(double per_second) {
    return std::uniform_real_distribution(0.0, 1000.0)(random_) < per_second;
  }
  std::int64_t up_to_ms(int most) { return kStep_ns * std::uniform_int_distribution(1, most)(random_); }
  void tell(Ears& ears, std::size_t device) const {
    if (there_[device]) ears.names.hear(info_of(device), writer_of(device));
    if (!there_[device]) ears.names.gone(writer_of(device));
  }

  void fail() {
    for (std::size_t device = 0; device < kDevices; ++device) {
      if (happens(2)) sends_[device] = !sends_[device];
      if (happens(1)) there_[device] = !there_[device];
      for (Ears* ears : programs()) {
        if (happens(3)) ears->deaf_until_ns[device] = now_ns_ + up_to_ms(150);
        if (happens(20)) tell(*ears, device);
      }
    }
    for (Ears* ears : programs())
      if (happens(3)) ears->still_until_ns = now_ns_ + up_to_ms(150);
    if (happens(0.5)) start_server_anew();
    if (happens(0.5)) followers_[1].holder = FollowingHolder(kHandOver_ns);
  }
  void start_server_anew() {
    server_.holder = ToolHolder(kHandOver_ns);
    server_.served_ns.clear();  // that takes longer than any force lasts
  }
  // Whether all programs do the same with the device's next one.
  bool pose(std::size_t device) {
    msg::ToolPose pose{};
    pose.seq = ++seq_[device];
    pose.stamp_ns = now_ns_;
    const bool served = server_.hear(device, now_ns_) && server_.serves(device, now_ns_);
    if (served) note(device);
    bool agree = true;
    for (Follower& follower : followers_) {
      const bool heard = follower.hear(device, now_ns_);
      // the answer to the pose before came meanwhile
      if (heard) follower.holder.answered(answered_, now_ns_, follower.names.known());
      agree = agree && (heard && follower.serves(device, pose, now_ns_)) == served;
    }
    if (served) answered_ = {0, pose.seq, pose.stamp_ns};
    return agree;
  }
  void note(std::size_t device) {
    for (const auto& [other, at_ns] : server_.served_ns)
      if (other != device) shortest_ns_ = std::min(shortest_ns_, now_ns_ - at_ns);
  }

  std::mt19937 random_;
  std::int64_t now_ns_ = 0;
  std::array<bool, kDevices> sends_{}, there_{};
  std::array<std::uint64_t, kDevices> seq_{};
  msg::Echo answered_{};
  Server server_;
  std::array<Follower, 2> followers_;
  std::int64_t shortest_ns_ = std::numeric_limits<std::int64_t>::max();
};

TEST(FollowingHolder, ProgramsThatHearTheSameAgreeWithinABoundedTimeWhateverEachMissedBefore) {
  // a hand-over in each of them after the longest time that somebody is suffered
  constexpr int kBound_ms = 1000 + 2 * 50 + 2, kSeeds = 60;
  int disagreed = 0, hand_overs = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Domain domain(seed);
    domain.go(2000, true);
    domain.mend();
    disagreed += !domain.go(kBound_ms, false);
    EXPECT_TRUE(domain.go(100, false)) << "seed " << seed;
    hand_overs += domain.hand_overs();
  }
  EXPECT_GT(disagreed, kSeeds / 10) << "there was something to agree on";
  EXPECT_GT(hand_overs, kSeeds);
}

TEST(FollowingHolder, NoHandBeginsAtWhoServesThemBeforeTheLastOnesForceHasEnded) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Domain domain(seed);
    domain.go(2000, true);
    EXPECT_GE(domain.shortest_hand_over_ns(), kHandOver_ns) << "seed " << seed;
  }
}

TEST(AnsweredPoses, AnAnswerIsItsPosesSendersByNumberAndStampOfTheNewestOnes) {
  constexpr ParticipantId kOne{1}, kTwo{2};
  AnsweredPoses poses;
  EXPECT_FALSE(poses.sender_of({})) << "nobody sent any";
  for (int i = 0; i < 200; ++i) {
    poses.heard(kOne, 1000 + i, i);
    poses.heard(kTwo, 1000 + i, 7000 + i);
  }
  EXPECT_EQ(poses.sender_of({0, 1199, 199}), kOne);
  EXPECT_EQ(poses.sender_of({0, 1100, 7100}), kTwo);
  EXPECT_FALSE(poses.sender_of({0, 1199, 200})) << "of nobody";
  EXPECT_FALSE(poses.sender_of({0, 1000, 0})) << "too old";
  for (std::uint8_t i = 10; i < 20; ++i) poses.heard({i}, 1, i);
  EXPECT_FALSE(poses.sender_of({0, 1199, 199})) << "others were heard since";
  EXPECT_EQ(poses.sender_of({0, 1, 19}), ParticipantId{19});
}

}  // namespace
}  // namespace omentum::node
