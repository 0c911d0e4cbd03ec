// Organ files whose bytes are not what organ_build wrote: HDF5's own descriptions, and the tensors.
#include "tests/organ/hostile_organ.h"

#include <cstring>
#include <random>

// The leak sanitizer asks for it by this name: HDF5 forgets what it had read of a damaged description.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
namespace omentum::organ {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

class DamagedOrganTest : public HostileOrganTest {};

// HDF5 writes as many values as the attribute says that it has.
TEST_F(DamagedOrganTest, AttributesThatAreNoSingleValuesAreRefused) {
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

TEST_F(DamagedOrganTest, OffsetsOutsideOfTheFileAreRefused) {
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
TEST_F(DamagedOrganTest, DamageAnywhereIsRefusedOrHarmless) {
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
