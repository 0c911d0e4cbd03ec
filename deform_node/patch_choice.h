// Which faces and nodes of a surface make the patch around a place.
#pragma once

#include "deform_node/local_patch.h"
#include "geometry/closest_points.h"

#include <algorithm>
#include <span>
#include <vector>

namespace omentum::deform {

/// Picks the faces that a tool holds, and those that come near its place, the nearest first, as long as their
/// nodes fit, and every other face between those nodes. Takes its memory when it is made; one thread at a
/// time.
class PatchChoice {
 public:
  /// Of a surface with so many nodes and at most so many faces. `most_nodes`: at least three, at most 256
  /// (LocalPatch::triangles has bytes).
  PatchChoice(std::size_t node_count, std::size_t most_faces, std::size_t most_nodes)
      : most_nodes_(most_nodes), number_of_(node_count, kNone) {
    near_.reserve(most_faces);
    nodes_.reserve(most_nodes);
  }

  /// Writes both counts and the triangles into `patch`, not its nodes; false where no face is held or
  /// within the place's radius. `faces`: count(), corners(f), the three NodeIds of a face, and place(n), of a
  /// node in W, m; is_one(f): false, it is no place to touch.
  template <class Faces>
  bool choose(const PatchPlace& place, const Faces& faces, LocalPatch& patch) noexcept {
    for (const geometry::NodeId n : nodes_) number_of_[index(n)] = kNone;
    nodes_.clear();
    for (const geometry::NodeId n : place.held) number_of_[index(n)] = kHeld;
    find_near(place, faces);
    for (const geometry::NodeId n : place.held) number_of_[index(n)] = kNone;
    for (const Near& near : near_)
      if (has_room_for(faces.corners(near.face))) number(faces.corners(near.face));
    patch.node_count = nodes_.size();
    patch.triangle_count = 0;
    for (const Near& near : near_) add_triangle(faces.corners(near.face), patch);
    return patch.node_count > 0;
  }

  /// The nodes of the last patch, in its order.
  std::span<const geometry::NodeId> nodes() const noexcept { return nodes_; }

 private:
  using Corners = std::array<geometry::NodeId, 3>;
  // In place of a number in the patch; the second while faces are looked for.
  static constexpr std::int16_t kNone = -1, kHeld = -2;
  static constexpr double kBeforeAll = -1;
  struct Near {
    double squared_distance;
    std::size_t face;
  };

  static std::size_t index(geometry::NodeId n) { return static_cast<std::size_t>(n); }

  template <class Faces>
  void find_near(const PatchPlace& place, const Faces& faces) noexcept {
    near_.clear();
    for (std::size_t f = 0; f < faces.count(); ++f) {
      const Corners corners = faces.corners(f);
      if (is_held(corners)) {
        if (faces.is_one(f)) near_.push_back({kBeforeAll, f});
        continue;
      }
      const geometry::Vec3 &a = faces.place(corners[0]), &b = faces.place(corners[1]),
                           &c = faces.place(corners[2]);
      const geometry::Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
      if (!((low - place.centre).array() <= place.radius_m).all()) continue;
      if (!((place.centre - high).array() <= place.radius_m).all()) continue;
      const double squared = geometry::closest_point_on_triangle(place.centre, a, b, c).squared_distance;
      if (squared <= place.radius_m * place.radius_m && faces.is_one(f)) near_.push_back({squared, f});
    }
    // those that are equally near in an order that does not depend on that of the faces
    std::ranges::sort(near_, [&](const Near& p, const Near& q) {
      if (p.squared_distance != q.squared_distance) return p.squared_distance < q.squared_distance;
      return faces.corners(p.face) < faces.corners(q.face);
    });
  }

  bool is_held(const Corners& corners) const noexcept {
    return std::ranges::all_of(corners, [&](geometry::NodeId n) { return number_of_[index(n)] == kHeld; });
  }

  bool has_room_for(const Corners& corners) const noexcept {
    std::size_t fresh = 0;
    for (const geometry::NodeId n : corners) fresh += number_of_[index(n)] < 0;
    return nodes_.size() + fresh <= most_nodes_;
  }

  void number(const Corners& corners) noexcept {
    for (const geometry::NodeId n : corners) {
      if (number_of_[index(n)] >= 0) continue;
      number_of_[index(n)] = static_cast<std::int16_t>(nodes_.size());
      nodes_.push_back(n);
    }
  }

  void add_triangle(const Corners& corners, LocalPatch& patch) noexcept {
    const auto is_of_it = [&](geometry::NodeId n) { return number_of_[index(n)] >= 0; };
    if (!std::ranges::all_of(corners, is_of_it) || patch.triangle_count == patch.triangles.size()) return;
    auto& triangle = patch.triangles[patch.triangle_count++];
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i] = static_cast<std::uint8_t>(number_of_[index(corners[i])]);
  }

  std::size_t most_nodes_;
  std::vector<Near> near_;               // capacity most_faces
  std::vector<std::int16_t> number_of_;  // [nodes], in the patch; kNone: not of it
  std::vector<geometry::NodeId> nodes_;  // capacity most_nodes
};

}  // namespace omentum::deform
