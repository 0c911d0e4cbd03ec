#include "physics/dynamics/element_root.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

TEST(ElementRootTest, ItsSquareIsTheElementsStiffness) {
  const Corners corners{Vec3(0.01, 0.02, 0), Vec3(0.05, 0.01, 0.01), Vec3(0.02, 0.06, 0.01),
                        Vec3(0.02, 0.02, 0.05)};
  for (const double poisson : {-0.3, 0.0, 0.3, 0.49}) {
    const Material material{4000, poisson, 1000};
    const ElementTensors K = element_tensors(corners, material);
    const ElementRoot W = element_root(corners, material);
    const Eigen::Matrix<double, 12, 12> square = W * W.transpose();
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k)
        EXPECT_LE((square.block<3, 3>(3 * j, 3 * k) - K[j][k]).norm(), 1e-14 * square.norm()) << poisson;
    }
  }
}

}  // namespace
}  // namespace omentum::physics
