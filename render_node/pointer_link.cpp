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
  // one that is lost is followed by the next one within a frame
  for (const msg::PointerRay& ray : rays_.rays(input.pointer, seen, tools, now_ns)) writer_->write(ray);
  return rays_.for_camera(input);
}

}  // namespace omentum::render
