// The cipher that was looked up encrypts as the one that is looked up each time.
#include "transport/fast/fetched_cipher.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

namespace omentum::transport::fast {
namespace {

struct Sealed {
  std::vector<unsigned char> text;
  std::array<unsigned char, 16> tag{};

  bool operator==(const Sealed&) const = default;
};

using Context = std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)>;

// Fast DDS' sequence of calls.
Sealed sealed(const EVP_CIPHER* cipher, const std::vector<unsigned char>& plain) {
  const std::array<unsigned char, 32> key{1, 2, 3};
  const std::array<unsigned char, 12> nonce{4, 5, 6};
  const Context context(EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
  Sealed sealed;
  sealed.text.resize(plain.size() + 16);
  int part = 0, rest = 0;
  EXPECT_EQ(EVP_EncryptInit(context.get(), cipher, key.data(), nonce.data()), 1);
  EXPECT_EQ(EVP_EncryptUpdate(context.get(), sealed.text.data(), &part, plain.data(),
                              static_cast<int>(plain.size())),
            1);
  EXPECT_EQ(EVP_EncryptFinal(context.get(), sealed.text.data() + part, &rest), 1);
  EXPECT_EQ(EVP_CIPHER_CTX_ctrl(context.get(), EVP_CTRL_GCM_GET_TAG, 16, sealed.tag.data()), 1);
  sealed.text.resize(static_cast<std::size_t>(part + rest));
  return sealed;
}

TEST(FetchedCipher, NeedsNoLookUpAndEncryptsAlike) {
  auto* own = reinterpret_cast<const EVP_CIPHER* (*)()>(dlsym(RTLD_NEXT, "EVP_aes_256_gcm"));
  ASSERT_NE(own, nullptr);
  ASSERT_TRUE(fetch_cipher());
  // as Fast DDS finds it
  auto* found = reinterpret_cast<const EVP_CIPHER* (*)()>(dlsym(RTLD_DEFAULT, "EVP_aes_256_gcm"));
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(EVP_CIPHER_get0_provider(own()), nullptr) << "OpenSSL's own is a name";
  EXPECT_NE(EVP_CIPHER_get0_provider(found()), nullptr);
  EXPECT_EQ(EVP_CIPHER_get_block_size(found()), EVP_CIPHER_get_block_size(own()));
  for (const std::size_t bytes : {1U, 100U, 5000U}) {
    const std::vector<unsigned char> plain(bytes, 42);
    EXPECT_EQ(sealed(found(), plain), sealed(own(), plain));
  }
}

}  // namespace
}  // namespace omentum::transport::fast
