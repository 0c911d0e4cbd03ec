#include "render_node/pointer_link.h"

namespace omentum::render {
namespace {

// Whether somebody reads is asked behind the vendor's locks, and not in every frame.
constexpr std::int64_t kLook_ns = 200'000'000;

}  // namespace

PointerLink::PointerLink(transport::Bus& bus, const scene::Scene& scene)
    : rays_(scene), writer_(bus.writer<msg::PointerRay>()) {}

Input PointerLink::share(const Input& input, const View& seen, std::span<const ToolNow> tools,
                         std::int64_t now_ns) {
  if (now_ns >= next_look_ns_) {
    rays_.drive(writer_->status().matched > 0);
    next_look_ns_ = now_ns + kLook_ns;
  }
  publish(input.pointer, seen, tools, now_ns);
  Input since_frame = input;
  since_frame.pointer.dx += between_.dx;
  since_frame.pointer.dy += between_.dy;
  since_frame.pointer.wheel += between_.wheel;
  between_ = {};
  return rays_.for_camera(since_frame);
}

void PointerLink::look(Renderer& renderer, const View& seen, std::span<const ToolNow> tools,
                       std::int64_t now_ns) {
  if (!rays_.drives()) return;
  const Pointer pointer = renderer.look_at_pointer();
  between_.dx += pointer.dx;
  between_.dy += pointer.dy;
  between_.wheel += pointer.wheel;
  publish(pointer, seen, tools, now_ns);
}

void PointerLink::publish(const Pointer& pointer, const View& seen, std::span<const ToolNow> tools,
                          std::int64_t now_ns) {
  // one that is lost is followed by the next one soon
  for (const msg::PointerRay& ray : rays_.rays(pointer, seen, tools, now_ns)) writer_->write(ray);
}

}  // namespace omentum::render
