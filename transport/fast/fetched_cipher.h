// Spares Fast DDS OpenSSL's look-up of its cipher for each thing that it encrypts or decrypts.
#pragma once

namespace omentum::transport::fast {

/// Looks AES-256-GCM up by its name, once in the process; from then on EVP_aes_256_gcm() is what was found.
/// False where OpenSSL has none: then everything is as it was. Any thread.
bool fetch_cipher();

}  // namespace omentum::transport::fast
