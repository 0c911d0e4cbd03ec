#include "transport/fast/session_keys.h"

#include "files/console.h"
#include "transport/fast/names.h"
#include "transport/fast/session_key_memo.h"

#include <dlfcn.h>

#include <cstdlib>

// Fast DDS 2.9 derives a session's key anew for each thing that it decrypts, which are three for a sample:
// the datagram, the time stamp and the sample. That is some 35 us each, more than all else that a small
// message costs its receiver, since OpenSSL 3 looks an algorithm up by its name each time. The derivation is
// a pure function of its arguments, and the library calls it through its symbol, of which a program may have
// one of its own: this one is found first, and asks the library's for what it was not asked before. A member
// function is called as a plain one with the object first.
#ifndef OMENTUM_FAST_DDS_3

#define OMENTUM_DERIVATION                                                                         \
  "_ZN8eprosima8fastrtps4rtps8security20AESGCMGMAC_Transform18compute_sessionkeyERSt5arrayIhLm32E" \
  "EbRKS5_S8_ji"

extern "C" __attribute__((visibility("default"))) void omentum_fast_session_key(
    void* transform, omentum::transport::fast::Key& key, bool of_one_receiver,
    const omentum::transport::fast::Key& master, const omentum::transport::fast::Key& salt,
    std::uint32_t session, int key_bytes) __asm__(OMENTUM_DERIVATION);

namespace omentum::transport::fast {

namespace {

using Derivation = decltype(omentum_fast_session_key);

Derivation* the_librarys() {
  auto* found = reinterpret_cast<Derivation*>(dlsym(RTLD_NEXT, OMENTUM_DERIVATION));
  if (found != nullptr) return found;
  // Who called us is that library; without its answer nobody could tell a message from a forged one.
  files::say("Fast DDS: its derivation of keys was not found");
  std::abort();
}

}  // namespace

bool remember_session_keys() {
  return dlsym(RTLD_DEFAULT, OMENTUM_DERIVATION) == reinterpret_cast<void*>(&omentum_fast_session_key);
}

}  // namespace omentum::transport::fast

void omentum_fast_session_key(void* transform, omentum::transport::fast::Key& key, bool of_one_receiver,
                              const omentum::transport::fast::Key& master,
                              const omentum::transport::fast::Key& salt, std::uint32_t session,
                              int key_bytes) {
  using namespace omentum::transport::fast;
  static Derivation* const derivation = the_librarys();
  // a thread's own: none waits for another one, the hand's least of all
  thread_local SessionKeyMemo memo;
  key = memo.find({of_one_receiver, master, salt, session, key_bytes}, [&](const SessionKeyTerms& terms) {
    Key derived{};
    derivation(transform, derived, terms.of_one_receiver, terms.master, terms.salt, terms.session,
               terms.key_bytes);
    return derived;
  });
}

#else

namespace omentum::transport::fast {

bool remember_session_keys() {
  return false;
}

}  // namespace omentum::transport::fast

#endif
