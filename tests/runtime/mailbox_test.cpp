#include "runtime/mailbox.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace omentum::runtime {
namespace {

// Large enough that a copy takes many instructions: a torn one would hold two different numbers.
using Block = std::array<std::uint64_t, 64>;

bool torn(const Block& block) {
  for (const auto word : block) {
    if (word != block[0]) return true;
  }
  return false;
}

TEST(Mailbox, KeepsItsInitialValueUntilTheFirstPost) {
  Mailbox<int> box(7);
  EXPECT_FALSE(box.fetch());
  EXPECT_EQ(box.value(), 7);
}

TEST(Mailbox, FetchTakesTheNewestOfSeveralPostsOnce) {
  Mailbox<int> box;
  for (int i = 1; i <= 5; ++i) box.post(i);
  EXPECT_TRUE(box.fetch());
  EXPECT_EQ(box.value(), 5);
  EXPECT_FALSE(box.fetch());
  EXPECT_EQ(box.value(), 5);
}

TEST(Mailbox, DraftDoesNotDisturbWhatTheReaderHolds) {
  Mailbox<int> box;
  box.post(1);
  ASSERT_TRUE(box.fetch());
  box.draft() = 2;
  EXPECT_FALSE(box.fetch());
  EXPECT_EQ(box.value(), 1);
  box.post();
  box.draft() = 3;
  ASSERT_TRUE(box.fetch());
  EXPECT_EQ(box.value(), 2);
}

// Run under the thread sanitizer too (preset tsan).
TEST(Mailbox, ValuesAreNeverTornNorOlderThanTheLast) {
  constexpr std::uint64_t kPosts = 200'000;
  Mailbox<Block> box(Block{});
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kPosts; ++i) {
      box.draft().fill(i);
      box.post();
    }
  });
  std::uint64_t last = 0;
  bool any_torn = false, any_older = false;
  while (last < kPosts) {
    if (!box.fetch()) {
      std::this_thread::yield();
      continue;
    }
    any_torn |= torn(box.value());
    any_older |= box.value()[0] <= last;
    last = box.value()[0];
  }
  writer.join();
  EXPECT_FALSE(any_torn);
  EXPECT_FALSE(any_older);
}

}  // namespace
}  // namespace omentum::runtime
