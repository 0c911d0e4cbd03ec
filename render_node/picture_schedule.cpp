#include "render_node/picture_schedule.h"

#include <array>
#include <cstdio>

namespace omentum::render {
namespace {

constexpr double kDeeper = 1.05;         // a picture of less is not worth writing
constexpr double kShallowestM = 0.0005;  // below half a millimetre nothing would be seen
constexpr double kIndentPeriodS = 1;     // reading back and writing costs a frame or two

}  // namespace

bool PictureSchedule::frame_due(double time_s) const {
  return period_s_ > 0 && time_s >= next_s_;
}

bool PictureSchedule::indent_due(double time_s, double deepest_m) const {
  if (deepest_m < kShallowestM || deepest_m <= kDeeper * deepest_m_) return false;
  return deepest_m_ == 0 || time_s - indent_written_s_ >= kIndentPeriodS;
}

std::vector<std::string> PictureSchedule::due(double time_s, double deepest_m) {
  std::vector<std::string> files;
  if (frame_due(time_s)) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%04d.png", ++frames_);
    files.emplace_back(name.data());
    next_s_ = time_s + period_s_;
  }
  if (indent_due(time_s, deepest_m)) {
    files.emplace_back("indent.png");
    deepest_m_ = deepest_m;
    indent_written_s_ = time_s;
  }
  return files;
}

}  // namespace omentum::render
