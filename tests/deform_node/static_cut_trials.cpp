#include "tests/deform_node/static_cut_trials.h"

#include "tests/deform_node/cut_trials.h"
#include "tests/deform_node/rates.h"

#include <algorithm>

namespace omentum::deform {

namespace {

constexpr physics::Material kTissue{.young_pa = 6000, .poisson = 0.45, .density_kg_m3 = 1000};

}  // namespace

HeldOrgan::HeldOrgan(geometry::TetraMesh of, double depth_m) : mesh(std::move(of)), material(kTissue) {
  double low = mesh.positions[0].x();
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x());
  for (const Vec3& p : mesh.positions) fixed.push_back(p.x() <= low + depth_m ? physics::kPinned : 0);
  surface = geometry::extract_surface(mesh, physics::pinned_nodes(fixed));
}

DynamicParts HeldOrgan::parts() const {
  const SteppedBody body{mesh, material, {.mass = physics::lumped_masses(mesh, material), .fixed = fixed}};
  return {.body = body,
          .uncut_surface = surface.node,
          .stepper = make_static_stepper(body, kTick_s),
          .tears = std::vector<physics::TearLimits>(mesh.tetrahedra.size()),
          .cut_delay_s = 0,
          .cut_rate_per_s = 1e6,
          .is_static = true};
}

DynamicParts falling_parts_of(const HeldOrgan& organ) {
  DynamicParts parts = organ.parts();
  parts.stepper = make_static_stepper(parts.body, kTick_s, LoosePieces::kFall);
  parts.piece_gravity_m_s2 = Vec3(0, 0, -9.81);
  return parts;
}

std::string try_falling_cuts(const HeldOrgan& organ, std::uint32_t seed, int ticks) {
  TriedOrgan tried{.mesh = organ.mesh,
                   .fixed = organ.fixed,
                   .make = [&] { return std::make_unique<DynamicModel>(falling_parts_of(organ)); },
                   .places = {},
                   .turns = true};
  for (std::size_t n = 0; n < organ.mesh.positions.size(); ++n) tried.places.emplace_back(n);
  return try_cuts(tried, seed, ticks);
}

std::string try_static_cuts(const HeldOrgan& organ, std::uint32_t seed, int ticks) {
  TriedOrgan tried{.mesh = organ.mesh,
                   .fixed = organ.fixed,
                   .make = [&] { return std::make_unique<DynamicModel>(organ.parts()); },
                   .places = {},
                   .is_static = true};
  for (std::size_t n = 0; n < organ.mesh.positions.size(); ++n) tried.places.emplace_back(n);
  return try_cuts(tried, seed, ticks);
}

}  // namespace omentum::deform
