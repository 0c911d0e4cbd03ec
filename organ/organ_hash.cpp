#include "organ/organ_hash.h"

#include "files/sha256.h"

#include <array>
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
  if (organ.split) {
    sha.add(std::array{'d', 'y', 'n', 'a', 'm', 'i', 'c', ' '});
    sha.add_list(organ.split->dynamic);
    sha.add_list(organ.split->tensor_node);
    if (!organ.split->border.empty()) {
      sha.add(std::array{'b', 'o', 'r', 'd', 'e', 'r', ' ', ' '});
      sha.add_list(organ.split->border);
    }
  }
  return sha.hexadecimal();
}

}  // namespace omentum::organ
