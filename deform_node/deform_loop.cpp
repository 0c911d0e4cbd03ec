#include "deform_node/deform_loop.h"

#include "files/console.h"
#include "node_common/node_identity.h"
#include "runtime/report.h"
#include "transport/topics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::deform {

namespace {

constexpr double kStatusRate_hz = 10;  // docs/topics.md: 1-10 Hz

// How long to listen for a scene that is served already, ns: haptic_node listens as long, so that this delays
// no force, and the first picture by a second.
constexpr std::int64_t kListen_ns = 1'000'000'000;
constexpr auto kSettled_ns = static_cast<std::int64_t>(1e9 * node::kSettled_s);

// whoever writes statuses must not fill a terminal
void say_once(bool& said, const char* what) {
  if (!std::exchange(said, true)) files::say(std::string("deform_node: ").append(what));
}

nlohmann::json to_json(const CutAccount& cuts) {
  const double way_cm = 1e2 * cuts.way_m, lost_cm3 = 1e6 * cuts.lost_m3;
  return {
      {"way_cm", way_cm}, {"lost_cm3", lost_cm3}, {"lost_cm3_per_cm", way_cm > 0 ? lost_cm3 / way_cm : 0}};
}

nlohmann::json to_json(const CollisionAccount& collisions) {
  return {{"contacts", collisions.contacts},
          {"held_back", collisions.held_back},
          {"left_out", collisions.left_out},
          {"deepest_overlap_m", collisions.deepest_m}};
}

}  // namespace

DeformLoop::DeformLoop(const DeformOptions& options, const transport::OpenBus& open_bus, runtime::Pace& loop)
    : options_(options),
      scene_(node::load_scene(options.node)),
      organs_(load_organs(scene_, options.models), faults_),
      book_(numbers_of_all(organs_.organs()), bounds_of(scene_), faults_),
      score_(scored_cut(scene_, organs_.organs())),
      loop_(loop),
      loaded_(node::loaded_scene(scene_, describe(organs_.organs()))),
      journal_(open_journal()),
      start_ns_(loop_.now_ns()),
      orders_(start_ns_),
      refusal_(loop),
      own_(node::introduce(msg::NODE_DEFORM, options.rate_hz)),
      standby_(own_.instance),
      bus_(open_bus()) {
  if (!options.node.log.empty()) {
    log_ = std::make_unique<runtime::LoopLog>(options.node.log);
    loop_.log_to(*log_);
  }
  open_writers();
  open_readers();
}

std::unique_ptr<CutJournal> DeformLoop::open_journal() {
  if (options_.journal.empty()) return nullptr;
  auto journal =
      std::make_unique<CutJournal>(options_.journal, journal_scene(loaded_.hash, organs_.organs()), faults_);
  organs_.take_up(journal->read(), book_);
  return journal;
}

void DeformLoop::open_writers() {
  const auto on_wake = [this](std::function<void()> work) { return loop_.on_wake(std::move(work)); };
  const transport::Profile profile = transport::parse_profile(options_.node.profile);
  scene_writer_ = bus_->writer<msg::SceneInfo>();
  topology_writer_ = bus_->writer<msg::Topology>();
  state_writer_ = bus_->writer<msg::OrganState>();
  status_writer_ = bus_->writer<msg::NodeStatus>();
  stress_writer_ = bus_->writer<msg::OrganStress>();
  publisher_ = std::make_unique<StatePublisher>(
      StateWriters{*scene_writer_, *topology_writer_, *state_writer_, *status_writer_, journal_.get()},
      organs_.organs(), nodes_per_block(profile), node::to_message(loaded_, scene_.name), own_, faults_,
      on_wake);
  stress_publisher_ = std::make_unique<StressPublisher>(*stress_writer_, organs_.organs(),
                                                        nodes_per_block(profile), options_.rate_hz, on_wake);
  touch_writer_ = bus_->writer<msg::TouchingPairs>();
  touch_publisher_ = std::make_unique<TouchPublisher>(
      *touch_writer_, organs_, transport::touching_block_pairs(profile), options_.rate_hz, on_wake);
  if (offers_local_models(organs_.organs())) {
    local_writer_ = bus_->writer<msg::LocalModel>();
    local_publisher_ = std::make_unique<LocalPublisher>(*local_writer_, organs_.organs(),
                                                        transport::local_model_nodes(profile), on_wake);
  }
}

void DeformLoop::open_readers() {
  if (local_publisher_)
    tool_places_ = std::make_unique<ToolPlaces>(*bus_, scene_, [this] { return loop_.now_ns(); });
  contact_reader_ = bus_->reader<msg::Contact>(
      [this](const msg::Contact& contact) { book_.take(contact, loop_.now_ns()); });
  command_reader_ = bus_->reader<msg::SessionCommand>(
      [this](const msg::SessionCommand& command) { orders_.hear(command, loop_.now_ns()); });
  scene_reader_ = bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& other) { hear(other); });
  node_reader_ = bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& other) {
    const std::int64_t now_ns = loop_.now_ns();
    orders_.hear(other, now_ns);
    standby_.hear(other, now_ns);
  });
}

void DeformLoop::run() {
  while (loop_.wait() != runtime::Pace::Cause::kStopped) {
    if (loop_.now_ns() - start_ns_ >= kListen_ns) serve_or_stand_by();
    loop_.finish_tick();
  }
  refusal_.throw_if_any();
}

void DeformLoop::require_written() {
  if (log_) log_->finish();
}

void DeformLoop::serve_or_stand_by() {
  const bool other_serves = standby_.other_serves(loop_.now_ns());
  if (other_serves && role_ != Role::kStandingBy) stand_by();
  if (!other_serves && role_ != Role::kServing) take_up();
  if (role_ == Role::kServing) tick();
}

void DeformLoop::take_up() {
  if (role_ == Role::kStandingBy) {
    say_once(told_serving_, "the other one fell silent, this one serves");
    if (journal_) organs_.take_up(journal_->read(), book_);  // the other one may have cut on
  }
  time_.note(loop_.now_ns(), organs_.simulated_s(), true);
  owed_.forgive(loop_.record().missed);
  book_.forget_cuts(loop_.now_ns());
  role_ = Role::kServing;
}

void DeformLoop::stand_by() {
  say_once(told_standing_by_, "another deform_node serves this scene, this one stands by");
  if (role_ == Role::kServing) faults_.raise("scene: another deform_node serves it as well, left to it");
  role_ = Role::kStandingBy;
  standby_.stepped_back();
}

void DeformLoop::hear(const msg::SceneInfo& other) {
  auto why = node::contradicts(loaded_, other);
  if (!why) return;
  if (loop_.now_ns() - start_ns_ > kSettled_ns) {
    faults_.raise(node::kForeignScene);
  } else {
    refusal_.because(*std::move(why));
  }
}

void DeformLoop::tick() noexcept {
  obey();
  const std::int64_t now_ns = loop_.now_ns();
  book_.advance(now_ns);
  live_on();
  if (local_publisher_) local_publisher_->offer(tool_places_->find(now_ns), book_.echoes(), now_ns);
  const auto ticks_per_status = std::max<std::uint64_t>(1, std::lround(options_.rate_hz / kStatusRate_hz));
  if (ticks_++ % ticks_per_status == 0) take_figures();
  publish(now_ns);
  in_time_ = static_cast<double>(loop_.now_ns() - now_ns) < 1e9 / options_.rate_hz;
}

void DeformLoop::live_on() noexcept {
  const std::uint64_t missed = loop_.record().missed;
  if (orders_.paused()) {
    owed_.forgive(missed);
  } else {
    organs_.step(book_, owed_.take(missed, in_time_) / options_.rate_hz);
    score();
  }
}

void DeformLoop::score() noexcept {
  if (!score_.score) return;
  const OrganModel& model = *organs_.organs()[score_.organ].model;
  score_.score->follow(book_.cuts(score_.organ), model.view(), model.status().cuts.tools,
                       1e-9 * static_cast<double>(loop_.now_ns() - start_ns_));
}

void DeformLoop::obey() noexcept {
  if (!orders_.take_reset()) return;
  book_.forget(loop_.now_ns());
  organs_.reset(book_);
  if (score_.score) score_.score->reset();
}

void DeformLoop::take_figures() noexcept {
  const runtime::LoopRecord& record = loop_.record();
  orders_.tell(own_);
  time_.note(loop_.now_ns(), organs_.simulated_s(), orders_.paused());
  figures_ = {.number = figures_.number + 1,
              .paused = own_.paused,
              .newest_order = own_.newest_order,
              .ticks = record.ticks,
              .missed = record.missed,
              .period_us = node::to_message(record.period.percentiles()),
              .compute_us = node::to_message(record.compute.percentiles()),
              .real_time_factor = time_.recent()};
  own_.ticks = record.ticks;
  standby_.serving(own_);
}

void DeformLoop::publish(std::int64_t now_ns) noexcept {
  TickSnapshot& tick = publisher_->draft();
  tick.seq = ++states_;
  tick.stamp_ns = now_ns;
  tick.echoes.take(book_.echoes());
  for (std::size_t i = 0; i < tick.organs.size(); ++i) tick.organs[i].take(organs_.organs()[i].model->view());
  tick.figures = figures_;
  publisher_->publish();
  stress_publisher_->offer({.seq = states_, .stamp_ns = now_ns});
  touch_publisher_->offer({.seq = states_, .stamp_ns = now_ns});
}

nlohmann::json DeformLoop::report() const {
  nlohmann::json report{{"dds", options_.node.dds},
                        {"loop", runtime::to_json(loop_.record(), options_.rate_hz)},
                        {"states", states_},
                        {"stress_states", stress_publisher_->measured()},
                        {"touching_moments", touch_publisher_->told()},
                        {"steps", organs_.steps()},
                        {"removed_tetrahedra", organs_.removed_tetrahedra()},
                        {"repaired_tetrahedra", organs_.repaired_tetrahedra()},
                        {"cuts", to_json(organs_.cuts())},
                        {"real_time_factor", time_.overall()},
                        {"faults", faults_.lines()}};
  if (score_.score)
    report["score"] = to_json(score_.score->figures(organs_.organs()[score_.organ].model->view()));
  if (const auto collisions = organs_.collisions()) report["collisions"] = to_json(*collisions);
  return report;
}

}  // namespace omentum::deform
