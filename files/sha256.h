// The fingerprint by which two machines tell that they speak of the same thing.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

struct evp_md_ctx_st;

namespace omentum::files {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  /// Throws std::runtime_error where libcrypto offers none.
  Sha256();

  void add(const void* bytes, std::size_t count);
  /// Of all that was added; the end of it, 64 digits.
  std::string hexadecimal();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const noexcept;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

}  // namespace omentum::files
