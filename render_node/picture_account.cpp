#include "render_node/picture_account.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <numeric>

namespace omentum::render {
namespace {

std::string rates(const FrameRateControl& control) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.0f of %.0f Hz", control.reached_fps(), control.asked_fps());
  return text.data();
}

}  // namespace

void PictureAccount::add(Quality quality, double begin_s) {
  if (frames_ == 0) first_s_ = begin_s;
  if (frames_ > 0) seconds_[static_cast<std::size_t>(newest_)] += begin_s - newest_s_;
  newest_ = quality;
  newest_s_ = begin_s;
  ++frames_;
}

double PictureAccount::fps() const {
  return newest_s_ > first_s_ ? static_cast<double>(frames_ - 1) / (newest_s_ - first_s_) : 0;
}

nlohmann::json PictureAccount::to_json(const FrameRateControl& control) const {
  const double all_s = std::accumulate(seconds_.begin(), seconds_.end(), 0.0);
  nlohmann::json share = nlohmann::json::object();
  for (std::size_t q = 0; q < kQualityCount; ++q)
    if (seconds_[q] > 0) share[means_of(static_cast<Quality>(q)).word] = seconds_[q] / all_s;
  return {{"level", words(control.level())},
          {"asked_fps", control.asked_fps()},
          {"reached_fps", fps()},
          {"changes", control.changes()},
          {"share", share}};
}

std::string rate_words(const FrameRateControl& control, bool has_tube) {
  const std::string level = has_tube ? words(control.level()) : std::string(means_of(control.quality()).word);
  return level + ", " + rates(control);
}

std::string software_words(const std::string& rasterizer, const FrameRateControl& control) {
  return "software OpenGL (" + rasterizer + "): pictures are drawn at \"" + means_of(control.quality()).word +
         "\" quality, " + rates(control);
}

}  // namespace omentum::render
