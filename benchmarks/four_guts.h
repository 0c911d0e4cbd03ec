// Four guts in one cavity, side by side, that meet one another.
#pragma once

#include "deform_node/gut_model.h"
#include "deform_node/organ_collision.h"
#include "runtime/crew.h"

#include <memory>
#include <vector>

namespace omentum::bench {

/// As deform_node moves the organs of a scene. They begin just clear of each other, fall into a box that has
/// room for all four, and lie against each other there.
class FourGuts {
 public:
  static constexpr double kTick_s = 0.01;  // deform_node's

  /// `threads` step them, the calling one counted.
  FourGuts(const geometry::GutShape& shape, const physics::GutStepSettings& step, std::size_t threads);

  void tick() noexcept;

  /// All masses' places, gut after gut, in W, m.
  std::vector<std::vector<geometry::Vec3>> places() const;
  /// Pairs of guts that touch: places of one axis nearer than two radii to the other's.
  std::int64_t touching() const;
  /// Times that something of one gut passed through something of another between two ticks.
  std::int64_t crossings(const std::vector<std::vector<geometry::Vec3>>& from,
                         const std::vector<std::vector<geometry::Vec3>>& to) const;
  bool diverged() const;

 private:
  std::vector<deform::OrganModel*> models() const;

  std::vector<std::unique_ptr<deform::GutModel>> guts_;
  physics::GutParts parts_;  // of each
  runtime::Crew crew_;
  deform::OrganCollision collision_;
};

}  // namespace omentum::bench
