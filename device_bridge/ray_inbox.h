// What the window says of the pointer, handed from the vendor's thread to the loop that moves hands.
#pragma once

#include "transport/latest.h"

namespace omentum::device {

/// The newest ray of each tool, whatever its number: who follows rays sees by it whether the window began
/// anew (pointer_aim.h). One thread takes, any loads; nobody waits.
class RayInbox {
 public:
  /// `now_ns`: when it came. Tools from msg::MAX_TOOLS on are ignored.
  void take(const msg::PointerRay& ray, std::int64_t now_ns) noexcept {
    if (ray.tool < rays_.size()) rays_[ray.tool].store({ray, now_ns});
  }
  /// False, with `out` untouched, when none came yet.
  bool load(std::uint32_t tool, transport::Arrived<msg::PointerRay>& out) const noexcept {
    return tool < rays_.size() && rays_[tool].load(out);
  }

 private:
  std::array<transport::NewestCell<transport::Arrived<msg::PointerRay>>, msg::MAX_TOOLS> rays_;
};

}  // namespace omentum::device
