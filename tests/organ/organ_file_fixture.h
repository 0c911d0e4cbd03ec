// Small organs and their file, for tests of what is written and read.
#pragma once

#include "organ/build_organ.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <functional>

namespace omentum::organ {

inline const physics::Material kTissue{3000, 0.45, 1050};

/// A box of 6 x 4 x 4 cm, held at one end.
inline Organ small_organ(const physics::Material& material = kTissue, Storage storage = Storage::kFloat,
                         const geometry::Vec3& size = {0.06, 0.04, 0.04}) {
  geometry::TetraMesh mesh = test::make_box_mesh(3, 2, 2, size);
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    if (mesh.positions[n].x() < 1e-9) fixed[n] = physics::kPinned;
  }
  return make_organ("box", std::move(mesh), material, std::move(fixed), storage);
}

/// Its outer half five times as stiff, and a region that is heavier alone.
inline Organ two_materials(Storage storage = Storage::kFloat) {
  Organ organ = small_organ();
  organ.mesh.regions.assign(organ.mesh.tetrahedra.size(), 0);
  for (std::size_t t = organ.mesh.tetrahedra.size() / 2; t < organ.mesh.regions.size(); ++t)
    organ.mesh.regions[t] = t % 5 == 0 ? 2 : 7;
  const physics::MaterialMap material{kTissue, {{2, {3000, 0.45, 2000}}, {7, {15000, 0.4, 1050}}}};
  return make_organ("box", std::move(organ.mesh), material, organ.fixed, storage);
}

/// An organ file in a folder of its own.
class OrganFileTest : public testing::Test {
 protected:
  Organ build(const Organ& organ) {
    build_organ(organ, file, {});
    return load_organ(file, Load::kWithTensors);
  }

  std::string refusal() const {
    try {
      load_organ(file, Load::kWithTensors);
    } catch (const geometry::InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(file.string()));
      EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("\n")));
      return e.what();
    }
    return "accepted";
  }

  // Changes a finished file from within.
  void damage(const std::function<void(hid_t)>& change) const {
    const hid_t hdf5 = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(hdf5, 0);
    change(hdf5);
    H5Fclose(hdf5);
  }

  test::ScratchFolder folder;
  const std::filesystem::path file = folder / "box.h5";
};

}  // namespace omentum::organ
