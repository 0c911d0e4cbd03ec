// The node around the renderer: topics in, frames and pictures out.
#pragma once

#include "render_node/frame_rate_control.h"
#include "render_node/inbox.h"
#include "render_node/panel.h"
#include "render_node/picture_schedule.h"
#include "render_node/picture_writer.h"
#include "render_node/scene_view.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/rate_loop.h"

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
};

/// Owns the scene's drawing and the node's life on the bus. The renderer's thread.
class RenderLoop {
 public:
  /// Loads scene and organs and joins the domain. Throws what and where. `renderer` and `pace` must outlive
  /// this.
  RenderLoop(const RenderOptions& options, Renderer& renderer, runtime::RateLoop& pace);

  /// Until pace.stop(), the window is closed or the time is over; then writes final.png. Throws
  /// std::runtime_error when deform_node turns out to serve another organ.
  void run();
  /// After run(): the node's object of report.json (DESIGN 5).
  nlohmann::json report() const;

 private:
  RenderLoop(const RenderOptions& options, const runtime::Scene& scene, Renderer& renderer,
             runtime::RateLoop& pace);
  bool frame(const std::vector<std::string>& pictures);  // false: the window was closed
  void listen();
  void listen_to_tool(std::size_t tool, std::int64_t now_ns);
  void listen_to_organs();
  void steer(const Input& input);
  void obey(const PanelActions& actions);
  void command(std::uint32_t command);
  PanelView panel_view(std::int64_t now_ns) const;
  void shown(std::int64_t now_ns);
  double deepest_m() const;
  bool paused() const;

  RenderOptions options_;
  runtime::Scene scene_;
  std::pair<std::vector<LoadedOrgan>, std::vector<OrganShape>> loaded_;
  Renderer& renderer_;
  runtime::RateLoop& pace_;
  runtime::FaultList faults_;
  SceneView view_;
  ViewChoices choices_;
  std::vector<ToolNow> tools_;
  std::vector<ToolRow> rows_;
  std::vector<ForceHistory> histories_;
  std::vector<std::vector<msg::Echo>> echoes_;  // per organ, of the state that is drawn
  bool fresh_echoes_ = false;                   // since the last frame
  std::vector<HeardStatus> statuses_;
  SessionState session_;
  FrameRateControl control_;
  PictureSchedule schedule_;
  std::unique_ptr<PictureWriter> writer_;
  std::unique_ptr<runtime::LoopLog> log_;
  runtime::TickAccount account_;  // frames, not the pace's ticks: a slow machine skips some of those
  runtime::Histogram hand_to_force_, hand_to_picture_;
  std::int64_t begin_ns_ = 0;
  std::int64_t next_status_ns_ = 0;
  msg::NodeStatus status_;

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> command_writer_;
  std::unique_ptr<Inbox> inbox_;
};

}  // namespace omentum::render
