// The mouse as a hand, on the wire.
#pragma once

#include "render_node/pointer_rays.h"
#include "transport/bus.h"

#include <memory>

namespace omentum::render {

/// Publishes the pointer's rays while somebody reads them, one a frame. One thread.
class PointerLink {
 public:
  /// `bus` must outlive this.
  PointerLink(transport::Bus& bus, const scene::Scene& scene);

  /// Between two frames, while a device listens: a window that draws slowly is still pointed at.
  void look(Renderer& renderer, const View& seen, std::span<const ToolNow> tools, std::int64_t now_ns);
  /// What a person did since the last frame, in the picture of `seen`: the tool's part goes out, the camera's
  /// comes back.
  Input share(const Input& input, const View& seen, std::span<const ToolNow> tools, std::int64_t now_ns);
  const PointerRays& rays() const { return rays_; }

 private:
  void publish(const Pointer& pointer, const View& seen, std::span<const ToolNow> tools, std::int64_t now_ns);

  PointerRays rays_;
  std::unique_ptr<transport::Writer<msg::PointerRay>> writer_;
  std::int64_t next_look_ns_ = 0;
  Pointer between_;  // what the camera's part of the next frame has to go on from
};

}  // namespace omentum::render
