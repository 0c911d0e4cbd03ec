#include "render_node/picture_schedule.h"

#include <array>
#include <cstdio>

namespace omentum::render {
namespace {

constexpr double kPeriod_s = 2;           // off-screen, unless asked otherwise
constexpr double kDeeper = 1.05;          // a picture of less is not worth writing
constexpr double kShallowest_m = 0.0005;  // below half a millimetre nothing would be seen
constexpr double kIndentPeriod_s = 1;     // reading back and writing costs a frame or two

}  // namespace

bool PictureSchedule::frame_due(double time_s) const {
  return period_s_ > 0 && time_s >= next_s_;
}

bool PictureSchedule::indent_due(double time_s, double dent_m) const {
  if (dent_m < kShallowest_m || dent_m <= kDeeper * indent_m_) return false;
  return indent_m_ == 0 || time_s - indent_written_s_ >= kIndentPeriod_s;
}

Quality PictureSchedule::quality(const std::string& name) const {
  if (name == kLastPicture || !dear_) return Quality::kFine;
  return stalls_ && name == kIndentPicture ? Quality::kDraft : Quality::kPlain;
}

PicturesDue PictureSchedule::due(double time_s, double dent_m) {
  PicturesDue due;
  if (frame_due(time_s)) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%04d.png", ++frames_);
    due.numbered = name.data();
    next_s_ = time_s + period_s_;
  }
  if (indent_due(time_s, dent_m)) {
    due.indent = true;
    indent_m_ = dent_m;
    indent_written_s_ = time_s;
  }
  return due;
}

PictureSchedule schedule_of(double asked_period_s, const Renderer& renderer) {
  const bool has_window = renderer.has_window();
  const double period_s = asked_period_s >= 0 ? asked_period_s : has_window ? 0 : kPeriod_s;
  return PictureSchedule(period_s, has_window && !renderer.software().empty());
}

}  // namespace omentum::render
