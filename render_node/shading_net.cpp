#include "render_node/shading_net.h"

#include "geometry/precondition.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

using Four = Eigen::Vector4f;
using Links = std::vector<std::vector<std::int32_t>>;

void fill_fours(std::span<const Vec3f> points, std::span<Four> fours) {
  for (std::size_t s = 0; s < points.size(); ++s) fours[s] << points[s], 0.0f;
}

Links triangles_around(std::span<const geometry::Triangle> triangles, std::size_t node_count) {
  Links around(node_count);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const auto corner : triangles[t])
      around[static_cast<std::size_t>(corner)].push_back(static_cast<std::int32_t>(t));
  return around;
}

// As often as openness_of() meets them: twice over an edge inside of the surface, once at its rim. Where all
// are met twice, once is the same. A node without neighbours has itself: it stays.
Links nodes_beside(std::span<const geometry::Triangle> triangles, std::size_t node_count) {
  Links beside(node_count);
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [at, one, other] : {std::array{a, b, c}, {b, c, a}, {c, a, b}})
      beside[static_cast<std::size_t>(at)].insert(beside[static_cast<std::size_t>(at)].end(), {one, other});
  }
  for (std::size_t s = 0; s < node_count; ++s) {
    std::vector<std::int32_t>& met = beside[s];
    std::ranges::sort(met);
    std::vector<std::int32_t> once = met;
    once.erase(std::unique(once.begin(), once.end()), once.end());
    const auto twice = [&](std::int32_t other) { return std::ranges::count(met, other) == 2; };
    if (std::ranges::all_of(once, twice)) met = std::move(once);
    if (met.empty()) met.push_back(static_cast<std::int32_t>(s));
  }
  return beside;
}

// a of s coth(a/2) = 2 k; none where s is too few to spread so far.
double rate_of(int s, int k) {
  return 2 * std::atanh(static_cast<double>(s) / (2 * k));
}

}  // namespace

ShadingNet::ShadingNet(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> rest,
                       float horizon_m)
    : triangles_(triangles.begin(), triangles.end()),
      horizon_m_(horizon_m),
      around_(triangles_around(triangles, rest.size())),
      beside_(nodes_beside(triangles, rest.size())),
      areas_(triangles.size()),
      now_(rest.size()),
      before_(rest.size()) {
  plan_steps(diffusion_steps(triangles, rest, horizon_m));
}

// Three terms, each divided by its T_j(w_0): T_j(cosh a) = cosh(j a).
void ShadingNet::plan_steps(int diffusions) {
  int s = 1;
  while (s < diffusions && std::cosh(s * rate_of(s, diffusions)) < 1 / kRipple) ++s;
  if (s >= diffusions) {
    steps_.assign(static_cast<std::size_t>(diffusions), {1, 0, 0});
    return;
  }
  const double a = rate_of(s, diffusions), w_0 = std::cosh(a), w_1 = (1 + w_0) / 2;
  for (int j = 0; j < s; ++j) {
    const double next = std::cosh((j + 1) * a);
    const double by = (j == 0 ? 1 : 2) * std::cosh(j * a) / next;
    const double old = j == 0 ? 0 : std::cosh((j - 1) * a) / next;
    steps_.push_back(
        {static_cast<float>(by * w_1), static_cast<float>(by * (w_0 - w_1)), static_cast<float>(old)});
  }
}

void ShadingNet::find_normals(std::span<const Vec3f> positions, std::span<Vec3f> normals) {
  geometry::require(positions.size() == now_.size() && normals.size() == now_.size(),
                    "as many nodes as at rest");
  fill_fours(positions, now_);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    areas_[t] = (now_[b] - now_[a]).cross3(now_[c] - now_[a]);
  }
  around_.each([&](std::size_t s, std::span<const std::int32_t> triangles) {
    Four sum = Four::Zero();
    for (const std::int32_t t : triangles) sum += areas_[static_cast<std::size_t>(t)];
    const float length = sum.norm();
    if (length > 0) normals[s] = sum.head<3>() / length;
  });
}

void ShadingNet::average(const Step& step) {
  beside_.each([&](std::size_t s, std::span<const std::int32_t> others) {
    Four sum = now_[static_cast<std::size_t>(others.front())];
    for (const std::int32_t other : others.subspan(1)) sum += now_[static_cast<std::size_t>(other)];
    before_[s] =
        step.mean / static_cast<float>(others.size()) * sum + step.own * now_[s] - step.old * before_[s];
  });
  now_.swap(before_);
}

void ShadingNet::find_openness(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                               std::span<float> openness) {
  geometry::require(positions.size() == now_.size() && openness.size() == now_.size(),
                    "as many nodes as at rest");
  fill_fours(positions, now_);
  std::ranges::fill(before_, Four::Zero());
  for (const Step& step : steps_) average(step);
  for (std::size_t s = 0; s < openness.size(); ++s)
    openness[s] = openness_below(normals[s].dot(now_[s].head<3>() - positions[s]), horizon_m_);
}

}  // namespace omentum::render
