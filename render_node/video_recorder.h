// Records what is shown as numbered pictures, from which a program for videos makes one.
#pragma once

#include "render_node/panel_view.h"
#include "render_node/picture_writer.h"
#include "render_node/video_slots.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>

namespace omentum::render {

/// Videos of a session, one at a time, each in a folder of its own: DIR/video, DIR/video_2 ... (the first
/// that is not there). Its pictures are numbered without a gap: where a frame came late or found no room the
/// picture before it stands again (a hard link, which takes no room on the disk). No call waits for the disk
/// but finish(). No clock: times are given. One thread.
class VideoRecorder {
 public:
  VideoRecorder(std::filesystem::path out, double fps, runtime::FaultList& faults)
      : out_(std::move(out)), fps_(fps), faults_(faults) {}
  ~VideoRecorder();
  VideoRecorder(const VideoRecorder&) = delete;
  VideoRecorder& operator=(const VideoRecorder&) = delete;

  /// Says on stdout where the pictures go. Nothing happens while one is recorded; a folder that cannot be
  /// made is a fault.
  void begin(double time_s);
  /// Says on stdout what became of it.
  void end(double time_s);
  bool on() const { return !videos_.empty() && !videos_.back()->ended; }

  /// Whether the frame of this moment is wanted: then take() it. Times must not decrease.
  bool due(double time_s);
  void take(Picture picture);

  RecordingRow row(double time_s) const;
  /// Ends what is recorded and waits until all is written.
  void finish(double time_s);
  /// After finish(): of each video `folder`, `fps`, `seconds`, `pictures` of which it is made, and how many
  /// of them are `repeated` or were `dropped` because the disk, or the packing of pictures, was too slow.
  nlohmann::json report() const;

 private:
  struct Video {
    Video(std::filesystem::path in, double fps, double begin_s, runtime::FaultList& faults);
    std::int64_t pictures() const { return repeated + static_cast<std::int64_t>(offered.size()); }
    std::filesystem::path folder;
    VideoSlots slots;
    double begin_s, end_s;
    bool ended = false;
    std::int64_t due = 0, count = 0;    // number of the picture that was asked for; of all
    std::vector<std::int64_t> offered;  // numbers of those that the writer took
    std::int64_t repeated = 0;
    std::uint64_t dropped = 0;
    std::unique_ptr<PictureWriter> writer;  // last: its thread uses what is above
  };
  static void fill_gaps(Video& video);

  std::filesystem::path out_;
  double fps_;
  runtime::FaultList& faults_;
  std::vector<std::unique_ptr<Video>> videos_;  // the newest last
};

}  // namespace omentum::render
