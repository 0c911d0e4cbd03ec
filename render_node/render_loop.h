// The node around the renderer: topics in, frames and pictures out.
#pragma once

#include "render_node/camera_exercise.h"
#include "render_node/exposure_score.h"
#include "render_node/feel_ring.h"
#include "render_node/frame_rate_control.h"
#include "render_node/panel.h"
#include "render_node/picture_account.h"
#include "render_node/picture_schedule.h"
#include "render_node/picture_writer.h"
#include "render_node/pointer_link.h"
#include "render_node/scene_files.h"
#include "render_node/session_watch.h"
#include "render_node/touch_view.h"
#include "render_node/video_recorder.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/pace.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>

namespace omentum::render {

struct RenderOptions {
  runtime::NodeOptions node;
  Size size;              // 0x0: 1280x800 in a window, 960x600 off-screen
  bool headless = false;  // off-screen even where there is a display
  double fps = 30;
  double seconds = 0;         // ends by itself after so long; 0: never
  std::filesystem::path out;  // pictures go here; empty: none
  double picture_period_s =
      -1;  // numbered pictures; 0: none; negative: every 2 s off-screen, none in a window
  bool no_panel = false;
  bool record = false;              // from the start; else when a person asks
  double record_fps = 25;           // pictures of a second of video
  float ui_scale = 0;               // of the panel; 0: as monitor and picture ask for
  TissueMap map = TissueMap::kOff;  // at the start
  bool folds = false;               // ViewChoices::folds
  bool touches = false;             // ViewChoices::touches
};

/// A pace's, of the asked rate: a frame that came too late for its tick waits for an eighth of a period, not
/// a whole one.
inline constexpr double kTicksPerFrame = 8;

/// Of an organ that is to be exposed so many pixels are looked at: a hundredth of it is seen in some tens.
inline constexpr Size kExposureSize{160, 120};

/// Owns the scene's drawing and the node's life on the bus. The renderer's thread.
class RenderLoop {
 public:
  /// Loads scene and organs and joins the domain. Throws what and where. `renderer` and `pace`, which tells
  /// the time too, must outlive this.
  RenderLoop(const RenderOptions& options, const transport::OpenBus& open_bus, Renderer& renderer,
             runtime::Pace& pace);

  /// Until pace.stop(), the window is closed or the time is over; then writes final.png. Throws
  /// std::runtime_error when deform_node turns out to serve another organ.
  void run();
  /// After run(): the node's object of report.json, and `closed`: whether a person closed the
  /// window, `deepest_dent_m` (dent.h), `unmatched_states` (inbox.h), `removed_tetrahedra` of the newest
  /// picture, `picture` (picture_account.h), `videos` (video_recorder.h) and, where the scene names an organ
  /// to expose, `exposed_share` (exposure_score.h), where it scores its camera `camera` (camera_score.h), and
  /// where its tools have trocars `trocars` (trocar_watch.h).
  nlohmann::json report() const;
  /// After run(), and after the report: throws std::runtime_error when lines of the log or pictures were
  /// lost, and why.
  void require_written();

 private:
  RenderLoop(const RenderOptions& options, const SceneFiles& loaded, const transport::OpenBus& open_bus,
             Renderer& renderer, runtime::Pace& pace);
  void frame(bool last);
  void measure_exposure();
  void tell_software(double time_s);
  void watch_slowly(std::int64_t now_ns);
  void take_close_up(const Dent& deepest);
  void draw(const std::string& picture);  // file name; empty: for the window only
  void record();
  void finish_frame(std::int64_t begin_ns, bool for_disk);
  void steer(const Input& input);
  void obey(const PanelActions& actions);
  void show_map(TissueMap map);
  void command(std::uint32_t command, const std::string& argument = {});
  PanelView panel_view(std::int64_t now_ns) const;
  void tell_status(std::int64_t now_ns);
  double seconds_since_begin(std::int64_t now_ns) const {
    return 1e-9 * static_cast<double>(now_ns - begin_ns_);
  }

  RenderOptions options_;
  Renderer& renderer_;
  runtime::Pace& pace_;
  std::int64_t begin_ns_;
  double begin_thread_s_ = 0;  // of this frame, thread_time_s()
  runtime::FaultList faults_;
  SceneView view_;
  SessionWatch watch_;
  ViewChoices choices_;
  FeelRing feel_ring_;
  double max_force_n_;  // the scene's
  View seen_;           // in which a person points
  bool help_ = false;   // is shown
  FrameRateControl control_;
  PictureAccount pictures_;
  bool told_software_ = false;
  PictureSchedule schedule_;
  std::unique_ptr<PictureWriter> writer_;
  VideoRecorder recorder_;
  std::unique_ptr<runtime::LoopLog> log_;
  std::string picture_failure_;   // why the first of the pictures that were lost was
  runtime::TickAccount account_;  // frames, not the pace's ticks: a slow machine skips some of those
  bool closed_ = false;           // the window, by a person
  std::int64_t next_status_ns_ = 0;
  std::string exposed_organ_;             // the scene's
  std::optional<std::size_t> to_expose_;  // its place among the organs
  ExposureRaster raster_{kExposureSize};
  double scored_from_s_ = 0;
  ExposureScore exposure_;
  std::optional<CameraExercise> exercise_;  // of a scene that scores its camera
  std::int64_t next_slow_ns_ = 0;
  msg::NodeStatus status_;

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> command_writer_;
  std::unique_ptr<PointerLink> pointer_;
  std::unique_ptr<Inbox> inbox_;
  std::unique_ptr<TouchView> touches_;
};

}  // namespace omentum::render
