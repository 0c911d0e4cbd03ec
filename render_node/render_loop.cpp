#include "render_node/render_loop.h"

#include "files/console.h"
#include "node_common/node_identity.h"
#include "node_common/session_orders.h"
#include "render_node/frame_cost.h"
#include "render_node/panel_keys.h"
#include "render_node/view_choices.h"
#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omentum::render {
namespace {

constexpr std::int64_t kSlow_ns = 1'000'000'000;  // loops are folded aside, and the ground's shade is seen to
                                                  // follow them, within seconds
constexpr std::int64_t kStatusPeriod_ns = 100'000'000;  // docs/topics.md: 1-10 Hz
constexpr double kSettled_s = 3;  // the frame rate's control has found its level, and the others are there
constexpr double kTurnPerHeight = 3.0;  // rad, when the mouse crosses the picture's height
constexpr double kNearestRadii = 0.15, kFarthestRadii = 12;  // of the orbit, in radii of what is seen

std::optional<std::size_t> organ_to_expose(const scene::Scene& scene) {
  for (std::size_t o = 0; o < scene.organs.size(); ++o)
    if (scene.organs[o].name == scene.score.exposed_organ) return o;
  return std::nullopt;
}

}  // namespace

RenderLoop::RenderLoop(const RenderOptions& options, const transport::OpenBus& open_bus, Renderer& renderer,
                       runtime::Pace& pace)
    : RenderLoop(options, read_scene_files(options.node), open_bus, renderer, pace) {}

RenderLoop::RenderLoop(const RenderOptions& options, const SceneFiles& loaded,
                       const transport::OpenBus& open_bus, Renderer& renderer, runtime::Pace& pace)
    : options_(options),
      renderer_(renderer),
      pace_(pace),
      begin_ns_(pace_.now_ns()),
      view_(loaded.scene, loaded.shapes, renderer),
      watch_(loaded.scene, loaded.organs, begin_ns_),
      feel_ring_(renderer),
      max_force_n_(loaded.scene.haptics.max_force_n),
      control_(options.fps, kDrawingDuty),
      schedule_(schedule_of(options.picture_period_s, renderer)),
      recorder_(options.out.empty() ? "." : options.out, options.record_fps, faults_),
      account_(std::llround(1e9 / options.fps)),
      status_(node::introduce(msg::NODE_RENDER, options.fps)),
      bus_(open_bus()) {
  exposed_organ_ = loaded.scene.score.exposed_organ;
  to_expose_ = organ_to_expose(loaded.scene);
  scored_from_s_ = loaded.scene.score.from_s;
  if (loaded.scene.score.camera) exercise_.emplace(loaded.scene, view_);
  view_.surround(load_scenery(loaded.scene.scenery));
  choices_ = first_choices(options, loaded.scene, view_.first_camera());
  if (!options.out.empty()) writer_ = std::make_unique<PictureWriter>(options.out, faults_);
  if (!options.node.log.empty()) log_ = std::make_unique<runtime::LoopLog>(options.node.log);
  status_writer_ = bus_->writer<msg::NodeStatus>();
  command_writer_ = bus_->writer<msg::SessionCommand>();
  pointer_ = std::make_unique<PointerLink>(*bus_, loaded.scene);
  inbox_ = std::make_unique<Inbox>(*bus_, loaded.scene, loaded.organs, pace_, faults_);
  touches_ = std::make_unique<TouchView>(*bus_, loaded.organs.size(), renderer, pace_, faults_);
  show_map(options.map);
  if (options.record) recorder_.begin(seconds_since_begin(pace_.now_ns()));
}

void RenderLoop::run() {
  while (!closed_ && pace_.wait() != runtime::Pace::Cause::kStopped) {
    const std::int64_t now_ns = pace_.now_ns();
    const double time_s = seconds_since_begin(now_ns);
    if (options_.seconds > 0 && time_s >= options_.seconds) break;
    if (control_.due(time_s)) {
      frame(false);
    } else {
      pointer_->look(renderer_, seen_, watch_.tools(), now_ns);
    }
  }
  if (writer_) frame(true);
  if (writer_) picture_failure_ = writer_->finish();
  writer_.reset();
  recorder_.finish(seconds_since_begin(pace_.now_ns()));
}

void RenderLoop::frame(bool last) {
  const std::int64_t begin_ns = pace_.now_ns();
  begin_thread_s_ = thread_time_s();
  account_.start(begin_ns);
  watch_.listen(*inbox_, view_, faults_, begin_ns);
  if (begin_ns >= next_slow_ns_) watch_slowly(begin_ns);
  if (exercise_) exercise_->look(seconds_since_begin(begin_ns), view_, watch_.tools());
  const std::optional<Dent>& dent = watch_.deepest_dent();
  PicturesDue due;
  if (last) {
    due.numbered = kLastPicture;
  } else if (writer_) {
    due = schedule_.due(seconds_since_begin(begin_ns), dent ? dent->depth_m : 0);
  }
  pictures_.add(control_.quality(), seconds_since_begin(begin_ns));
  tell_software(seconds_since_begin(begin_ns));
  const Input input = pointer_->share(renderer_.begin_frame(), seen_, watch_.tools(), begin_ns);
  closed_ = closed_ || input.close;
  steer(input);
  const PanelView panel = panel_view(begin_ns);
  obey(actions_of(input.keys, panel));
  if (!options_.no_panel) obey(lay_out_panel(panel));
  record();
  if (due.indent) take_close_up(*dent);
  draw(due.numbered);
  finish_frame(begin_ns, due.indent || !due.numbered.empty());
}

void RenderLoop::watch_slowly(std::int64_t now_ns) {
  next_slow_ns_ = now_ns + kSlow_ns;
  if (!choices_.endoscope) view_.shade_ground();  // of which an endoscope sees nothing
  if (to_expose_ && seconds_since_begin(now_ns) >= scored_from_s_) measure_exposure();
}

void RenderLoop::tell_software(double time_s) {
  if (told_software_ || time_s < kSettled_s) return;
  told_software_ = true;
  const std::string rasterizer = renderer_.software();
  if (rasterizer.empty()) return;
  files::say("render_node: " + software_words(rasterizer, control_), STDOUT_FILENO);
}

void RenderLoop::measure_exposure() {
  const std::optional<double> share = view_.exposed_share(*to_expose_, watch_.tools(), raster_);
  if (share) exposure_.add(*share);
}

void RenderLoop::require_written() {
  if (log_) log_->finish();
  if (!picture_failure_.empty()) throw std::runtime_error(picture_failure_);
}

void RenderLoop::record() {
  const std::optional<node::RecordOrder> order = inbox_->orders().take_record();
  if (!order) return;
  const bool on = *order == node::RecordOrder::kToggle ? !recorder_.on() : *order == node::RecordOrder::kOn;
  const double now_s = seconds_since_begin(pace_.now_ns());
  on ? recorder_.begin(now_s) : recorder_.end(now_s);
}

void RenderLoop::take_close_up(const Dent& deepest) {
  Frame frame = view_.close_up(deepest, choices_, watch_.tools());
  frame.quality = schedule_.quality(kIndentPicture);
  renderer_.draw(frame);
  writer_->write(renderer_.read_back(), kIndentPicture);
}

void RenderLoop::draw(const std::string& picture) {
  const double covered = options_.no_panel ? 0 : panel_share(renderer_.size(), renderer_.ui_scale());
  const PictureLevel level = control_.level();
  view_.set_tube_resolution(picture.empty() ? TubeResolution{level.eps(), level.n()} : kPictureTube);
  Frame frame = view_.frame(choices_, watch_.tools(), covered);
  seen_ = frame.view;
  touches_->draw(choices_.touches, frame);
  const PointerRays& mouse = pointer_->rays();
  if (mouse.drives()) feel_ring_.add(watch_.tools()[mouse.tool()], max_force_n_, frame);
  frame.quality = picture.empty() ? control_.quality() : schedule_.quality(picture);
  view_.order_translucent(frame);
  renderer_.draw(frame);
  if (!picture.empty()) writer_->write(renderer_.read_back(), picture);
  if (recorder_.due(seconds_since_begin(pace_.now_ns()))) recorder_.take(renderer_.read_back());
  renderer_.end_frame();
}

void RenderLoop::finish_frame(std::int64_t begin_ns, bool for_disk) {
  const std::int64_t end_ns = pace_.now_ns();
  account_.finish(end_ns);
  if (log_) log_->push({begin_ns, account_.last_period_ns(), account_.last_compute_ns(), 0});
  const double cost_s = 1e-9 * static_cast<double>(end_ns - begin_ns);
  const double counted_s = counted_cost_s(cost_s, thread_time_s() - begin_thread_s_, kDrawingDuty);
  for_disk ? schedule_.took(cost_s) : control_.record(seconds_since_begin(begin_ns), counted_s);
  watch_.shown(*inbox_, end_ns);
  if (end_ns >= next_status_ns_) tell_status(end_ns);
}

void RenderLoop::steer(const Input& input) {
  if (choices_.endoscope) return;  // the orbit camera is out of sight; who drags means what is seen
  const Size size = renderer_.size();
  const double per_pixel = 1.0 / size.height;
  Camera& orbit = choices_.orbit;
  if (input.orbit_x != 0 || input.orbit_y != 0) {
    orbit = orbited(orbit, -kTurnPerHeight * per_pixel * input.orbit_x,
                    kTurnPerHeight * per_pixel * input.orbit_y);
  }
  if (input.pan_x != 0 || input.pan_y != 0) {
    orbit = panned(orbit, per_pixel * input.pan_x, -per_pixel * input.pan_y);
  }
  const double radius = view_.ball().radius;
  if (input.zoom != 0) orbit = zoomed(orbit, input.zoom, kNearestRadii * radius, kFarthestRadii * radius);
}

void RenderLoop::obey(const PanelActions& actions) {
  if (actions.start) command(msg::COMMAND_START);
  if (actions.pause) command(msg::COMMAND_PAUSE);
  if (actions.reset) command(msg::COMMAND_RESET);
  if (actions.clear_fault) command(msg::COMMAND_CLEAR_FAULT);
  if (actions.record) command(msg::COMMAND_RECORD, node::kRecordOn);
  if (actions.stop_recording) command(msg::COMMAND_RECORD, node::kRecordOff);
  choose(actions, choices_);
  help_ ^= actions.switch_help;
  if (actions.switch_map) show_map(next(choices_.map));
}

void RenderLoop::show_map(TissueMap map) {
  choices_.map = map;
  watch_.show_as(map);
  view_.forget_map();
  inbox_->read_stress(map != TissueMap::kOff);
}

void RenderLoop::command(std::uint32_t command, const std::string& argument) {
  msg::SessionCommand order = inbox_->orders().issue(command, status_.instance);
  order.argument = argument;
  if (!command_writer_->write(order)) faults_.raise("a command could not be sent");
}

PanelView RenderLoop::panel_view(std::int64_t now_ns) const {
  PanelView panel;
  panel.interactive = renderer_.has_window();
  panel.touches = touches_->row();
  tell(choices_, panel);
  panel.has_tube = view_.has_tube();
  panel.shows_help = help_;
  panel.recording = recorder_.row(seconds_since_begin(now_ns));
  panel.full_stress_pa = watch_.full_stress_pa();
  panel.exposed_organ = exposed_organ_;
  panel.exposed_share = exposure_.newest;
  panel.mouse_help = pointer_->rays().help();
  panel.picture = rate_words(control_, view_.has_tube());
  watch_.describe(view_, now_ns, panel);
  return panel;
}

void RenderLoop::tell_status(std::int64_t now_ns) {
  next_status_ns_ = now_ns + kStatusPeriod_ns;
  status_.echoes = watch_.echoes();
  inbox_->orders().tell(status_);
  status_.paused = watch_.paused(now_ns);  // as the panel shows it
  node::fill_status(account_.record(), faults_, status_);
  status_writer_->write(status_);
}

nlohmann::json RenderLoop::report() const {
  const runtime::LoopRecord& record = account_.record();
  std::int32_t removed = 0;
  for (std::size_t i = 0; i < view_.organ_count(); ++i) removed += view_.removed_count(i);
  nlohmann::json report{{"dds", options_.node.dds},
                        {"frames", record.ticks},
                        {"frame_us", runtime::to_json(record.compute.percentiles())},
                        {"deepest_dent_m", watch_.largest_dent_m()},
                        {"organ_states", to_json(inbox_->state_counts())},
                        {"unmatched_states", watch_.unmatched_states()},
                        {"removed_tetrahedra", removed},
                        {"closed", closed_},
                        {"videos", recorder_.report()},
                        {"picture", pictures_.to_json(control_)},
                        {"faults", faults_.lines()}};
  if (to_expose_) report["exposed_share"] = to_json(exposure_);
  if (exercise_) report["camera"] = exercise_->report();
  if (nlohmann::json trocars = watch_.trocar_report(); !trocars.empty())
    report["trocars"] = std::move(trocars);
  return report;
}

}  // namespace omentum::render
