// Organ files that somebody wrote on purpose: their hashes match, since these have no key, and what they say
// is wrong.
#include "organ/build_organ.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"
#include "organ/stored_tensors.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <cstring>
#include <functional>
#include <random>

// The leak sanitizer asks for it by this name: HDF5 forgets what it had read of a damaged description.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}

namespace omentum::organ {
namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::TriangleId;
using testing::AnyOf;
using testing::HasSubstr;

Organ box_organ(Storage storage = Storage::kFloat) {
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

void put_number(hid_t hdf5, const char* name, double value) {
  const hid_t attribute = H5Aopen(hdf5, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), 0);
  H5Aclose(attribute);
}

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

  std::string refusal() const {
    try {
      expect_all_in_range(load_organ(file, Load::kWithTensors));
    } catch (const geometry::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      return error.what();
    }
    return "accepted";
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

// One thing at a time, anywhere in an organ.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  Organ of(Organ organ) {
    geometry::Surface& s = organ.surface;
    switch (pick(12)) {
      case 0:
        real(organ.mesh.positions[pick(organ.mesh.positions.size())][pick(3)]);
        break;
      case 1:
        index(organ.mesh.tetrahedra[pick(organ.mesh.tetrahedra.size())][pick(4)]);
        break;
      case 2:
        index(organ.mesh.file_node[pick(organ.mesh.file_node.size())]);
        break;
      case 3:
        index(s.node[pick(s.node.size())]);
        break;
      case 4:
        index(s.triangles[pick(s.triangles.size())][pick(3)]);
        break;
      case 5:
        index(s.tetrahedron[pick(s.tetrahedron.size())]);
        break;
      case 6:
        index(s.fan_start[pick(s.fan_start.size())]);
        break;
      case 7:
        index(s.fan[pick(s.fan.size())]);
        break;
      case 8:
        organ.fixed[pick(organ.fixed.size())] = static_cast<std::uint8_t>(random_());
        break;
      case 9:
        index(s.mobile_count);
        break;
      case 10:
        index(organ.mesh.file_node_count);
        break;
      default:
        length(organ);
        break;
    }
    return organ;
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  template <class Index>
  void index(Index& value) {
    const std::int32_t now = value;
    const std::int32_t wrong[] = {-1,      std::numeric_limits<std::int32_t>::min(),
                                  now + 1, std::numeric_limits<std::int32_t>::max(),
                                  0,       1 << 20,
                                  now - 1, static_cast<std::int32_t>(random_() % 64)};
    value = Index(wrong[pick(std::size(wrong))]);
  }
  void real(double& value) {
    const double wrong[] = {std::nan(""), HUGE_VAL, 1e300, -value - 0.01, 0};
    value = wrong[pick(std::size(wrong))];
  }
  template <class T>
  void resize(std::vector<T>& values) {
    const std::size_t sizes[] = {0, 1, values.size() - 1, values.size() + 1, 2 * values.size()};
    values.resize(sizes[pick(std::size(sizes))], values.front());
  }
  void length(Organ& organ) {
    geometry::Surface& s = organ.surface;
    switch (pick(11)) {
      case 0:
        resize(organ.mesh.positions);
        break;
      case 1:
        resize(organ.mesh.tetrahedra);
        break;
      case 2:
        resize(organ.mesh.file_node);
        break;
      case 3:
        resize(s.node);
        break;
      case 4:
        resize(s.triangles);
        break;
      case 5:
        resize(s.tetrahedron);
        break;
      case 6:
        resize(s.fan_start);
        break;
      case 7:
        resize(s.fan);
        break;
      case 8:
        resize(organ.mesh.node_numbers);
        break;
      case 9:
        resize(organ.mesh.tetrahedron_numbers);
        break;
      default:
        resize(organ.fixed);
        break;
    }
  }

  std::mt19937 random_;
};

TEST_F(HostileOrganTest, AForgedFileThatIsHonestIsAccepted) {
  forge(honest);
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(HostileOrganTest, EveryMutationIsRefusedOrHasAllIndicesInRange) {
  constexpr int kMutations = 600;
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    SCOPED_TRACE(i);
    forge(Mutation(static_cast<unsigned>(i)).of(honest));
    refused += refusal() != "accepted";
    ASSERT_FALSE(HasFatalFailure());
  }
  // what is left moved a node or kept a value
  EXPECT_GT(refused, kMutations * 3 / 4);
}

TEST_F(HostileOrganTest, WhatIsWrongIsNamed) {
  const auto expect = [&](const std::function<void(Organ&)>& spoil, const std::string& named) {
    Organ organ = honest;
    spoil(organ);
    forge(organ);
    EXPECT_THAT(refusal(), HasSubstr(named));
  };
  expect([](Organ& o) { o.surface.triangles[3][1] = SurfaceId(1 << 20); }, "row 3 of 'surface/triangles'");
  expect([](Organ& o) { std::swap(o.surface.triangles[3][1], o.surface.triangles[3][2]); }, "no face");
  expect([](Organ& o) { o.surface.node[2] = NodeId(-7); }, "row 2 of 'surface/node'");
  expect([](Organ& o) { o.surface.tetrahedron[0] = TetId(4000); }, "row 0 of 'surface/tetrahedron'");
  expect([](Organ& o) { o.surface.fan[5] = TriangleId(-1); }, "row 5 of 'surface/fan'");
  expect([](Organ& o) { o.surface.fan_start[4] = 1 << 30; }, "row 4 of 'surface/fan_start'");
  expect([](Organ& o) { o.mesh.tetrahedra[6][0] = NodeId(27); }, "row 6 of 'mesh/tetrahedra'");
  expect([](Organ& o) { std::swap(o.mesh.tetrahedra[6][0], o.mesh.tetrahedra[6][1]); }, "no positive volume");
  expect([](Organ& o) { o.mesh.file_node[1] = -3; }, "row 1 of 'mesh/file_node'");
  expect([](Organ& o) { o.mesh.node_numbers.pop_back(); }, "'mesh/node_numbers' has 26 rows; expected 27");
  expect([](Organ& o) { o.mesh.tetrahedron_numbers.pop_back(); }, "'mesh/tetrahedron_numbers'");
  expect([](Organ& o) { o.mesh.merged = {{40, 3}}; }, "row 0 of 'mesh/merged'");
  expect([](Organ& o) { o.mesh.merged = {{-1, 3}}; }, "row 0 of 'mesh/merged'");
  expect([](Organ& o) { o.mesh.merged = {{26, 3}}; }, "or in use");
  for (const std::int32_t kept : {27, 1000, -2}) {
    const auto add_node = [kept](Organ& o) {
      o.mesh.node_numbers.push_back(27);
      o.mesh.file_node_count = 28;
      o.mesh.merged = {{27, 3}, {27, kept}};
    };
    expect(add_node, "row 1 of 'mesh/merged'");
  }
  expect([](Organ& o) { o.mesh.positions[9].y() = NAN; }, "row 9 of 'mesh/positions'");
  expect([](Organ& o) { o.fixed.back() = 8; }, "row 26 of 'supports/fixed'");
  expect([](Organ& o) { o.fixed.pop_back(); }, "'supports/fixed' has 26 rows; expected 27");
  expect([](Organ& o) { o.surface.mobile_count = 1 << 28; }, "mobile_count");
  expect([](Organ& o) { o.surface.mobile_count -= 1; }, "'surface/node'");
  expect([](Organ& o) { o.material.common.young_pa = -1; }, "Young's modulus");
  const auto with_regions = [](std::vector<physics::RegionMaterial> regions, std::size_t labelled) {
    return [regions, labelled](Organ& o) {
      o.mesh.regions.assign(labelled, 3);
      o.mesh.regions.back() = 8;
      o.material.regions = regions;
    };
  };
  const physics::Material stiff{9000, 0.4, 1050};
  expect(with_regions({{3, stiff}, {8, stiff}}, 47), "'mesh/regions' has 47 rows; expected 48");
  expect(with_regions({{8, stiff}, {3, stiff}}, 48), "row 1 of 'material/labels'");
  expect(with_regions({{3, stiff}, {3, stiff}}, 48), "row 1 of 'material/labels'");
  expect(with_regions({{4, stiff}}, 48), "row 0 of 'material/labels' is the label of no tetrahedron");
  expect(with_regions({{3, {NAN, 0.4, 1050}}}, 48), "region 3: Young's modulus");
  expect(with_regions({{3, {9000, 0.4, 1050}}, {8, {9000, 0.5, 1050}}}, 48), "region 8: Poisson's ratio");
  expect(
      [](Organ& o) {
        o.surface.triangles.pop_back();
        o.surface.tetrahedron.pop_back();
        o.surface.fan.resize(3 * o.surface.triangles.size());
      },
      "does not close");
}

// HDF5 writes as many values as the attribute says that it has.
TEST_F(HostileOrganTest, AttributesThatAreNoSingleValuesAreRefused) {
  for (const char* name : {layout::kYoung, layout::kMobile, layout::kVersion}) {
    restore();
    change([&](hid_t hdf5) {
      H5Adelete(hdf5, name);
      const hsize_t many = 4000;
      const std::vector<double> values(many, 1.0);
      const hid_t space = H5Screate_simple(1, &many, nullptr);
      const hid_t attribute = H5Acreate2(hdf5, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
      EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()), 0);
      H5Aclose(attribute);
      H5Sclose(space);
    });
    EXPECT_THAT(refusal(), HasSubstr(std::string("no number '") + name + "'"));
  }
  for (const double wrong : {std::nan(""), HUGE_VAL, -1.0, 1e10, 2.5}) {
    restore();
    change([&](hid_t hdf5) { put_number(hdf5, layout::kMobile, wrong); });
    EXPECT_THAT(refusal(), HasSubstr("expected a whole number")) << wrong;
    change([&](hid_t hdf5) { put_number(hdf5, layout::kVersion, wrong); });
    EXPECT_THAT(refusal(), HasSubstr("format version")) << wrong;
  }
}

herr_t copy_attribute(hid_t from, const char* name, const H5A_info_t*, void* to) {
  const hid_t old = H5Aopen(from, name, H5P_DEFAULT), type = H5Aget_type(old), space = H5Aget_space(old);
  std::vector<char> value(H5Tget_size(type));
  H5Aread(old, type, value.data());
  const hid_t made = H5Acreate2(*static_cast<hid_t*>(to), name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  const herr_t written = H5Awrite(made, type, value.data());
  H5Aclose(made), H5Sclose(space), H5Tclose(type), H5Aclose(old);
  return written;
}

void copy_dataset(hid_t from, hid_t to, const char* name) {
  const hid_t old = H5Dopen2(from, name, H5P_DEFAULT), type = H5Dget_type(old), space = H5Dget_space(old);
  std::vector<char> values(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(old, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  const hid_t made = H5Dcreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(made), H5Sclose(space), H5Tclose(type), H5Dclose(old);
}

// The same organ in HDF5's oldest format, in which nothing has a checksum that would have to be forged.
void write_in_oldest_format(const std::filesystem::path& from, const std::filesystem::path& to) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_alignment(access, 1, 64);
  const hid_t old = H5Fopen(from.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  hid_t made = H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  for (const char* group : {"mesh", "surface", "supports", "tensors"})
    H5Gclose(H5Gcreate2(made, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  for (const char* name :
       {layout::kPositions, layout::kTetrahedra, layout::kFileNode, layout::kNodeNumbers,
        layout::kTetrahedronNumbers, layout::kSurfaceNode, layout::kTriangles, layout::kBehind,
        layout::kFanStart, layout::kFan, layout::kFixed, layout::kCompliance, layout::kBounds})
    copy_dataset(old, made, name);
  EXPECT_GE(H5Aiterate2(old, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, copy_attribute, &made), 0);
  H5Fclose(made), H5Fclose(old), H5Pclose(access);
}

TEST_F(HostileOrganTest, OffsetsOutsideOfTheFileAreRefused) {
  write_in_oldest_format(kept, file);
  ASSERT_EQ(refusal(), "accepted");
  std::uint64_t offset = 0;
  change([&](hid_t hdf5) {
    const hid_t data = H5Dopen2(hdf5, layout::kCompliance, H5P_DEFAULT);
    offset = H5Dget_offset(data);
    H5Dclose(data);
  });
  const std::string whole = test::read_text(file);
  std::string coded(sizeof offset, '\0');
  std::memcpy(coded.data(), &offset, sizeof offset);
  const std::size_t at = whole.find(coded);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(whole.find(coded, at + 1), std::string::npos) << "the offset stands once";
  // the first two wrap when the size is added; then beyond the end, across it, and between two cache lines
  for (const std::uint64_t wrong :
       {~std::uint64_t{0} - 63, ~std::uint64_t{0} - 4095, std::uint64_t{1} << 63, std::uint64_t{whole.size()},
        std::uint64_t{whole.size() - 64}, offset - 4}) {
    std::string forged = whole;
    std::memcpy(forged.data() + at, &wrong, sizeof wrong);
    std::ofstream(file, std::ios::binary) << forged;
    EXPECT_THAT(refusal(), AnyOf(HasSubstr("truncated"), HasSubstr("not aligned"))) << wrong;
  }
}

// HDF5's own reading of damaged descriptions: they have checksums, so that it refuses them.
TEST_F(HostileOrganTest, DamageAnywhereIsRefusedOrHarmless) {
  const std::string whole = test::read_text(kept);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    std::string damaged = whole;
    // descriptions lie at both ends
    for (int k = 0; k < 3; ++k) {
      const std::size_t near = random() % 3000;
      damaged[random() % 2 ? near : whole.size() - 1 - near] = static_cast<char>(random());
    }
    std::ofstream(file, std::ios::binary) << damaged;
    refusal();
    ASSERT_FALSE(HasFatalFailure());
  }
}

// Sets one number of the tensors.
void spoil(hid_t hdf5, const char* dataset, std::size_t at, float value) {
  const hid_t data = H5Dopen2(hdf5, dataset, H5P_DEFAULT), space = H5Dget_space(data);
  std::vector<float> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values.at(at) = value;
  H5Dwrite(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(data);
}

class SpoiltTensorsTest : public HostileOrganTest, public testing::WithParamInterface<Storage> {
 protected:
  SpoiltTensorsTest() {
    organ.emplace(box_organ(GetParam()));
    BuildOptions force;
    force.force = true;
    build_organ(*organ, file, force);
    std::filesystem::copy_file(file, whole);
  }
  void spoil_one(const char* dataset, std::size_t at, float value) const {
    std::filesystem::copy_file(whole, file, std::filesystem::copy_options::overwrite_existing);
    change([&](hid_t hdf5) { spoil(hdf5, dataset, at, value); });
  }
  // of C_nk, component i along j
  std::size_t place(std::size_t n, std::size_t i, std::size_t k, std::size_t j) const {
    const auto clusters = static_cast<std::size_t>((organ->surface.mobile_count + 15) / 16);
    return ((k * clusters + n / 16) * 9 + 3 * i + j) * 16 + n % 16;
  }

  std::optional<Organ> organ;
  const std::filesystem::path whole = folder / "whole.h5";
};

TEST_P(SpoiltTensorsTest, AWrongDiagonalOrBoundIsRefusedAtTheStart) {
  for (const float wrong : {NAN, HUGE_VALF, -1.0f, 0.0f}) {
    spoil_one(layout::kCompliance, place(5, 1, 5, 1), wrong);
    EXPECT_THAT(refusal(), HasSubstr("column 5")) << wrong;
  }
  spoil_one(layout::kCompliance, place(5, 0, 5, 1), 1.0f);
  EXPECT_THAT(refusal(), HasSubstr("column 5"));
  for (const float wrong : {NAN, HUGE_VALF, -1.0f}) {
    spoil_one(layout::kBounds, 1, wrong);
    EXPECT_THAT(refusal(), HasSubstr("a bound is")) << wrong;
  }
  spoil_one(layout::kBounds, 0, 0.0f);
  EXPECT_THAT(refusal(), HasSubstr("column 0")) << "a bound that bounds nothing";
}

TEST_P(SpoiltTensorsTest, AnyWrongNumberIsFoundByOrganBuild) {
  EXPECT_TRUE(is_up_to_date(file, *organ));
  for (const std::size_t k : {0u, 7u, 16u}) {
    spoil_one(layout::kCompliance, place(3, 2, k, 0), 1e-3f);
    EXPECT_FALSE(is_up_to_date(file, *organ)) << k;
  }
  EXPECT_FALSE(build_organ(*organ, file, {}).up_to_date) << "built again";
  EXPECT_TRUE(is_up_to_date(file, *organ));
}

INSTANTIATE_TEST_SUITE_P(Precisions, SpoiltTensorsTest, testing::Values(Storage::kFloat, Storage::kDouble),
                         [](const auto& info) { return info.param == Storage::kFloat ? "Float" : "Double"; });

}  // namespace
}  // namespace omentum::organ
