#include "render_node/pointer_rays.h"

#include "node_common/vectors.h"
#include "render_node/scope_view.h"

#include <Eigen/LU>

namespace omentum::render {
namespace {

bool is_cameras(const Pointer& pointer) {
  return pointer.camera_key || (pointer.buttons & msg::POINTER_MIDDLE) != 0;
}

}  // namespace

void aim_ray(const View& view, float x, float y, msg::PointerRay& ray) {
  const Eigen::Matrix4d eye_from_clip = view.clip_from_eye.cast<double>().inverse();
  const Eigen::Vector4d far = eye_from_clip * Eigen::Vector4d(2.0 * x - 1, 1 - 2.0 * y, 1, 1);
  const Eigen::Matrix3d W_from_eye = view.eye_from_W.cast<double>().topLeftCorner<3, 3>().transpose();
  ray.origin = node::to_message(Vec3(view.eye.cast<double>()));
  ray.direction = node::to_message(Vec3((W_from_eye * (far.head<3>() / far.w())).normalized()));
  ray.right = node::to_message(Vec3(W_from_eye.col(0).normalized()));
  ray.up = node::to_message(Vec3(W_from_eye.col(1).normalized()));
}

PointerRays::PointerRays(const scene::Scene& scene) {
  const std::optional<std::size_t> scope = scope_of(scene);
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    tools_.push_back({.id = scene.tools[t].id, .name = scene.tools[t].name, .scope = scope == t});
  while (tool_ + 1 < tools_.size() && tools_[tool_].scope) ++tool_;
}

std::span<const msg::PointerRay> PointerRays::rays(const Pointer& pointer, const View& view,
                                                   std::span<const ToolNow> tools, std::int64_t now_ns) {
  rays_.clear();
  if (!drives()) return rays_;
  if (pointer.next_tool) {
    const std::size_t before = tool_;
    pick_next(tools);
    if (tool_ != before) {
      aim_ray(view, pointer.x, pointer.y, rays_.emplace_back(next_ray(before, now_ns)));
    }
  }
  const bool points = pointer.inside && !is_cameras(pointer);
  if (points) tools_[tool_].wheel += static_cast<double>(pointer.wheel);
  msg::PointerRay& ray = rays_.emplace_back(next_ray(tool_, now_ns));
  aim_ray(view, pointer.x, pointer.y, ray);
  ray.valid = points;
  ray.buttons = pointer.buttons;
  ray.keys = pointer.keys;
  return rays_;
}

msg::PointerRay PointerRays::next_ray(std::size_t tool, std::int64_t now_ns) {
  Driven& driven = tools_[tool];
  msg::PointerRay ray;
  ray.tool = driven.id;
  ray.seq = ++driven.seq;
  ray.stamp_ns = now_ns;
  ray.wheel = driven.wheel;
  return ray;
}

void PointerRays::pick_next(std::span<const ToolNow> tools) {
  for (std::size_t i = 1; i < tools_.size(); ++i) {
    const std::size_t next = (tool_ + i) % tools_.size();
    if (tools_[next].scope || !tools[next].seen) continue;
    tool_ = next;
    return;
  }
}

Input PointerRays::for_camera(const Input& input) const {
  if (!drives()) return input;
  Input left = input;
  left.orbit_x = left.orbit_y = left.pan_x = left.pan_y = left.zoom = 0;
  const Pointer& pointer = input.pointer;
  if (!pointer.inside || !is_cameras(pointer)) return left;
  if ((pointer.buttons & (msg::POINTER_MIDDLE | msg::POINTER_LEFT)) != 0) {
    left.orbit_x = pointer.dx;
    left.orbit_y = pointer.dy;
  } else if ((pointer.buttons & msg::POINTER_RIGHT) != 0) {
    left.pan_x = pointer.dx;
    left.pan_y = pointer.dy;
  }
  left.zoom = pointer.wheel;
  return left;
}

std::string PointerRays::help() const {
  if (!drives()) return "";
  return "mouse: " + tools_[tool_].name +
         "\n"
         "Tab: next   wheel, keys up, down: depth\n"
         "right, space: jaws   left, X: cut\n"
         "keys left, right: roll   Shift: tilt\n"
         "middle or Ctrl: camera";
}

}  // namespace omentum::render
