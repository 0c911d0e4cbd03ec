#include "physics/intestine/gut_band.h"

#include "tests/physics/intestine/gut_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace omentum::physics {
namespace {

using geometry::MassId;

// A over all masses, from the springs one by one.
Eigen::MatrixXd whole_matrix(const GutSprings& springs, double step_s) {
  const auto n = static_cast<Eigen::Index>(springs.mass().size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  const double damped = 1 + springs.damping_s() / step_s;
  for (const auto& family : springs.families()) {
    for (Eigen::Index a = 0; a + family.offset < n; ++a) {
      Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
      d[a] = 1;
      d[a + family.offset] = -1;
      A += damped * family.stiffness_n_m[static_cast<std::size_t>(a)] * d * d.transpose();
    }
  }
  for (Eigen::Index c = 1; c + 1 < springs.layout().columns; ++c) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
    d[c - 1] = d[c + 1] = 0.5;
    d[c] = -1;
    A += damped * springs.bends().stiffness_n_m[static_cast<std::size_t>(c)] * d * d.transpose();
  }
  const double inertia = (1 + step_s * springs.drag_per_s()) / (step_s * step_s);
  for (Eigen::Index i = 0; i < n; ++i) A(i, i) += inertia * springs.mass()[static_cast<std::size_t>(i)];
  return A;
}

TEST(GutBand, SolvesWhatADenseFactorSolves) {
  for (const geometry::GutLayout layout :
       {geometry::GutLayout{4, 20}, geometry::GutLayout{2, 9}, geometry::GutLayout{5, 4}}) {
    const GutSprings springs(test::curtain(layout), {});
    const GutBand band(springs, 5e-3);
    const Eigen::MatrixXd A = whole_matrix(springs, 5e-3);
    const auto n = static_cast<Eigen::Index>(band.size());
    Eigen::MatrixXd free(n, n);
    const auto mass = [&](Eigen::Index i) -> Eigen::Index { return band.mass(static_cast<std::size_t>(i)); };
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) free(i, j) = A(mass(i), mass(j));
    }
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, 4);
    std::vector<GutBand::Node> x(band.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) x[static_cast<std::size_t>(i)].v[k] = b(i, k);
    }
    band.solve(x.data());
    const std::vector<double> own = band.diagonal_of_inverse();
    const Eigen::VectorXd inverse = free.inverse().diagonal();
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(own.data(), n) - inverse).norm(), 1e-12 * inverse.norm());
    const Eigen::MatrixXd expected = free.llt().solve(b);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(x[static_cast<std::size_t>(i)].v[k], expected(i, k),
                    1e-12 * expected.cwiseAbs().maxCoeff());
      }
    }
  }
}

TEST(GutBand, PlacesAndMassesAnswerEachOther) {
  const GutSprings springs(test::curtain({4, 20}), {});
  const GutBand band(springs, 5e-3);
  EXPECT_EQ(band.size(), 3u * 18u);
  for (std::size_t place = 0; place < band.size(); ++place) {
    EXPECT_EQ(band.place(band.mass(place)), place);
    EXPECT_FALSE(springs.layout().is_held(band.mass(place)));
  }
}

}  // namespace
}  // namespace omentum::physics
