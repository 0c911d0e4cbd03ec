#include "render_node/video_slots.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace omentum::render {

std::int64_t VideoSlots::number_at(double time_s) const {
  constexpr double kRounding = 1e-6;  // of a picture: a frame on the border is not one too early
  return std::max<std::int64_t>(0, std::llround(std::floor((time_s - begin_s_) * fps_ + kRounding)));
}

std::optional<std::int64_t> VideoSlots::take(double time_s) {
  const std::int64_t number = number_at(time_s);
  if (number < next_) return std::nullopt;
  next_ = number + 1;
  return number;
}

std::int64_t VideoSlots::count(double end_s) const {
  return std::max<std::int64_t>({1, next_, number_at(end_s)});
}

std::vector<std::int64_t> shown_pictures(std::span<const std::int64_t> written, std::int64_t count) {
  std::vector<std::int64_t> shown;
  if (written.empty()) return shown;
  std::size_t newest = 0;
  for (std::int64_t k = 0; k < count; ++k) {
    while (newest + 1 < written.size() && written[newest + 1] <= k) ++newest;
    shown.push_back(written[newest]);
  }
  return shown;
}

std::string video_picture_name(std::int64_t number) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06" PRId64 ".png", number);
  return name.data();
}

}  // namespace omentum::render
