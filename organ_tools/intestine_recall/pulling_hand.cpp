#include "organ_tools/intestine_recall/pulling_hand.h"

#include <algorithm>
#include <cmath>

namespace omentum::intestine_recall {
namespace {

using geometry::Vec3;

constexpr double kPull_s = 2.0, kRound_s = 3.0;  // holding, of holding and waiting
constexpr double kSpeed_m_s = 0.25;              // of the target
constexpr double kStiffness_n_m = 100;           // of the grip
constexpr double kStrongest_n = 8;               // more tears a bowel

Eigen::AlignedBox3d box_around(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

}  // namespace

PullingHand::PullingHand(const geometry::GutShape& gut, std::uint64_t seed)
    : layout_(gut.layout),
      around_(box_around(gut.positions)),
      random_(seed),
      forces_(gut.positions.size(), Vec3::Zero()),
      since_s_(kRound_s) {}

// The standard's distributions are not the same everywhere.
double PullingHand::random(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

void PullingHand::take(std::span<const Vec3> x) {
  held_ = layout_.mass(0, static_cast<std::int32_t>(random(2, layout_.columns - 2)));
  target_ = x[static_cast<std::size_t>(held_)];
  for (int i = 0; i < 3; ++i) goal_[i] = random(around_.min()[i], around_.max()[i]);
}

std::span<const Vec3> PullingHand::pull(std::span<const Vec3> x, double step_s) {
  since_s_ += step_s;
  if (since_s_ >= kRound_s) {
    since_s_ = 0;
    take(x);
  }
  std::ranges::fill(forces_, Vec3::Zero());
  if (since_s_ > kPull_s) return forces_;
  const Vec3 way = goal_ - target_;
  target_ += way * std::min(1.0, kSpeed_m_s * step_s / std::max(way.norm(), 1e-9));
  const Vec3 force = kStiffness_n_m * (target_ - x[static_cast<std::size_t>(held_)]);
  forces_[static_cast<std::size_t>(held_)] =
      force * std::min(1.0, kStrongest_n / std::max(force.norm(), 1e-9));
  return forces_;
}

}  // namespace omentum::intestine_recall
