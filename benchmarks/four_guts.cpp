#include "benchmarks/four_guts.h"

#include "physics/intestine/gut_crossings.h"

#include <algorithm>

namespace omentum::bench {

using geometry::MassId;
using geometry::Vec3;
using physics::edges_meet;
using physics::point_meets_triangle;

namespace {

constexpr double kFeltStep_s = 0.01;  // as deform_node's
constexpr double kClear_m = 5e-3;     // between the guts' surfaces at the start
constexpr double kBelow_m = 5e-3;     // from the lowest of them to the floor

using Places = std::vector<std::vector<Vec3>>;

Eigen::AlignedBox3d box_of(const geometry::GutShape& shape) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : shape.positions) box.extend(x);
  return {box.min().array() - shape.tube_radius_m, box.max().array() + shape.tube_radius_m};
}

// Two by two, about the middle of the four.
geometry::GutShape moved(const geometry::GutShape& shape, int place) {
  const Vec3 apart = box_of(shape).sizes() + Vec3::Constant(kClear_m);
  geometry::GutShape at = shape;
  const Vec3 way((place % 2 - 0.5) * apart.x(), (place / 2 - 0.5) * apart.y(), 0);
  for (Vec3& x : at.positions) x += way;
  return at;
}

physics::GutObstacle cavity_of(const geometry::GutShape& shape) {
  const Eigen::AlignedBox3d box = box_of(shape);
  const Vec3 half(box.sizes().x() + kClear_m, box.sizes().y() + kClear_m, box.sizes().z());
  return {.kind = physics::GutObstacle::Kind::kInsideBox,
          .centre = Vec3(box.center().x(), box.center().y(), box.min().z() - kBelow_m + half.z()),
          .half_axes_m = half};
}

std::unique_ptr<deform::GutModel> gut_at(int place, const geometry::GutShape& shape,
                                         const physics::GutStepSettings& step) {
  const geometry::GutShape own = moved(shape, place);
  physics::GutStepSettings felt = step;
  felt.step_s = std::max(step.step_s, kFeltStep_s);
  const auto make = [&](const physics::GutStepSettings& settings) {
    return std::make_unique<physics::GutSystem>(own, physics::GutMaterial{}, physics::GutCollisionSettings{},
                                                settings);
  };
  deform::GutPhysics physics{.system = make(step), .felt = make(felt), .obstacles = {cavity_of(shape)}};
  return std::make_unique<deform::GutModel>(std::move(physics));
}

std::vector<std::unique_ptr<deform::GutModel>> four_of(const geometry::GutShape& shape,
                                                       const physics::GutStepSettings& step) {
  std::vector<std::unique_ptr<deform::GutModel>> guts;
  for (int place = 0; place < 4; ++place) guts.push_back(gut_at(place, shape, step));
  return guts;
}

// A segment or a triangle on its way.
struct Moving {
  std::array<physics::Way, 3> corners;
  bool is_segment;
  Eigen::AlignedBox3d box;
};

Moving moving(const physics::GutParts& parts, std::int32_t part, std::span<const Vec3> from,
              std::span<const Vec3> to) {
  Moving way{.corners = {}, .is_segment = parts.is_segment(part), .box = {}};
  for (std::size_t k = 0; k < (way.is_segment ? 2U : 3U); ++k) {
    const MassId m = parts.masses[static_cast<std::size_t>(part)][k];
    way.corners[k] = {from[m], to[m]};
    way.box.extend(from[m]).extend(to[m]);
  }
  return way;
}

bool meet(const Moving& segment, const Moving& part) {
  const auto& [p, q, none] = segment.corners;
  const auto& [a, b, c] = part.corners;
  if (edges_meet(p, q, a, b)) return true;
  return !part.is_segment && (edges_meet(p, q, b, c) || edges_meet(p, q, c, a) ||
                              point_meets_triangle(p, a, b, c) || point_meets_triangle(q, a, b, c));
}

// Of one gut's segments with the other's triangles, and with its segments where that is asked for.
std::int64_t crossings_of(const std::vector<Moving>& one, const std::vector<Moving>& other, bool segments) {
  std::int64_t crossings = 0;
  for (const Moving& segment : one) {
    if (!segment.is_segment) continue;
    for (const Moving& part : other)
      crossings += (segments || !part.is_segment) && segment.box.intersects(part.box) && meet(segment, part);
  }
  return crossings;
}

}  // namespace

FourGuts::FourGuts(const geometry::GutShape& shape, const physics::GutStepSettings& step, std::size_t threads)
    : guts_(four_of(shape, step)), parts_(shape), crew_(threads - 1), collision_(models(), &crew_) {}

std::vector<deform::OrganModel*> FourGuts::models() const {
  std::vector<deform::OrganModel*> models;
  for (const auto& gut : guts_) models.push_back(gut.get());
  return models;
}

void FourGuts::tick() noexcept {
  crew_.share(guts_.size(), [this](std::size_t i) { guts_[i]->step({}, kTick_s); });
  (void)collision_.run();  // what has no room is the next tick's
}

Places FourGuts::places() const {
  Places all;
  for (const auto& gut : guts_) {
    const std::span<const float> values = gut->view().values;
    std::vector<Vec3>& x = all.emplace_back();
    for (std::size_t i = 0; i < values.size(); i += 3)
      x.emplace_back(values[i], values[i + 1], values[i + 2]);
  }
  return all;
}

std::int64_t FourGuts::touching() const {
  const Places at = places();
  const auto axis = static_cast<std::size_t>(parts_.gut.columns);
  const double near_m = parts_.reach.tube_m;
  std::int64_t touching = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      touching += std::ranges::any_of(std::span(at[i]).first(axis),
                                      [&](const Vec3& p) {
                                        return std::ranges::any_of(
                                            std::span(at[j]).first(axis),
                                            [&](const Vec3& q) { return (p - q).norm() < near_m; });
                                      })
                      ? 1
                      : 0;
  return touching;
}

std::int64_t FourGuts::crossings(const Places& from, const Places& to) const {
  std::vector<std::vector<Moving>> all(guts_.size());
  for (std::size_t i = 0; i < guts_.size(); ++i)
    for (std::int32_t part = 0; part < parts_.count(); ++part)
      all[i].push_back(moving(parts_, part, from[i], to[i]));
  std::int64_t crossings = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j)
      if (i != j) crossings += crossings_of(all[i], all[j], i < j);
  return crossings;
}

bool FourGuts::diverged() const {
  return std::ranges::any_of(guts_, [](const auto& gut) { return gut->status().diverged; });
}

}  // namespace omentum::bench
