#include "transport/fast/fetched_cipher.h"

#include <dlfcn.h>
#include <openssl/evp.h>

#include <atomic>

// What OpenSSL's EVP_aes_256_gcm() answers is only a name since version 3: each EVP_CipherInit looks the
// cipher up again, under locks, with comparisons of texts, which takes longer than to encrypt a pose. What
// EVP_CIPHER_fetch found can stand in every place of the name and needs no look-up. This function is found
// before the library's, as a malloc of the program's own would be.

namespace {

// never freed: it is used as long as there are threads
std::atomic<const EVP_CIPHER*> found{nullptr};

using Named = const EVP_CIPHER*();

// OpenSSL's own; null never, since whoever asks is linked with it
Named* named() {
  static auto* const own = reinterpret_cast<Named*>(dlsym(RTLD_NEXT, "EVP_aes_256_gcm"));
  return own;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const EVP_CIPHER* EVP_aes_256_gcm() {
  const EVP_CIPHER* cipher = found.load(std::memory_order_acquire);
  // before and while it is looked up: OpenSSL asks for its name itself then
  return cipher != nullptr ? cipher : named()();
}

namespace omentum::transport::fast {

bool fetch_cipher() {
  // one look-up: a second one that began at the same time would be lost
  static const bool fetched = [] {
    found.store(EVP_CIPHER_fetch(nullptr, "AES-256-GCM", nullptr), std::memory_order_release);
    return found.load(std::memory_order_acquire) != nullptr;
  }();
  return fetched;
}

}  // namespace omentum::transport::fast
