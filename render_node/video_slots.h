// Which frames become the pictures of a video, and which of them it shows when.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace omentum::render {

/// Picture k of a video is what was seen k / fps after it began: the first frame from then on, if it came
/// before picture k + 1; else the picture before it again. So a video lasts as long as what it shows, however
/// many frames were drawn. No clock: times are given. One thread.
class VideoSlots {
 public:
  /// fps > 0.
  VideoSlots(double fps, double begin_s) : fps_(fps), begin_s_(begin_s) {}

  /// The number of the picture that a frame of this moment is, from 0; none where that one was taken already.
  /// Times must not decrease.
  std::optional<std::int64_t> take(double time_s);
  /// How many pictures a video has that ends now: one at least.
  std::int64_t count(double end_s) const;

 private:
  std::int64_t number_at(double time_s) const;

  double fps_, begin_s_;
  std::int64_t next_ = 0;
};

/// For each of `count` pictures the one of `written` (ascending) that is seen there: the newest up to it,
/// before the first that one. Empty where nothing was written.
std::vector<std::int64_t> shown_pictures(std::span<const std::int64_t> written, std::int64_t count);

/// "000042.png": as many digits as a video of half a day at 24 pictures a second needs.
std::string video_picture_name(std::int64_t number);

}  // namespace omentum::render
