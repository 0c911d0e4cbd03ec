// Keys of sessions are remembered, and are those that Fast DDS derives.
#include "transport/fast/session_keys.h"
#include "transport/fast/names.h"
#include "transport/fast/session_key_memo.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#ifndef OMENTUM_FAST_DDS_3
#include <dlfcn.h>
#endif

namespace omentum::transport::fast {
namespace {

Key random_key(std::mt19937& chance) {
  Key key;
  for (std::uint8_t& byte : key) byte = static_cast<std::uint8_t>(chance());
  return key;
}

SessionKeyTerms random_terms(std::mt19937& chance) {
  return {.master = random_key(chance),
          .salt = random_key(chance),
          .session = static_cast<std::uint32_t>(chance()),
          .key_bytes = 32};
}

// A derivation that tells its terms apart and counts.
class CountedDerivation {
 public:
  Key operator()(const SessionKeyTerms& terms) {
    ++calls_;
    Key key = terms.master;
    for (std::size_t i = 0; i < key.size(); ++i)
      key[i] = static_cast<std::uint8_t>(key[i] + 3 * terms.salt[i]);
    key[0] = static_cast<std::uint8_t>(key[0] + terms.session);
    key[1] = static_cast<std::uint8_t>(key[1] + terms.key_bytes + (terms.of_one_receiver ? 1 : 0));
    return key;
  }
  int calls() const { return calls_; }

 private:
  int calls_ = 0;
};

// Terms that differ from these in one of them.
std::vector<SessionKeyTerms> neighbours(const SessionKeyTerms& terms) {
  std::vector<SessionKeyTerms> all(5, terms);
  all[0].of_one_receiver = !terms.of_one_receiver;
  all[1].master[31] ^= 1;
  all[2].salt[31] ^= 1;
  all[3].session ^= 1;
  all[4].key_bytes = 16;
  return all;
}

TEST(SessionKeyMemo, DerivesEachKeyOnce) {
  std::mt19937 chance(1);
  CountedDerivation derivation;
  SessionKeyMemo memo;
  const SessionKeyTerms one = random_terms(chance), other = random_terms(chance);
  for (int message = 0; message < 100; ++message) {
    EXPECT_EQ(memo.find(one, std::ref(derivation)), CountedDerivation()(one));
    EXPECT_EQ(memo.find(other, std::ref(derivation)), CountedDerivation()(other));
  }
  EXPECT_EQ(derivation.calls(), 2);
}

TEST(SessionKeyMemo, TellsTermsApartThatDifferInOne) {
  std::mt19937 chance(2);
  CountedDerivation derivation;
  SessionKeyMemo memo;
  const SessionKeyTerms terms = random_terms(chance);
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(memo.find(terms, std::ref(derivation)), CountedDerivation()(terms));
    for (const SessionKeyTerms& near : neighbours(terms)) {
      EXPECT_EQ(memo.find(near, std::ref(derivation)), CountedDerivation()(near));
    }
  }
}

TEST(SessionKeyMemo, NextSessionTakesThePlaceOfTheOneBefore) {
  std::mt19937 chance(3);
  CountedDerivation derivation;
  SessionKeyMemo memo;
  const SessionKeyTerms quiet = random_terms(chance);
  SessionKeyTerms busy = random_terms(chance);
  busy.salt = quiet.salt;  // in one set
  memo.find(quiet, std::ref(derivation));
  for (std::uint32_t session = 0; session < 50; ++session) {
    busy.session = session;
    memo.find(busy, std::ref(derivation));
  }
  EXPECT_EQ(derivation.calls(), 51);
  memo.find(quiet, std::ref(derivation));
  EXPECT_EQ(derivation.calls(), 51) << "what another sender's sessions must not push out";
}

TEST(SessionKeyMemo, IsRightWhereItHasNoRoomForAll) {
  std::mt19937 chance(4);
  CountedDerivation derivation;
  SessionKeyMemo memo;
  std::vector<SessionKeyTerms> senders;
  for (std::size_t i = 0; i < 4 * SessionKeyMemo::kSets * SessionKeyMemo::kWays; ++i)
    senders.push_back(random_terms(chance));
  for (int round = 0; round < 2; ++round) {
    for (const SessionKeyTerms& terms : senders)
      ASSERT_EQ(memo.find(terms, std::ref(derivation)), CountedDerivation()(terms));
  }
}

#ifndef OMENTUM_FAST_DDS_3

// Fast DDS' derivation as whoever calls it by its name finds it, and the library's own.
using Derivation = void(void*, Key&, bool, const Key&, const Key&, std::uint32_t, int);
constexpr const char* kDerivation =
    "_ZN8eprosima8fastrtps4rtps8security20AESGCMGMAC_Transform18compute_sessionkeyERSt5arrayIhLm32E"
    "EbRKS5_S8_ji";

Key derived_by(Derivation* derivation, const SessionKeyTerms& terms) {
  Key key{};
  derivation(nullptr, key, terms.of_one_receiver, terms.master, terms.salt, terms.session, terms.key_bytes);
  return key;
}

TEST(SessionKeys, AreThoseThatFastDdsDerives) {
  ASSERT_TRUE(remember_session_keys());
  auto* remembered = reinterpret_cast<Derivation*>(dlsym(RTLD_DEFAULT, kDerivation));
  auto* own = reinterpret_cast<Derivation*>(dlsym(RTLD_NEXT, kDerivation));
  ASSERT_NE(own, nullptr);
  ASSERT_NE(remembered, own);
  std::mt19937 chance(5);
  for (int sender = 0; sender < 20; ++sender) {
    const SessionKeyTerms terms = random_terms(chance);
    for (int message = 0; message < 3; ++message) {
      EXPECT_EQ(derived_by(remembered, terms), derived_by(own, terms));
      for (const SessionKeyTerms& near : neighbours(terms)) {
        EXPECT_EQ(derived_by(remembered, near), derived_by(own, near));
        EXPECT_NE(derived_by(own, near), derived_by(own, terms));
      }
    }
  }
}

#endif

}  // namespace
}  // namespace omentum::transport::fast
