// Balls that meet an intestine: probes, and spheres of other organs.
#pragma once

#include "physics/intestine/gut_obstacle.h"
#include "physics/intestine/pair_finder.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// Where balls are near parts of a gut. A ball's centre is one more mass behind those of the gut, so that
/// response and bound treat it like any other. No allocation after construction.
class GutSpheres {
 public:
  explicit GutSpheres(const GutParts& parts);

  /// Takes in where the gut is: `x`, [masses], m.
  void look_at(std::span<const geometry::Vec3> x) noexcept;

  /// Lowers `gap` ([masses + spheres], m) to the distance of each ball's centre from each part near its way;
  /// x is that of the newest look.
  void lower_gaps(std::span<const geometry::Vec3> x, std::span<const MovingSphere> spheres,
                  std::span<double> gap) const noexcept;

  /// Adds the contacts of a ball with `radius_m`, mass `sphere`, whose centre is there now, with their keys
  /// {key, part}: parts nearer than their reach and `skin_m`, up to `most` contacts in all. Returns how many
  /// found no room.
  std::int64_t add_contacts(std::span<const geometry::Vec3> x, const geometry::Vec3& centre, double radius_m,
                            geometry::MassId sphere, std::int32_t key, double skin_m, std::size_t most,
                            std::vector<GutContact>& contacts, std::vector<ContactKey>& keys) const noexcept;

 private:
  GutParts parts_;
  std::vector<double> x_, y_, z_, radius_;  // [parts], m: balls around the parts
  double reach_m(std::int32_t part) const { return parts_.reach_m(part) - parts_.reach.tube_m / 2; }
};

}  // namespace omentum::physics
