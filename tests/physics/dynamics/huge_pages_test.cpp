#include "physics/dynamics/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace omentum::physics {
namespace {

TEST(HugePagesTest, VectorsOfAnySizeAreOnCacheLines) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20}) {
    std::vector<double, HugePages<double>> values(count, 3.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % 64, 0U) << count;
    const std::vector<double, HugePages<double>> copy = values;
    EXPECT_EQ(copy, values);
  }
}

TEST(HugePagesTest, MoreThanThereIsIsRefused) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
  EXPECT_THROW(take_pages(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

}  // namespace
}  // namespace omentum::physics
