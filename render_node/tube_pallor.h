// How a tube's wall pales where it is pressed (pallor.h).
#pragma once

#include "geometry/tube_axis.h"
#include "render_node/pallor.h"
#include "render_node/tube_item.h"

namespace omentum::render {

/// The pallor of a tube's wall at its stations, in SkinFrame's directions there: directions across are
/// carried along the axis, so that it stays with the tissue, and a frame that stands at a station takes it as
/// it is. One thread.
class TubePallor {
 public:
  /// `stations`: at rest, two or more; areas are those of the wall between them.
  TubePallor(std::span<const geometry::TubeFrame> stations, double radius_m);

  /// `dt_s` go by under these presses (Pallor::advance). `stations`: as many, as they are now. Whether any of
  /// it changed; costs nothing where no tissue is pressed or pale.
  bool advance(std::span<const Press> presses, double dt_s, std::span<const geometry::TubeFrame> stations);

  bool is_pale() const { return pale_; }
  /// Whether anything of the wall between these stations, both included, is pale.
  bool is_pale(std::size_t first, std::size_t last) const;
  /// Of the wall at a frame there, in stations from 0. Stations between `before` and `after`, the frames
  /// beside it, have none of their own: those that are not farther from here than half of the way count as
  /// well, and of all of them the palest.
  std::array<float, SkinFrame::kDirections> at(double station, double before, double after) const;

 private:
  static MeshData wall_of(std::span<const geometry::TubeFrame> stations, float radius_m);
  static void place(std::span<const geometry::TubeFrame> stations, float radius_m,
                    std::span<Vertex> vertices);

  float radius_m_;
  MeshData mesh_;      // kDirections vertices for each station
  bool pale_ = false;  // some of it is
  Pallor pallor_;
};

}  // namespace omentum::render
