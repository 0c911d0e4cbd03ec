#include "physics/dynamics/tensor_books.h"

#include "tests/physics/dynamics/tensor_tissue.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace omentum::physics {
namespace {

constexpr double kRestored = 1e-12;  // relative: what a thousand additions and subtractions may leave

// The largest difference of two tensors at one place, relative to the largest tensor.
double difference(const TensorBooks& a, const TensorBooks& b) {
  double largest = 0, size = 0;
  for (std::size_t n = 0; n < a.node_count(); ++n) {
    const NodeId id(n);
    largest = std::max(largest, (a.vertex(id) - b.vertex(id)).norm());
    size = std::max(size, b.vertex(id).norm());
  }
  for (std::size_t e = 0; e < a.edges().size(); ++e)
    largest = std::max(largest, (a.edge(e) - b.edge(e)).norm());
  return largest / size;
}

class TensorBooksTest : public testing::Test {
 protected:
  const geometry::TetraMesh mesh = test::make_box_mesh(4, 3, 5, {0.04, 0.03, 0.05});
  const TensorBooks untouched{mesh, kMaterial};
  TensorBooks books{mesh, kMaterial};
};

TEST_F(TensorBooksTest, AddAfterRemoveRestoresEveryTensor) {
  std::mt19937 generator(11);
  std::vector<bool> gone(mesh.tetrahedra.size(), false);
  for (int change = 0; change < 20'000; ++change) {
    const std::size_t t = generator() % gone.size();
    gone[t] ? books.add(geometry::TetId(t)) : books.remove(geometry::TetId(t));
    gone[t] = !gone[t];
  }
  for (std::size_t t = 0; t < gone.size(); ++t)
    if (gone[t]) books.add(geometry::TetId(t));
  EXPECT_LE(difference(books, untouched), kRestored);
}

TEST_F(TensorBooksTest, RemovalGivesBooksOfMeshThatIsLeft) {
  geometry::TetraMesh left = mesh;
  left.tetrahedra.clear();
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (t % 4 == 0) {
      books.remove(geometry::TetId(t));
    } else {
      left.tetrahedra.push_back(mesh.tetrahedra[t]);
    }
  }
  const TensorBooks rebuilt(left, kMaterial);
  for (std::size_t n = 0; n < books.node_count(); ++n) {
    const NodeId id(n);
    EXPECT_LE((books.vertex(id) - rebuilt.vertex(id)).norm(), kRestored * untouched.vertex(id).norm());
  }
  std::size_t e = 0;
  for (std::size_t r = 0; r < rebuilt.edges().size(); ++r, ++e) {
    // edges that lost their last tetrahedron are in the old books only, with nothing in them
    for (; books.edges()[e].a != rebuilt.edges()[r].a || books.edges()[e].b != rebuilt.edges()[r].b; ++e)
      EXPECT_EQ(books.edge(e).norm(), 0);
    EXPECT_LE((books.edge(e) - rebuilt.edge(r)).norm(), kRestored * untouched.edge(e).norm());
  }
}

TEST_F(TensorBooksTest, LastTetrahedronLeavesExactlyNothing) {
  std::vector<std::size_t> order(mesh.tetrahedra.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, std::mt19937(3));
  for (const std::size_t t : order) books.remove(geometry::TetId(t));
  for (std::size_t n = 0; n < books.node_count(); ++n) EXPECT_EQ(books.vertex(NodeId(n)).norm(), 0);
  for (std::size_t e = 0; e < books.edges().size(); ++e) EXPECT_EQ(books.edge(e).norm(), 0);
}

TEST_F(TensorBooksTest, RowsAddUpToNothing) {
  std::vector<Eigen::Matrix3d> rows(books.node_count());
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n] = books.vertex(NodeId(n));
  for (std::size_t e = 0; e < books.edges().size(); ++e) {
    rows[books.edges()[e].a] += books.edge(e);
    rows[books.edges()[e].b] += books.edge(e).transpose();
  }
  for (std::size_t n = 0; n < rows.size(); ++n)
    EXPECT_LE(rows[n].norm(), kRestored * books.vertex(NodeId(n)).norm());
}

TEST_F(TensorBooksTest, EachTetrahedronIsOfItsRegionsMaterial) {
  geometry::TetraMesh labelled = mesh;
  labelled.regions.assign(mesh.tetrahedra.size(), 0);
  labelled.regions[7] = 1;
  const MaterialMap mixed{kMaterial, {{1, Material{50'000, 0.1, 1000}}}};
  TensorBooks stiffened(labelled, mixed);
  stiffened.remove(geometry::TetId(7));
  books.remove(geometry::TetId(7));
  EXPECT_LE(difference(stiffened, books), kRestored);
}

class TensorBooksOfRealMeshes : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Data, TensorBooksOfRealMeshes,
                         testing::Values("tet/openhelp_liver_7k.msh", "tet/sofa_liver.msh",
                                         "tet/sofaenv_gallbladder.vtk"));

// Slivers come and go: what they leave behind is measured by what was there with them.
TEST_P(TensorBooksOfRealMeshes, LongCutsLeaveBooksOfMeshThatIsLeft) {
  const std::filesystem::path file = test::data_file(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const geometry::TetraMesh mesh = geometry::check_mesh(geometry::read_mesh(file), 1e-3).mesh;
  const TensorBooks untouched(mesh, kMaterial);
  TensorBooks books(mesh, kMaterial);
  std::mt19937 generator(6);
  std::vector<bool> gone(mesh.tetrahedra.size(), false);
  for (std::size_t change = 0; change < 20 * gone.size(); ++change) {
    const std::size_t t = generator() % gone.size();
    gone[t] ? books.add(geometry::TetId(t)) : books.remove(geometry::TetId(t));
    gone[t] = !gone[t];
  }
  geometry::TetraMesh left = mesh;
  left.tetrahedra.clear();
  for (std::size_t t = 0; t < gone.size(); ++t)
    if (!gone[t]) left.tetrahedra.push_back(mesh.tetrahedra[t]);
  const TensorBooks rebuilt(left, kMaterial);
  for (std::size_t n = 0; n < books.node_count(); ++n) {
    const NodeId id(n);
    EXPECT_LE((books.vertex(id) - rebuilt.vertex(id)).norm(), kRestored * untouched.vertex(id).norm());
  }
}

}  // namespace
}  // namespace omentum::physics
