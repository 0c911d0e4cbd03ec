// Keys of sessions of DDS Security that were derived before.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace omentum::transport::fast {

using Key = std::array<std::uint8_t, 32>;

/// What a session's key follows from (DDS Security 1.1 section 9.5.3.3.3): HMAC-SHA256 of a word, `salt` and
/// `session`, under `master`.
struct SessionKeyTerms {
  bool of_one_receiver = false;  // which word
  Key master{}, salt{};
  std::uint32_t session = 0;
  int key_bytes = 0;  // of `master` and `salt`

  bool operator==(const SessionKeyTerms&) const = default;
};

/// The newest keys, each found again by all that it follows from: what find() says is what derive() would. A
/// sender's next session takes the place of the one before. Allocates nothing; one thread.
class SessionKeyMemo {
 public:
  /// Four dozen writers with as many participants at once; with more of them some are derived again.
  static constexpr std::size_t kSets = 32, kWays = 4;

  /// The key of these terms: remembered, or derive(terms), which is called once for terms that come again.
  template <class Derive>
  const Key& find(const SessionKeyTerms& terms, Derive&& derive) {
    Set& set = sets_[place(terms)];
    for (Entry& entry : set.entries)
      if (entry.taken && entry.terms == terms) return entry.key;
    Entry& entry = oldest(set, terms);
    entry.taken = false;  // as long as derive() may throw
    entry.key = derive(terms);
    entry.terms = terms;
    entry.taken = true;
    return entry.key;
  }

 private:
  struct Entry {
    bool taken = false;
    SessionKeyTerms terms;
    Key key{};
  };
  struct Set {
    std::array<Entry, kWays> entries{};
    std::size_t next = 0;
  };

  // by what all sessions of a sender have in common; a salt is random
  static std::size_t place(const SessionKeyTerms& terms) {
    std::size_t random = 0;
    std::memcpy(&random, terms.salt.data(), sizeof(random));
    return random % kSets;
  }

  static bool same_sender(const SessionKeyTerms& a, const SessionKeyTerms& b) {
    return a.of_one_receiver == b.of_one_receiver && a.master == b.master && a.salt == b.salt;
  }

  static Entry& oldest(Set& set, const SessionKeyTerms& terms) {
    const auto before = std::find_if(set.entries.begin(), set.entries.end(), [&](const Entry& entry) {
      return entry.taken && same_sender(entry.terms, terms);
    });
    return before != set.entries.end() ? *before : set.entries[set.next++ % kWays];
  }

  std::array<Set, kSets> sets_{};
};

}  // namespace omentum::transport::fast
