#include "benchmarks/cut_patches.h"

#include "benchmarks/bench_mesh.h"
#include "geometry/surface.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::bench {

namespace {

using deform::DynamicModel;
using geometry::TetId;
using geometry::Vec3;

constexpr double kStep_s = 0.01, kSupportDepth_m = 5e-3, kReach_m = 0.03;
constexpr physics::Material kLiver{5000, 0.45, 1050};

struct Organ {
  geometry::TetraMesh mesh = bench_mesh();
  physics::MaterialMap material{kLiver};
  physics::FixedComponents fixed;
  geometry::Surface surface;

  Organ() {
    const auto by_x = [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); };
    const double low = std::ranges::min_element(mesh.positions, by_x)->x();
    for (const Vec3& p : mesh.positions)
      fixed.push_back(p.x() < low + kSupportDepth_m ? physics::kPinned : 0);
    surface = geometry::extract_surface(mesh, physics::pinned_nodes(fixed));
  }

  deform::DynamicParts parts() const {
    const deform::SteppedBody body{mesh, material, {physics::lumped_masses(mesh, material), fixed}};
    deform::DynamicParts made{.body = body, .uncut_surface = surface.node};
    made.stepper = deform::make_static_stepper(body, kStep_s);
    made.tears.resize(mesh.tetrahedra.size());
    made.is_static = true;
    return made;
  }

  Vec3 middle(std::size_t t) const {
    Vec3 sum = Vec3::Zero();
    for (const geometry::NodeId n : mesh.tetrahedra[t]) sum += mesh.positions[n] / 4;
    return sum;
  }

  // The nearest ones to a plane across the middle, from one side on: a cut that does not end in a piece.
  std::vector<std::uint8_t> line(std::size_t removals, double plane) const {
    std::vector<std::size_t> near(mesh.tetrahedra.size());
    for (std::size_t t = 0; t < near.size(); ++t) near[t] = t;
    std::ranges::sort(near, {}, [&](std::size_t t) { return std::abs(middle(t).x() - plane); });
    near.resize(std::min(2 * removals, near.size()));
    std::ranges::sort(near, {}, [&](std::size_t t) { return middle(t).y(); });
    std::vector<std::uint8_t> bits((mesh.tetrahedra.size() + 7) / 8);
    for (std::size_t i = 0; i < std::min(removals, near.size()); ++i)
      bits[near[i] / 8] = static_cast<std::uint8_t>(bits[near[i] / 8] | 1 << near[i] % 8);
    return bits;
  }
};

CutPatches::Two told(const DynamicModel& model, const std::array<Vec3, 2>& places) {
  CutPatches::Two two{deform::LocalPatch(deform::BodyStepper::kPatchNodes),
                      deform::LocalPatch(deform::BodyStepper::kPatchNodes)};
  for (std::uint32_t t = 0; t < 2; ++t)
    if (!model.local_model({t, places[t], kReach_m}, two[t]))
      throw std::runtime_error("no patch of the liver");
  return two;
}

}  // namespace

CutPatches::CutPatches(std::size_t removals) {
  const Organ organ;
  Vec3 low = organ.mesh.positions[0], high = low;
  for (const Vec3& p : organ.mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  // the surface's highest points a quarter of its length to both sides of the cut
  std::array<Vec3, 2> places;
  for (std::size_t t = 0; t < 2; ++t) {
    const double x = low.x() + (t == 0 ? 0.4 : 0.6) * (high.x() - low.x());
    const auto height = [&](geometry::NodeId n) {
      const Vec3& p = organ.mesh.positions[n];
      return std::abs(p.x() - x) < 0.1 * (high.x() - low.x()) ? p.z() : low.z();
    };
    places[t] = organ.mesh.positions[*std::ranges::max_element(organ.surface.node, {}, height)];
  }
  DynamicModel model(organ.parts());
  whole = told(model, places);
  model.take_up(organ.line(removals, (low.x() + high.x()) / 2), {}, 1);
  removed = model.status().removed_tetrahedra;
  cut = told(model, places);
}

}  // namespace omentum::bench
