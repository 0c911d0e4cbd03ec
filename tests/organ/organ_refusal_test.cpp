// Files that are no organ files any more, or never were.
#include "organ_file_fixture.h"

#include <fstream>

namespace omentum::organ {
namespace {

using testing::HasSubstr;

TEST_F(OrganFileTest, MissingFileIsRefused) {
  EXPECT_THAT(refusal(), HasSubstr("no such file"));
}

TEST_F(OrganFileTest, GarbageAndEmptyFilesAreRefused) {
  std::ofstream(file) << "node,ux,uy,uz\n";
  EXPECT_THAT(refusal(), HasSubstr("HDF5"));
  std::ofstream(file, std::ios::trunc).flush();
  EXPECT_THAT(refusal(), HasSubstr("HDF5"));
}

TEST_F(OrganFileTest, AnyTruncationIsRefused) {
  build(small_organ());
  const auto whole = std::filesystem::file_size(file);
  for (const double part : {0.99, 0.7, 0.3, 0.01}) {
    std::filesystem::resize_file(file, static_cast<std::uintmax_t>(part * static_cast<double>(whole)));
    EXPECT_NE(refusal(), "accepted") << part;
  }
}

TEST_F(OrganFileTest, UnfinishedFileIsRefused) {
  build(small_organ());
  damage([](hid_t hdf5) { H5Adelete(hdf5, layout::kFinished); });
  EXPECT_THAT(refusal(), HasSubstr("unfinished"));
}

TEST_F(OrganFileTest, OtherVersionIsRefused) {
  build(small_organ());
  damage([](hid_t hdf5) {
    const double other = kFormatVersion + 1;
    const hid_t version = H5Aopen(hdf5, layout::kVersion, H5P_DEFAULT);
    H5Awrite(version, H5T_NATIVE_DOUBLE, &other);
    H5Aclose(version);
  });
  EXPECT_THAT(refusal(), HasSubstr("version " + std::to_string(kFormatVersion + 1) + "; expected " +
                                   std::to_string(kFormatVersion)));
}

TEST_F(OrganFileTest, ChangedMaterialIsNotServedFromOldTensors) {
  build(small_organ());
  damage([](hid_t hdf5) {
    const double other = 9999;
    const hid_t young = H5Aopen(hdf5, layout::kYoung, H5P_DEFAULT);
    H5Awrite(young, H5T_NATIVE_DOUBLE, &other);
    H5Aclose(young);
  });
  EXPECT_THAT(refusal(), HasSubstr("hash"));
}

TEST_F(OrganFileTest, AShapeLargerThanTheFileIsRefusedAndBuiltAnew) {
  build(small_organ());
  damage([](hid_t hdf5) {
    H5Ldelete(hdf5, layout::kPositions, H5P_DEFAULT);
    const hsize_t shape[] = {hsize_t{1} << 40, 3};
    const hid_t space = H5Screate_simple(2, shape, nullptr), storage = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_alloc_time(storage, H5D_ALLOC_TIME_LATE);  // claimed, not there
    H5Dclose(
        H5Dcreate2(hdf5, layout::kPositions, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, storage, H5P_DEFAULT));
    H5Pclose(storage);
    H5Sclose(space);
  });
  EXPECT_THAT(refusal(), HasSubstr("more than the file holds"));
  EXPECT_FALSE(is_up_to_date(file, small_organ()));
}

TEST_F(OrganFileTest, AnotherKindOfHdf5FileIsRefused) {
  H5Fclose(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_THAT(refusal(), HasSubstr("no organ file"));
}

}  // namespace
}  // namespace omentum::organ
