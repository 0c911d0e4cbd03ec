#include "render_node/video_recorder.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <system_error>

namespace omentum::render {
namespace {

constexpr const char* kUnlinked = "video: a repeated picture could not be written";

// What another session left stays as it is.
std::filesystem::path new_folder(const std::filesystem::path& out) {
  std::filesystem::path folder = out / "video";
  for (int number = 2; std::filesystem::exists(folder); ++number)
    folder = out / ("video_" + std::to_string(number));
  return folder;
}

// Not every file system has links.
bool stands_again(const std::filesystem::path& picture, const std::filesystem::path& as) {
  std::error_code error;
  std::filesystem::create_hard_link(picture, as, error);
  if (error)
    std::filesystem::copy_file(picture, as, std::filesystem::copy_options::overwrite_existing, error);
  return !error;
}

}  // namespace

VideoRecorder::Video::Video(std::filesystem::path in, double fps, double begin, runtime::FaultList& faults)
    : folder(std::move(in)),
      slots(fps, begin),
      begin_s(begin),
      end_s(begin),
      writer(std::make_unique<PictureWriter>(folder, faults)) {}

VideoRecorder::~VideoRecorder() {
  if (on()) end(videos_.back()->end_s);
}

void VideoRecorder::begin(double time_s) {
  if (on()) return;
  try {
    videos_.push_back(std::make_unique<Video>(new_folder(out_), fps_, time_s, faults_));
  } catch (const std::exception& error) {
    return faults_.raise(error.what());
  }
  std::printf("render_node: recording %g pictures a second to %s\n", fps_, videos_.back()->folder.c_str());
  std::fflush(stdout);
}

void VideoRecorder::end(double time_s) {
  if (!on()) return;
  Video& video = *videos_.back();
  video.ended = true;
  video.end_s = time_s;
  video.count = video.slots.count(time_s);
  std::printf("render_node: recorded %.1f s in %s: %zu pictures for %lld places, %llu dropped\n",
              time_s - video.begin_s, video.folder.c_str(), video.offered.size(),
              static_cast<long long>(video.count), static_cast<unsigned long long>(video.dropped));
  std::fflush(stdout);
  video.writer->end([&video, this] {
    fill_gaps(video);
    if (!video.offered.empty() && video.pictures() < video.count) faults_.raise(kUnlinked);
  });
}

// The writer's thread, when all others are written. A picture that the disk refused is a gap as well.
void VideoRecorder::fill_gaps(Video& video) {
  std::vector<std::int64_t>& written = video.offered;
  std::erase_if(written, [&](std::int64_t number) {
    std::error_code error;
    return !std::filesystem::exists(video.folder / video_picture_name(number), error);
  });
  const std::vector<std::int64_t> shown = shown_pictures(written, video.count);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const auto number = static_cast<std::int64_t>(k);
    if (shown[k] == number) continue;
    video.repeated +=
        stands_again(video.folder / video_picture_name(shown[k]), video.folder / video_picture_name(number));
  }
}

bool VideoRecorder::due(double time_s) {
  if (!on()) return false;
  Video& video = *videos_.back();
  video.end_s = time_s;
  const auto number = video.slots.take(time_s);
  video.due = number.value_or(0);
  return number.has_value();
}

void VideoRecorder::take(Picture picture) {
  Video& video = *videos_.back();
  if (video.writer->offer(std::move(picture), video_picture_name(video.due))) {
    video.offered.push_back(video.due);
  } else {
    ++video.dropped;
  }
}

RecordingRow VideoRecorder::row(double time_s) const {
  if (!on()) return {};
  const Video& video = *videos_.back();
  return {true, time_s - video.begin_s, video.offered.size(), video.dropped};
}

void VideoRecorder::finish(double time_s) {
  end(time_s);
  for (const auto& video : videos_) video->writer->finish();
}

nlohmann::json VideoRecorder::report() const {
  nlohmann::json videos = nlohmann::json::array();
  for (const auto& video : videos_)
    videos.push_back({{"folder", video->folder.string()},
                      {"fps", fps_},
                      {"seconds", static_cast<double>(video->pictures()) / fps_},
                      {"pictures", video->pictures()},
                      {"repeated", video->repeated},
                      {"dropped", video->dropped}});
  return videos;
}

}  // namespace omentum::render
