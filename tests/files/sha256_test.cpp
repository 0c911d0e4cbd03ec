#include "files/sha256.h"

#include <gtest/gtest.h>

namespace omentum::files {
namespace {

// FIPS 180-4, examples of one block.
TEST(Sha256, IsTheStandards) {
  EXPECT_EQ(Sha256().hexadecimal(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 sha;
  sha.add("a", 1);
  sha.add("bc", 2);
  EXPECT_EQ(sha.hexadecimal(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace omentum::files
