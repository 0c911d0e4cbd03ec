#include "render_node/exposure_raster.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr float kFar = 2;        // behind the far plane, which is at 1
constexpr float kSeam = -1e-4f;  // of a weight: rounding opens no gap between neighbours

using Pixel = Vec3f;  // place in the picture, in pixels, and depth

// Twice the area of a triangle, positive where it turns to the left.
float turn(const Pixel& a, const Pixel& b, const Pixel& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The pixel centres from `low` to `high` are first .. last; none where last < first.
struct Run {
  int first, last;
};
Run centres(float low, float high, int size) {
  const auto most = static_cast<float>(size);
  // rounded by cutting off: a call of ceil() would be half of all the time
  const float first = std::clamp(low, 0.0f, most) + 0.5f, end = std::clamp(high, 0.0f, most) + 0.5f;
  return {static_cast<int>(first), static_cast<int>(end) - 1};
}

bool in_front(const Eigen::Vector4f& corner) {
  return corner.z() > -corner.w();
}

Pixel project(const Eigen::Vector4f& corner, Size size) {
  const Vec3f place = corner.hnormalized();
  return {0.5f * static_cast<float>(size.width) * (1 + place.x()),
          0.5f * static_cast<float>(size.height) * (1 - place.y()), place.z()};
}

}  // namespace

ExposureRaster::ExposureRaster(Size size) : size_(size) {
  look({});
}

void ExposureRaster::look(const View& view) {
  clip_from_scene_ = view.clip_from_eye * view.eye_from_W;
  const auto pixels = static_cast<std::size_t>(size_.width * size_.height);
  depth_.assign(pixels, kFar);
  hidden_.assign(pixels, 0);
}

void ExposureRaster::add_thing(const MeshData& mesh, const Mat4f& W_from_mesh) {
  add(mesh, W_from_mesh, false);
}

void ExposureRaster::add_cover(const MeshData& mesh, const Mat4f& W_from_mesh) {
  add(mesh, W_from_mesh, true);
}

void ExposureRaster::add(const MeshData& mesh, const Mat4f& W_from_mesh, bool covers) {
  const Mat4f clip_from_mesh = clip_from_scene_ * W_from_mesh;
  corners_.clear();
  pixels_.clear();
  for (const Vertex& vertex : mesh.vertices) {
    corners_.emplace_back(clip_from_mesh * vertex.position.homogeneous());
    pixels_.push_back(project(corners_.back(), size_));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const int front = in_front(corners_[a]) + in_front(corners_[b]) + in_front(corners_[c]);
    if (front == 3) {
      fill(pixels_[a], pixels_[b], pixels_[c], covers);
    } else if (front > 0) {
      fill_clipped({corners_[a], corners_[b], corners_[c]}, covers);
    }
  }
}

// What the near plane leaves of a triangle: three or four corners.
void ExposureRaster::fill_clipped(const std::array<Corner, 3>& corners, bool covers) {
  std::array<Corner, 4> left;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &from = corners[i], &to = corners[(i + 1) % 3];
    if (in_front(from)) left[count++] = from;
    if (in_front(from) == in_front(to)) continue;
    const float inside = from.z() + from.w(), other = to.z() + to.w();
    left[count++] = from + inside / (inside - other) * (to - from);
  }
  for (std::size_t i = 1; i + 1 < count; ++i)
    fill(project(left[0], size_), project(left[i], size_), project(left[i + 1], size_), covers);
}

// Depth is linear over the picture.
void ExposureRaster::fill(const Vec3f& a, const Vec3f& b, const Vec3f& c, bool covers) {
  const Run rows = centres(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), size_.height);
  if (rows.last < rows.first) return;
  const Run columns = centres(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), size_.width);
  const float area = turn(a, b, c);
  if (columns.last < columns.first || !(std::abs(area) > 0)) return;
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const Pixel p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0);
      const float wa = turn(b, c, p) / area, wb = turn(c, a, p) / area, wc = 1 - wa - wb;
      if (wa < kSeam || wb < kSeam || wc < kSeam) continue;
      see(static_cast<std::size_t>(y * size_.width + x), wa * a.z() + wb * b.z() + wc * c.z(), covers);
    }
  }
}

void ExposureRaster::see(std::size_t pixel, float depth, bool covers) {
  if (!covers) {
    depth_[pixel] = std::min(depth_[pixel], depth);
  } else if (depth < depth_[pixel] && depth_[pixel] < kFar) {
    hidden_[pixel] = 1;
  }
}

std::optional<double> ExposureRaster::share() const {
  const auto all = std::count_if(depth_.begin(), depth_.end(), [](float depth) { return depth < kFar; });
  if (all == 0) return std::nullopt;
  const auto hidden = std::count(hidden_.begin(), hidden_.end(), 1);
  return 1 - static_cast<double>(hidden) / static_cast<double>(all);
}

}  // namespace omentum::render
