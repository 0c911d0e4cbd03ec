#include "organ/organ_hash.h"

#include "files/sha256.h"

#include <type_traits>

namespace omentum::organ {

namespace {

class ListSha256 : public files::Sha256 {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    Sha256::add(&value, sizeof(T));
  }

  // The length goes first, so that two lists cannot be told apart wrongly.
  template <class T>
  void add_list(const std::vector<T>& values) {
    static_assert(sizeof(T) % sizeof(std::int32_t) == 0 || sizeof(T) == 1, "no padding");
    add(static_cast<std::uint64_t>(values.size()));
    Sha256::add(values.data(), values.size() * sizeof(T));
  }
};

}  // namespace

std::string organ_hash(const Organ& organ) {
  ListSha256 sha;
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
  sha.add(organ.material.young_pa);
  sha.add(organ.material.poisson);
  sha.add(organ.material.density_kg_m3);
  sha.add_list(organ.fixed);
  // files of organs without any are older than this list
  if (!organ.mesh.merged.empty()) sha.add_list(organ.mesh.merged);
  return sha.hexadecimal();
}

}  // namespace omentum::organ
