// How much of a thing is seen: a coarse picture of depths alone, drawn by the processor.
#pragma once

#include "render_node/renderer.h"

#include <optional>

namespace omentum::render {

/// Looks at pixel centres. First the thing that is asked for, then all that may hide it. Both sides of a
/// triangle hide; what is nearer than the near plane is cut off, as in the picture. One thread.
class ExposureRaster {
 public:
  explicit ExposureRaster(Size size);

  Size size() const { return size_; }
  /// Begins anew.
  void look(const View& view);
  void add_thing(const MeshData& mesh, const Mat4f& W_from_mesh = Mat4f::Identity());
  /// After all of the thing.
  void add_cover(const MeshData& mesh, const Mat4f& W_from_mesh = Mat4f::Identity());

  /// Of the pixels that the thing alone would have, the share that nothing hides; none where it is out of
  /// sight.
  std::optional<double> share() const;

 private:
  using Corner = Eigen::Vector4f;  // in clip coordinates
  void add(const MeshData& mesh, const Mat4f& W_from_mesh, bool covers);
  void fill_clipped(const std::array<Corner, 3>& corners, bool covers);
  void fill(const Vec3f& a, const Vec3f& b, const Vec3f& c, bool covers);
  void see(std::size_t pixel, float depth, bool covers);

  Size size_;
  Mat4f clip_from_scene_ = Mat4f::Identity();
  std::vector<Vec3f> pixels_;         // of a mesh's vertices: place in the picture, and depth
  std::vector<Corner> corners_;       // of a mesh's vertices
  std::vector<float> depth_;          // of the thing, per pixel; kFar where it is not
  std::vector<std::uint8_t> hidden_;  // 1: something is in front of it there
};

}  // namespace omentum::render
