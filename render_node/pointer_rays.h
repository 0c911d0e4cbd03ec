// The mouse as a hand: which tool it drives, and the rays that say where it points (msg::PointerRay).
#pragma once

#include "render_node/scene_view.h"
#include "transport/messages.h"

#include <span>
#include <string>
#include <vector>

namespace omentum::render {

/// The ray from the eye through a place of the picture (shares of its width and height, from its upper left
/// corner), in W: origin, direction and the picture's axes of `ray` are set.
void aim_ray(const View& view, float x, float y, msg::PointerRay& ray);

/// Keeps the numbers of rays and the levels of the wheel, of each tool of a scene its own. While a mouse
/// device listens the pointer is the tool's, and the camera's only with the middle button or the camera key.
/// One thread.
class PointerRays {
 public:
  explicit PointerRays(const scene::Scene& scene);

  /// Whether a device listens: without one there are no rays.
  void drive(bool on) { drives_ = on; }
  bool drives() const { return drives_ && !tools_.empty(); }
  /// Which of the scene's tools, in its order, the mouse drives.
  std::size_t tool() const { return tool_; }

  /// What to publish now: the ray of the tool that is driven, after the last one of a tool that was driven
  /// till now. `view`: in which the person points. `tools`: as many as the scene's; the next tool is one that
  /// is seen, and no scope. Valid until the next call.
  std::span<const msg::PointerRay> rays(const Pointer& pointer, const View& view,
                                        std::span<const ToolNow> tools, std::int64_t now_ns);

  /// What is left of a person's input for the camera.
  Input for_camera(const Input& input) const;

  /// For the panel: what the mouse drives and how, in lines; empty while it drives nothing.
  std::string help() const;

 private:
  struct Driven {
    std::uint32_t id = 0;
    std::string name;
    bool scope = false;
    std::uint64_t seq = 0;
    double wheel = 0;
  };
  void pick_next(std::span<const ToolNow> tools);
  msg::PointerRay next_ray(std::size_t tool, std::int64_t now_ns);

  std::vector<Driven> tools_;
  std::size_t tool_ = 0;
  bool drives_ = false;
  std::vector<msg::PointerRay> rays_;
};

}  // namespace omentum::render
