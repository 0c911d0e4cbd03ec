#include "organ/organ_hash.h"

#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>

namespace omentum::organ {

namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("libcrypto offers no SHA-256");
    }
  }

  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    EVP_DigestUpdate(context_.get(), &value, sizeof(T));
  }

  // The length goes first, so that two lists cannot be told apart wrongly.
  template <class T>
  void add_list(const std::vector<T>& values) {
    static_assert(sizeof(T) % sizeof(std::int32_t) == 0 || sizeof(T) == 1, "no padding");
    add(static_cast<std::uint64_t>(values.size()));
    EVP_DigestUpdate(context_.get(), values.data(), values.size() * sizeof(T));
  }

  std::string hexadecimal() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &length);
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
      text += "0123456789abcdef"[digest[i] >> 4];
      text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string organ_hash(const Organ& organ) {
  Sha256 sha;
  sha.add(std::int32_t{kFormatVersion});
  sha.add(static_cast<std::int32_t>(organ.storage));
  sha.add_list(organ.mesh.positions);
  sha.add_list(organ.mesh.tetrahedra);
  sha.add_list(organ.mesh.file_node);
  sha.add(organ.mesh.file_node_count);
  sha.add_list(organ.mesh.node_numbers);
  sha.add_list(organ.mesh.tetrahedron_numbers);
  sha.add_list(organ.surface.node);
  sha.add_list(organ.surface.triangles);
  sha.add_list(organ.surface.tetrahedron);
  sha.add_list(organ.surface.fan_start);
  sha.add_list(organ.surface.fan);
  sha.add(organ.surface.mobile_count);
  static_assert(sizeof(physics::Material) == 3 * sizeof(double), "no padding");
  sha.add(organ.material.common);
  sha.add_list(organ.fixed);
  // files of organs without any are older than these lists
  if (!organ.mesh.merged.empty()) sha.add_list(organ.mesh.merged);
  if (!organ.material.regions.empty()) {
    sha.add(std::array{'r', 'e', 'g', 'i', 'o', 'n', 's', ' '});  // no list of merged nodes
    sha.add_list(organ.mesh.regions);
    for (const physics::RegionMaterial& region : organ.material.regions) {
      sha.add(region.label);
      sha.add(region.material);
    }
  }
  return sha.hexadecimal();
}

}  // namespace omentum::organ
