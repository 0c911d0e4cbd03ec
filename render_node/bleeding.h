// Blood that comes out where tissue was parted without heat.
#pragma once

#include "render_node/downhill.h"
#include "render_node/organ_cut.h"

#include <array>

namespace omentum::render {

/// Drops on the bared surface of an organ. Where they come out, how large they are and where they stay
/// follows from the topology alone: a triangle of the bared surface bleeds or not by a number made of its
/// nodes' places in the mesh, and a drop runs down the organ as it lies at rest. So all who draw the organ
/// draw the same drops, and a cut that goes on leaves those that there are, up to the most: then some make
/// room. Only how far a drop has run is of the one who draws: each drop runs for kRun_s from when it was
/// first seen, and who joins late sees it run once more before both show the same. Heat closes vessels: a
/// triangle with a burnt node does not bleed. One thread.
class Bleeding {
 public:
  static constexpr std::size_t kMostDrops = 48;      // 2,600 vertices in all: little beside an organ's
  static constexpr float kAreaPerDrop_m2 = 0.7e-4f;  // a mouth of a vessel that bleeds visibly
  static constexpr float kSmallest_m = 0.0008f, kLargest_m = 0.0019f;  // radii
  static constexpr float kShortestRun_m = 0.003f, kLongestRun_m = 0.016f;
  static constexpr double kRun_s = 2.5;

  /// `triangles`: of the organ's whole closed surface now, of which those from `first_bared` on lie bare;
  /// `rest`: of its nodes, [S'].
  void cut(const CutShape& shape, std::span<const geometry::Triangle> triangles, std::size_t first_bared,
           std::span<const Vec3f> rest);
  /// Lets drops run. Whether one moved.
  bool run(double dt_s);
  /// The mesh of the drops on the surface as it lies now: places and outward normals of its nodes, [S'].
  void deform(std::span<const Vec3f> positions, std::span<const Vec3f> normals);

  std::size_t drop_count() const { return drops_.size(); }
  /// Of so many vertices and triangles as the most drops have, always; those that are not there are points.
  const MeshData& mesh() const { return mesh_; }

 private:
  static constexpr std::size_t kWayPoints = 12, kAround = 8, kRings = 3, kAcross = 3;
  static constexpr std::size_t kDropVertices = 1 + kRings * kAround + kWayPoints * kAcross;
  struct Drop {
    std::uint64_t seed = 0;
    float radius_m = 0;
    std::vector<SurfacePoint> way;
    std::vector<float> length_m;  // along the way, at rest, to each of its points
    double ran_s = 0;
  };
  // A place on the surface now.
  struct Foot {
    Vec3f place, normal;
  };
  static Drop make_drop(std::uint64_t seed, std::size_t triangle, const Downhill& downhill,
                        std::span<const Vec3f> rest);
  void make_triangles();
  // How far the drop has come; all of the way's points, those that it did not reach where it is. The place of
  // the last one that it reached.
  static std::size_t feet_of(const Drop& drop, std::span<const Vec3f> positions,
                             std::span<const Vec3f> normals, std::array<Foot, kWayPoints>& feet);
  void place(const Drop& drop, std::span<const Vec3f> positions, std::span<const Vec3f> normals,
             std::span<Vertex> out) const;
  static void place_bead(const Foot& foot, const Vec3f& along, float radius_m, std::span<Vertex> out);
  static void place_trail(std::span<const Foot> feet, float width_m, std::span<Vertex> out);

  std::vector<Drop> drops_;
  MeshData mesh_;
};

}  // namespace omentum::render
