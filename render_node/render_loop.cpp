#include "render_node/render_loop.h"

#include "node/node_identity.h"
#include "organ/organ.h"
#include "runtime/clock.h"
#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omentum::render {
namespace {

constexpr double kPicturePeriodS = 2;                  // off-screen, unless asked otherwise
constexpr std::int64_t kStatusPeriodNs = 100'000'000;  // DESIGN 2: 1-10 Hz
constexpr std::int64_t kToolGoneNs =
    1'000'000'000;  // a pose this old: the device has left, its tool is not drawn
constexpr std::int64_t kForceGoneNs = 250'000'000;  // a force this old is nobody's any more
// The share of the time that drawing may take: the rest of this core belongs to the 1 kHz loops.
constexpr double kDuty = 0.45;
constexpr double kTurnPerHeight = 3.0;  // rad, when the mouse crosses the picture's height
constexpr double kNearestRadii = 0.15, kFarthestRadii = 12;  // of the orbit, in radii of what is seen

OrganShape shape_of(const organ::Organ& organ) {
  return {organ.surface, geometry::surface_positions(organ.mesh, organ.surface),
          organ.surface_of_file_node()};
}

Vec3 to_eigen(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

bool finite(const msg::ToolPose& pose) {
  return to_eigen(pose.position).allFinite() && std::isfinite(pose.grip) &&
         std::isfinite(pose.orientation.w + pose.orientation.x + pose.orientation.y + pose.orientation.z);
}

std::pair<std::vector<LoadedOrgan>, std::vector<OrganShape>> load_organs(const runtime::Scene& scene) {
  std::pair<std::vector<LoadedOrgan>, std::vector<OrganShape>> loaded;
  for (const runtime::OrganSpec& spec : scene.organs) {
    if (spec.file.empty()) {
      throw std::runtime_error(scene.file.string() + ": organ " + spec.name +
                               " has no file; expected a resolved scene or --organ FILE");
    }
    const organ::Organ organ = organ::load_organ(spec.file, organ::Load::kMeshOnly);
    loaded.second.push_back(shape_of(organ));
    loaded.first.push_back({organ.name, organ.hash, loaded.second.back().rest.size()});
  }
  return loaded;
}

double picture_period_s(const RenderOptions& options, bool has_window) {
  if (options.picture_period_s >= 0) return options.picture_period_s;
  return has_window ? 0 : kPicturePeriodS;
}

}  // namespace

RenderLoop::RenderLoop(const RenderOptions& options, Renderer& renderer, runtime::RateLoop& pace)
    : RenderLoop(options, node::load_scene(options.node), renderer, pace) {}

RenderLoop::RenderLoop(const RenderOptions& options, const runtime::Scene& scene, Renderer& renderer,
                       runtime::RateLoop& pace)
    : options_(options),
      scene_(scene),
      loaded_(load_organs(scene_)),
      renderer_(renderer),
      pace_(pace),
      view_(scene_, loaded_.second, renderer),
      tools_(scene_.tools.size()),
      rows_(scene_.tools.size()),
      histories_(scene_.tools.size()),
      echoes_(loaded_.first.size()),
      control_(options.fps, kDuty),
      schedule_(picture_period_s(options, renderer.has_window())),
      account_(std::llround(1e9 / options.fps)),
      status_(node::introduce(msg::NODE_RENDER, options.fps)),
      bus_(node::open_bus(options.node, "render_node")) {
  choices_.orbit = view_.first_camera();
  choices_.endoscope = scene_.camera.mode == "endoscope";
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    rows_[t].name = scene_.tools[t].name;
    rows_[t].colour = tool_colour(scene_.tools[t].id);
  }
  if (!options.out.empty()) writer_ = std::make_unique<PictureWriter>(options.out, faults_);
  if (!options.node.log.empty()) {
    log_ = std::make_unique<runtime::LoopLog>(options.node.log);
    pace_.log_to(*log_);
  }
  status_writer_ = bus_->writer<msg::NodeStatus>();
  command_writer_ = bus_->writer<msg::SessionCommand>();
  inbox_ = std::make_unique<Inbox>(*bus_, loaded_.first, faults_);
}

void RenderLoop::run() {
  begin_ns_ = runtime::steady_now_ns();
  while (pace_.wait() != runtime::RateLoop::Cause::kStopped) {
    const double time_s = 1e-9 * static_cast<double>(runtime::steady_now_ns() - begin_ns_);
    if (options_.seconds > 0 && time_s >= options_.seconds) break;
    if (!control_.due(time_s)) continue;
    const bool open = frame(writer_ ? schedule_.due(time_s, deepest_m()) : std::vector<std::string>{});
    pace_.finish_tick();
    if (!open) break;
  }
  if (writer_) frame({"final.png"});
  writer_.reset();
}

bool RenderLoop::frame(const std::vector<std::string>& pictures) {
  const std::int64_t begin_ns = runtime::steady_now_ns();
  account_.start(begin_ns);
  listen();
  const Input input = renderer_.begin_frame();
  steer(input);
  if (!options_.no_panel) obey(lay_out_panel(panel_view(begin_ns)));
  const double covered = options_.no_panel ? 0 : (kPanelWidth + kPanelMargin) / renderer_.size().width;
  Frame frame = view_.frame(choices_, tools_, covered);
  frame.quality = pictures.empty() ? control_.quality() : Quality::kFine;
  renderer_.draw(frame);
  if (!pictures.empty()) writer_->write(renderer_.read_back(), pictures);
  renderer_.end_frame();
  const std::int64_t end_ns = runtime::steady_now_ns();
  account_.finish(end_ns);
  if (pictures.empty())
    control_.record(1e-9 * static_cast<double>(begin_ns - begin_ns_), 1e-9 * (end_ns - begin_ns));
  shown(end_ns);
  return !input.close;
}

void RenderLoop::listen() {
  const std::int64_t now_ns = runtime::steady_now_ns();
  if (const msg::SceneInfo* info = inbox_->fetch_scene_info()) check_scene_info(*info, loaded_.first);
  if (const msg::Topology* topology = inbox_->fetch_topology(); topology && topology->version > 0) {
    faults_.raise("an organ was cut, but this render_node draws whole organs only");
  }
  listen_to_organs();
  for (std::size_t t = 0; t < tools_.size(); ++t) listen_to_tool(t, now_ns);
  const std::uint64_t resets = session_.resets;
  session_ = inbox_->session();
  if (session_.resets != resets) {
    for (ForceHistory& history : histories_) history.clear();
  }
}

void RenderLoop::listen_to_organs() {
  for (std::size_t i = 0; i < echoes_.size(); ++i) {
    const AssembledState* state = inbox_->fetch_state(i);
    if (!state) continue;
    view_.deform(i, state->displacements);
    echoes_[i] = state->echoes;
    fresh_echoes_ = true;
  }
}

void RenderLoop::listen_to_tool(std::size_t tool, std::int64_t now_ns) {
  const std::uint32_t id = scene_.tools[tool].id;
  ToolNow& now = tools_[tool];
  ToolRow& row = rows_[tool];
  transport::Arrived<msg::ToolPose> pose;
  now.seen =
      inbox_->pose(id, pose) && pose.age_ns(now_ns) < kToolGoneNs && pose.sample.valid && finite(pose.sample);
  if (now.seen) {
    const auto& q = pose.sample.orientation;
    now.p_WT = to_eigen(pose.sample.position);
    now.q_WT = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
    now.grip_rad = pose.sample.grip;
  }
  transport::Arrived<msg::ToolForce> force;
  const bool felt = inbox_->force(id, force) && force.age_ns(now_ns) < kForceGoneNs;
  now.force_n = felt ? to_eigen(force.sample.force) : Vec3::Zero();
  now.contact_nodes.clear();
  row.present = now.seen;
  row.state = force_state_words(felt ? force.sample.state : 0);
  row.fault = felt && (force.sample.state & msg::FORCE_FAULT) != 0;
  if (!felt) return;
  histories_[tool].add(1e-9 * static_cast<double>(now_ns - begin_ns_), now.force_n.norm());
  if (const auto arrived = inbox_->arrival_of(id, force.sample.echo_seq)) {
    hand_to_force_.add_ns(force.arrived_ns - *arrived);
  }
  const msg::Contact& contact = inbox_->contact(id);
  now.contact_organ = contact.organ;
  now.contact_nodes = contact.nodes;
}

void RenderLoop::steer(const Input& input) {
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
  choices_.endoscope ^= actions.switch_camera;
  choices_.arrows ^= actions.switch_arrows;
  choices_.markers ^= actions.switch_markers;
}

void RenderLoop::command(std::uint32_t command) {
  // the stamp orders commands of different senders
  const msg::SessionCommand message{
      .seq = static_cast<std::uint64_t>(runtime::steady_now_ns()), .command = command, .argument = {}};
  if (!command_writer_->write(message)) faults_.raise("a command could not be sent");
}

bool RenderLoop::paused() const {
  if (session_.last_seq > 0) return session_.paused;
  // who joined late asks the one that obeys
  return std::any_of(statuses_.begin(), statuses_.end(), [](const HeardStatus& heard) {
    return heard.status.kind == msg::NODE_HAPTIC && heard.status.paused;
  });
}

double RenderLoop::deepest_m() const {
  double deepest = 0;
  for (std::size_t i = 0; i < view_.organ_count(); ++i)
    deepest = std::max(deepest, view_.skin(i).deepest_m());
  return deepest;
}

PanelView RenderLoop::panel_view(std::int64_t now_ns) const {
  PanelView panel;
  panel.scene = scene_.name;
  panel.time_s = 1e-9 * static_cast<double>(now_ns - begin_ns_);
  panel.paused = paused();
  panel.interactive = renderer_.has_window();
  panel.endoscope = choices_.endoscope;
  panel.arrows = choices_.arrows;
  panel.markers = choices_.markers;
  panel.nodes = node_rows(statuses_, now_ns);
  panel.tools = rows_;
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    panel.tools[t].force_n = static_cast<float>(tools_[t].force_n.norm());
    panel.tools[t].largest_n = histories_[t].largest_n();
    panel.tools[t].curve = histories_[t].samples();
  }
  panel.hand_to_force_us = hand_to_force_.percentile_us(0.5);
  panel.hand_to_force_p99_us = hand_to_force_.percentile_us(0.99);
  panel.hand_to_picture_us = hand_to_picture_.percentile_us(0.5);
  panel.hand_to_picture_p99_us = hand_to_picture_.percentile_us(0.99);
  for (std::size_t i = 0; i < view_.organ_count(); ++i) {
    const OrganSkin& skin = view_.skin(i);
    if (i > 0 && 1e3 * skin.deepest_m() <= panel.deepest_mm) continue;
    panel.deepest_mm = 1e3 * skin.deepest_m();
    panel.linear_limit_mm = 1e3 * kLinearShare * skin.extent_m();
  }
  panel.incomplete_states = inbox_->incomplete_states();
  panel.faults = all_faults(statuses_);
  return panel;
}

void RenderLoop::shown(std::int64_t now_ns) {
  statuses_ = inbox_->statuses();
  status_.echoes = merge_echoes(echoes_);
  if (fresh_echoes_) {
    for (const msg::Echo& echo : status_.echoes) {
      if (const auto arrived = inbox_->arrival_of(echo.tool, echo.seq))
        hand_to_picture_.add_ns(now_ns - *arrived);
    }
  }
  fresh_echoes_ = false;
  if (now_ns < next_status_ns_) return;
  next_status_ns_ = now_ns + kStatusPeriodNs;
  status_.paused = paused();
  node::fill_status(account_.record(), faults_, status_);
  status_writer_->write(status_);
}

nlohmann::json RenderLoop::report() const {
  const runtime::LoopRecord& record = account_.record();
  return {{"dds", options_.node.dds},
          {"frames", record.ticks},
          {"frame_us", runtime::to_json(record.compute.percentiles())},
          {"faults", faults_.lines()}};
}

}  // namespace omentum::render
