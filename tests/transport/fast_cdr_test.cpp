#include "transport/fast/cdr.h"

#include "tests/transport/fill.h"
#include "transport/topics.h"

#include <gtest/gtest.h>

namespace omentum::transport::fast {
namespace {

template <class M>
std::vector<char> bytes_of(const M& message) {
  std::vector<char> bytes(encoded_bytes(message));
  EXPECT_EQ(encode(message, bytes.data(), bytes.size()), bytes.size());
  return bytes;
}

template <class M>
void expect_round_trip() {
  for (const M& message : test::known_messages<M>()) {
    std::vector<char> bytes = bytes_of(message);
    EXPECT_LE(bytes.size(), kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes);
    M decoded;
    ASSERT_TRUE(decode(bytes.data(), bytes.size(), false, decoded)) << msg::MessageInfo<M>::kTypeName;
    EXPECT_EQ(decoded, message);
  }
}

TEST(Cdr, EveryMessageComesBackAndItsSizeIsForeseen) {
  msg::for_each_topic(msg::AllTopics{}, []<class M>(msg::MessageTag<M>) { expect_round_trip<M>(); });
}

TEST(Cdr, BytesAreThoseOfTheStandard) {
  msg::SessionCommand command{
      .order = 0x0102030405060708, .sender = 0x1112131415161718, .command = 3, .argument = "ab"};
  const std::vector<char> expected = {
      0,    1,    0,    0,                             // plain CDR, little endian
      8,    7,    6,    5,    4,    3,    2,    1,     // order
      0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11,  // sender
      3,    0,    0,    0,                             // command
      3,    0,    0,    0,    'a',  'b',  0};          // length with the final zero, characters
  EXPECT_EQ(bytes_of(command), expected);
}

// The two vendors' nodes hear the same; and what was heard can be said.
TEST(Cdr, AZeroByteEndsAText) {
  std::vector<char> bytes = bytes_of(msg::SessionCommand{.argument = "abcd"});
  bytes[bytes.size() - 3] = 0;  // for the c
  msg::SessionCommand decoded;
  ASSERT_TRUE(decode(bytes.data(), bytes.size(), false, decoded));
  EXPECT_EQ(decoded.argument, "ab");
  EXPECT_TRUE(within_bounds(decoded));
}

TEST(Cdr, MembersAreAlignedToTheirOwnSize) {
  // behind the encapsulation: tool 4, organ 4, seq 8, tick 8, cause 4 + 4 + 8 + 8, version 8, three empty
  // sequences 4 each, grasping 1 + 3, count 8, cutting 1 + 7, count 8, two edges 48 each
  EXPECT_EQ(bytes_of(msg::Contact{}).size(), kEncapsulationBytes + 192);
}

// As deform_node would send it on a LAN: full, with the pose of every tool.
TEST(Cdr, ALocalModelTakesTheDatagramsThatAreStated) {
  constexpr std::size_t kNodes = local_model_nodes(Profile::kLan);
  msg::LocalModel model;
  model.echoes.resize(msg::MAX_TOOLS);
  model.nodes.resize(kNodes);
  model.positions.resize(kNodes);
  model.velocities.resize(kNodes);
  model.forces.resize(kNodes);
  model.triangles.resize(3 * 2 * kNodes);  // a closed surface has two for each node, less four
  model.compliance.resize(local_model_floats(kNodes));
  constexpr std::size_t kFragment = fragment_bytes(Profile::kLan);
  EXPECT_LE(bytes_of(model).size(), kLocalModelDatagrams * kFragment);
  EXPECT_GT(bytes_of(model).size(), (kLocalModelDatagrams - 1) * kFragment);
}

// It has the nodes of its state's block, which fills a datagram.
TEST(Cdr, AnOrganStressBlockIsNoLargerThanItsStates) {
  constexpr std::size_t kNodes = organ_block_floats(Profile::kLan) / 3;
  msg::OrganState state;
  state.echoes.resize(msg::MAX_TOOLS);
  state.values.resize(3 * kNodes);
  msg::OrganStress stress;
  stress.strains.resize(kNodes);
  stress.stresses.resize(kNodes);
  EXPECT_LE(bytes_of(stress).size(), bytes_of(state).size());
}

TEST(Cdr, ATouchingPairsBlockFitsADatagramOfALan) {
  msg::TouchingPairs block;
  block.pairs.resize(touching_block_pairs(Profile::kLan));
  constexpr std::size_t kHeaders = 60 + 28;  // of RTPS and a key hash
  EXPECT_LE(bytes_of(block).size() + kHeaders, fragment_bytes(Profile::kLan));
  block.pairs.resize(block.pairs.size() + 1);
  EXPECT_GT(bytes_of(block).size() + kHeaders, fragment_bytes(Profile::kLan)) << "as many as fit";
  block.pairs.resize(touching_block_pairs(Profile::kLoopback));
  EXPECT_LE(bytes_of(block).size(), fragment_bytes(Profile::kLoopback));
}

TEST(Cdr, BytesThatEndEarlyAreRefused) {
  msg::for_each_topic(msg::AllTopics{}, []<class M>(msg::MessageTag<M>) {
    const M message = test::Filler(3, test::Lengths::kOne).make<M>();
    std::vector<char> bytes = bytes_of(message);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      M decoded;
      EXPECT_FALSE(decode(bytes.data(), size, false, decoded))
          << msg::MessageInfo<M>::kTypeName << " " << size;
    }
  });
}

TEST(Cdr, ABreachedBoundIsRefusedBeforeMemoryIsTaken) {
  msg::Contact contact;
  contact.nodes.resize(msg::MAX_CONTACT_NODES + 1);
  std::vector<char> bytes = bytes_of(contact);
  msg::Contact decoded;
  EXPECT_FALSE(decode(bytes.data(), bytes.size(), false, decoded));
  EXPECT_EQ(decoded.nodes.capacity(), 0U);

  msg::SessionCommand command{.argument = std::string(161, 'x')};
  bytes = bytes_of(command);
  msg::SessionCommand decoded_command;
  EXPECT_FALSE(decode(bytes.data(), bytes.size(), false, decoded_command));
}

TEST(Cdr, NoBytesMakeItCrash) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 2000; ++round) {
    std::vector<char> bytes(4 + random() % 200);
    for (char& byte : bytes) byte = static_cast<char>(random());
    if (round % 2) std::fill_n(bytes.begin(), 4, '\0');  // a plausible encapsulation
    msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M>) {
      M decoded;
      if (decode(bytes.data(), bytes.size(), false, decoded)) {
        EXPECT_TRUE(within_bounds(decoded));
      }
    });
  }
}

TEST(Cdr, TheKeyIsReadWithoutTheRest) {
  msg::NodeStatus status = test::known_messages<msg::NodeStatus>().back();
  std::vector<char> bytes = bytes_of(status);
  msg::NodeStatus key;
  ASSERT_TRUE(decode(bytes.data(), bytes.size(), true, key));
  EXPECT_EQ(key.kind, status.kind);
  EXPECT_EQ(key.instance, status.instance);
  EXPECT_TRUE(key.host.empty());
  EXPECT_TRUE(key.faults.empty());
}

TEST(KeyHash, IsTheKeyInBigEndianCdrPaddedWithZeros) {
  const msg::NodeStatus status{.kind = 0x01020304, .instance = 0x1112131415161718};
  const std::array<char, 16> expected = {1,    2,    3,    4,    0,    0,    0,    0,
                                         0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18};
  EXPECT_EQ(key_hash(status), expected);
  const std::array<char, 16> tool = {0, 0, 0, 5};
  EXPECT_EQ(key_hash(msg::ToolPose{.tool = 5}), tool);
}

}  // namespace
}  // namespace omentum::transport::fast
