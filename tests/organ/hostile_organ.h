// Organ files that somebody wrote on purpose: their hashes match, since these have no key.
#pragma once

#include "organ/build_organ.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"
#include "organ/stored_tensors.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <functional>

namespace omentum::organ {

inline Organ box_organ(Storage storage = Storage::kFloat) {
  geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 2, {0.04, 0.04, 0.04});
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    if (mesh.positions[n].x() < 1e-9) fixed[n] = physics::kPinned;
  }
  return make_organ("box", std::move(mesh), physics::Material{3000, 0.45, 1050}, std::move(fixed), storage);
}

// Replaces a dataset by the numbers that `values` are made of.
template <class Number, class T>
void put(hid_t hdf5, const char* name, const std::vector<T>& values, hid_t type) {
  constexpr hsize_t kColumns = sizeof(T) / sizeof(Number);
  const hsize_t shape[] = {values.size(), kColumns};
  H5Ldelete(hdf5, name, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(kColumns == 1 ? 1 : 2, shape, nullptr);
  const hid_t data = H5Dcreate2(hdf5, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(data, 0);
  if (!values.empty()) {
    EXPECT_GE(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  }
  H5Dclose(data);
  H5Sclose(space);
}

inline void put_number(hid_t hdf5, const char* name, double value) {
  const hid_t attribute = H5Aopen(hdf5, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), 0);
  H5Aclose(attribute);
}

/// A small organ's file, honest at first.
class HostileOrganTest : public testing::Test {
 protected:
  HostileOrganTest() {
    build_organ(honest, file, {});
    std::filesystem::copy_file(file, kept);
  }

  void restore() const {
    std::filesystem::copy_file(kept, file, std::filesystem::copy_options::overwrite_existing);
  }

  void change(const std::function<void(hid_t)>& change) const {
    const hid_t hdf5 = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(hdf5, 0);
    change(hdf5);
    ASSERT_GE(H5Fclose(hdf5), 0);
  }

  // An honest file whose mesh, surface, supports and material become those of `organ`, with the hash of that.
  void forge(const Organ& organ) const {
    restore();
    change([&](hid_t hdf5) {
      put<double>(hdf5, layout::kPositions, organ.mesh.positions, H5T_NATIVE_DOUBLE);
      put<std::int32_t>(hdf5, layout::kTetrahedra, organ.mesh.tetrahedra, H5T_NATIVE_INT32);
      put<std::int32_t>(hdf5, layout::kFileNode, organ.mesh.file_node, H5T_NATIVE_INT32);
      put<std::int64_t>(hdf5, layout::kNodeNumbers, organ.mesh.node_numbers, H5T_NATIVE_INT64);
      put<std::int64_t>(hdf5, layout::kTetrahedronNumbers, organ.mesh.tetrahedron_numbers, H5T_NATIVE_INT64);
      if (!organ.mesh.merged.empty())
        put<std::int32_t>(hdf5, layout::kMerged, organ.mesh.merged, H5T_NATIVE_INT32);
      if (!organ.material.regions.empty()) put_regions(hdf5, organ);
      put<std::int32_t>(hdf5, layout::kSurfaceNode, organ.surface.node, H5T_NATIVE_INT32);
      put<std::int32_t>(hdf5, layout::kTriangles, organ.surface.triangles, H5T_NATIVE_INT32);
      put<std::int32_t>(hdf5, layout::kBehind, organ.surface.tetrahedron, H5T_NATIVE_INT32);
      put<std::int32_t>(hdf5, layout::kFanStart, organ.surface.fan_start, H5T_NATIVE_INT32);
      put<std::int32_t>(hdf5, layout::kFan, organ.surface.fan, H5T_NATIVE_INT32);
      put<std::uint8_t>(hdf5, layout::kFixed, organ.fixed, H5T_NATIVE_UINT8);
      put_number(hdf5, layout::kFileNodes, organ.mesh.file_node_count);
      put_number(hdf5, layout::kMobile, organ.surface.mobile_count);
      put_number(hdf5, layout::kYoung, organ.material.common.young_pa);
      const std::string hash = organ_hash(organ);
      const hid_t attribute = H5Aopen(hdf5, layout::kHash, H5P_DEFAULT), type = H5Aget_type(attribute);
      EXPECT_GE(H5Awrite(attribute, type, hash.c_str()), 0);
      H5Tclose(type);
      H5Aclose(attribute);
    });
  }

  static void put_regions(hid_t hdf5, const Organ& organ) {
    std::vector<std::int32_t> labels;
    std::vector<physics::Material> materials;
    for (const auto& [label, material] : organ.material.regions) {
      labels.push_back(label);
      materials.push_back(material);
    }
    H5Gclose(H5Gcreate2(hdf5, "material", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    put<std::int32_t>(hdf5, layout::kRegions, organ.mesh.regions, H5T_NATIVE_INT32);
    put<std::int32_t>(hdf5, layout::kRegionLabels, labels, H5T_NATIVE_INT32);
    put<double>(hdf5, layout::kRegionMaterials, materials, H5T_NATIVE_DOUBLE);
  }

  // why the file is refused, in one line that names it; "accepted" where all that it says can be used
  std::string refusal() const {
    try {
      expect_all_in_range(load_organ(file, Load::kWithTensors));
    } catch (const geometry::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(file.string()));
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
      return error.what();
    }
    return "accepted";
  }

  // spoiled so, it is refused, and what is wrong is named
  void expect_named(const std::function<void(Organ&)>& spoil, const std::string& named) const {
    Organ organ = honest;
    spoil(organ);
    forge(organ);
    EXPECT_THAT(refusal(), testing::HasSubstr(named));
  }

  static void expect_all_in_range(const Organ& organ) {
    const auto below = [](std::int32_t index, std::size_t count) {
      return index >= 0 && static_cast<std::size_t>(index) < count;
    };
    const geometry::Surface& s = organ.surface;
    const std::size_t nodes = organ.mesh.positions.size();
    ASSERT_EQ(organ.fixed.size(), nodes);
    ASSERT_EQ(organ.mesh.file_node.size(), nodes);
    ASSERT_EQ(organ.mesh.node_numbers.size(), static_cast<std::size_t>(organ.mesh.file_node_count));
    ASSERT_EQ(organ.mesh.tetrahedron_numbers.size(), organ.mesh.tetrahedra.size());
    for (const auto n : organ.mesh.file_node)
      ASSERT_TRUE(below(n, static_cast<std::size_t>(organ.mesh.file_node_count)));
    for (const auto& tetrahedron : organ.mesh.tetrahedra) {
      for (const auto n : tetrahedron) ASSERT_TRUE(below(n, nodes));
    }
    for (const auto n : s.node) ASSERT_TRUE(below(n, nodes));
    ASSERT_EQ(s.tetrahedron.size(), s.triangles.size());
    for (const auto t : s.tetrahedron) ASSERT_TRUE(below(t, organ.mesh.tetrahedra.size()));
    for (const auto& triangle : s.triangles) {
      for (const auto n : triangle) ASSERT_TRUE(below(n, s.node.size()));
    }
    ASSERT_EQ(s.fan_start.size(), s.node.size() + 1);
    for (std::size_t n = 0; n < s.node.size(); ++n) {
      ASSERT_TRUE(s.fan_start[n] >= 0 && s.fan_start[n] <= s.fan_start[n + 1]);
      ASSERT_LE(static_cast<std::size_t>(s.fan_start[n + 1]), s.fan.size());
    }
    for (const auto f : s.fan) ASSERT_TRUE(below(f, s.triangles.size()));
    ASSERT_TRUE(s.mobile_count > 0 && s.mobile_count <= s.node_count());
    ASSERT_EQ(organ.compliance->mobile_count(), s.mobile_count);
  }

  test::ScratchFolder folder;
  const std::filesystem::path file = folder / "box.h5", kept = folder / "honest.h5";
  const Organ honest = box_organ();
};

}  // namespace omentum::organ
