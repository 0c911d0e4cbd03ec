// The map of forces, on a block whose answers are known.
#include "geometry/mesh_io/vtu_arrays.h"
#include "organ/build_organ.h"
#include "organ/support_spec.h"
#include "organ_tools/force_map/colour_scale.h"
#include "organ_tools/force_map/map_file.h"
#include "organ_tools/force_map/map_picture.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace omentum::force_map {
namespace {

using testing::DoubleNear;
using testing::Pointwise;

// A block in a bed.
organ::Organ block(double young_pa, double length_m, const test::ScratchFolder& folder) {
  geometry::TetraMesh mesh = test::make_box_mesh(12, 12, 6, {length_m, 0.12, 0.06});
  auto fixed = organ::parse_supports(std::array<std::string, 1>{"plane:z<0.001"}, mesh);
  const organ::Organ made =
      organ::make_organ("block", std::move(mesh), physics::Material{young_pa, 0.4, 1000}, std::move(fixed),
                        organ::Storage::kFloat);
  organ::build_organ(made, folder / "block.h5", {});
  return organ::load_organ(folder / "block.h5", organ::Load::kWithTensors);
}

class BlockMap : public testing::Test {
 protected:
  BlockMap() {
    for (std::size_t s = 0; s < x.size(); ++s) {
      if ((x[s] - Vec3(0.06, 0.06, 0.06)).norm() < 1e-9) top = SurfaceId(s);
    }
  }
  test::ScratchFolder folder;
  const organ::Organ organ = block(5000, 0.12, folder);
  const std::vector<Vec3> x = geometry::surface_positions(organ.mesh, organ.surface);
  SurfaceId top;
};

// Hertz's 4/3 E / (1 - nu^2) sqrt(R) d^(3/2) of a rigid ball on a half space, times what a layer of thickness
// h adds that is bonded to a rigid floor (Dimitriadis et al. 2002, Biophysical Journal 82, 2798-2810).
double force_on_layer(const Indenter& ball, double young_pa, double nu, double h) {
  const double pi = std::numbers::pi;
  const double alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double beta = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double chi = std::sqrt(ball.radius_m * ball.depth_m) / h, cubed = alpha * alpha * alpha;
  const double layer = 1 - 2 * alpha / pi * chi + std::pow(2 * alpha / pi * chi, 2) -
                       8 / std::pow(pi, 3) * (cubed + 4 * pi * pi / 15 * beta) * std::pow(chi, 3) +
                       16 * alpha / std::pow(pi, 4) * (cubed + 3 * pi * pi / 5 * beta) * std::pow(chi, 4);
  return 4.0 / 3 * young_pa / (1 - nu * nu) * std::sqrt(ball.radius_m) * std::pow(ball.depth_m, 1.5) * layer;
}

TEST_F(BlockMap, ABallOnALayerFeelsWhatTheorySays) {
  constexpr double kCoarse = 0.1;  // elements of 1 cm under a contact of 4.5 cm
  const Indenter ball{0.05, 0.01};
  const PressMap map = press_everywhere(organ, ball);
  EXPECT_GT(map.touching[top], 4);
  const double expected = force_on_layer(ball, 5000, 0.4, 0.06);
  EXPECT_NEAR(map.force_n[top], expected, kCoarse * expected);
}

TEST_F(BlockMap, StifferMaterialIsHarderByItsRatioEverywhere) {
  const Indenter ball{0.02, 0.005};
  const organ::Organ stiff = block(20000, 0.12, folder);
  const std::vector<double> ratio =
      ratio_of(stiff, press_everywhere(stiff, ball), organ, press_everywhere(organ, ball));
  int pressed = 0;
  for (const double r : ratio) {
    if (!std::isfinite(r)) continue;
    EXPECT_NEAR(r, 4, 1e-4) << "the rounding of tensors that are stored in float";
    ++pressed;
  }
  EXPECT_GT(pressed, organ.surface.mobile_count / 2);
}

TEST_F(BlockMap, WhereTheBallWouldMoveWhatIsHeldThereIsNoNumber) {
  const PressMap map = press_everywhere(organ, {0.02, 0.005});
  for (std::int32_t s = 0; s < organ.surface.node_count(); ++s) {
    const bool numbered = std::isfinite(map.force_n[s]);
    EXPECT_EQ(numbered, map.touching[s] > 0);
    EXPECT_EQ(numbered, numbered && s < organ.surface.mobile_count && map.force_n[s] > 0);
  }
  EXPECT_TRUE(std::isfinite(map.force_n[top]));
}

TEST_F(BlockMap, OrgansOfOtherSurfacesAreNotCompared) {
  const organ::Organ other = block(5000, 0.13, folder);
  EXPECT_THROW(ratio_of(organ, press_everywhere(organ, {}), other, press_everywhere(other, {})),
               geometry::InputError);
}

// A cone of values over the block's top: half of its height lies half of its radius away.
TEST_F(BlockMap, APeaksSizeIsThatOfItsUpperHalf) {
  constexpr double kRadius = 0.05;
  std::vector<double> values;
  for (const Vec3& p : x) {
    const double off = std::hypot(p.x() - 0.06, p.y() - 0.06);
    values.push_back(p.z() > 0.06 - 1e-9 ? 1 + std::max(0.0, 1 - off / kRadius) : std::nan(""));
  }
  const auto peak = peak_of(organ, values, 1);
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->node, top);
  EXPECT_EQ(peak->value, 2);
  EXPECT_NEAR(peak->diameter_m(), kRadius, 0.1 * kRadius) << "interpolated over edges of a fifth of it";
}

TEST_F(BlockMap, TheFileHoldsPointsTrianglesAndValues) {
  std::vector<double> values(x.size(), 2.5);
  values.back() = std::nan("");
  write_map(folder / "m.vtu", organ, std::array{MapArray{"force_n", values}});
  const geometry::VtuArrays arrays(folder / "m.vtu");
  const pugi::xml_node piece = arrays.root().child("UnstructuredGrid").child("Piece");
  const auto array = [](pugi::xml_node node, const char* name) {
    return node.find_child_by_attribute("DataArray", "Name", name);
  };
  EXPECT_EQ(arrays.reals(piece.child("Points").child("DataArray")).size(), 3 * x.size());
  EXPECT_EQ(arrays.integers(array(piece.child("Cells"), "connectivity")).size(),
            3 * organ.surface.triangles.size());
  const std::vector<double> found = arrays.reals(array(piece.child("PointData"), "force_n"));
  ASSERT_EQ(found.size(), x.size());
  EXPECT_EQ(found.front(), 2.5);
  EXPECT_TRUE(std::isnan(found.back()));
  EXPECT_EQ(arrays.integers(array(piece.child("PointData"), "node_number")).size(), x.size());
}

TEST_F(BlockMap, ThePictureShowsTheOrganInItsColours) {
  std::vector<double> values;
  for (const Vec3& p : x) values.push_back(p.x() < 0.0599 ? 0 : 1);
  PictureOptions options;
  options.width = 400, options.height = 300;
  const Canvas canvas = draw_map(organ, values, options);
  EXPECT_EQ(canvas.rgba().size(), 4u * 400 * 300);
  const auto leftmost = [&](Colour wanted) {
    for (int column = 0; column < 250; ++column) {
      const Colour& found = canvas.at(column, 150);
      const float off = std::abs(found.red - wanted.red) + std::abs(found.green - wanted.green) +
                        std::abs(found.blue - wanted.blue);
      if (off < 0.05f) return column;
    }
    return -1;
  };
  const int low = leftmost(ColourScale{0, 1}.of(0)), high = leftmost(ColourScale{0, 1}.of(1));
  EXPECT_GT(low, 0);
  EXPECT_GT(high, low + 20) << "from above, x goes to the right";
}

TEST(ColourScaleTest, TicksAreRoundAndWithin) {
  EXPECT_THAT((ColourScale{0, 0.62}.ticks()),
              Pointwise(DoubleNear(1e-12), {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
  EXPECT_THAT((ColourScale{1, 1.65}.ticks()),
              Pointwise(DoubleNear(1e-12), {1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6}));
  EXPECT_THAT((ColourScale{2, 2}.ticks()), testing::ElementsAre(2));
}

}  // namespace
}  // namespace omentum::force_map
