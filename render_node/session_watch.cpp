#include "render_node/session_watch.h"

#include "node_common/contact_bounds.h"
#include "node_common/rivals.h"
#include "node_common/vectors.h"
#include "render_node/plausible.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace omentum::render {
namespace {

constexpr std::int64_t kToolGone_ns =
    1'000'000'000;  // a pose this old: the device has left, its tool is not drawn
constexpr std::int64_t kForceGone_ns = 250'000'000;  // a force this old is nobody's any more

double largest_young_pa(const scene::Scene& scene) {
  double largest = 0;
  for (const scene::OrganSpec& organ : scene.organs) largest = std::max(largest, organ.young_pa);
  return largest;
}

std::vector<scene::Trusted> all_trusted(const scene::Scene& scene) {
  std::vector<scene::Trusted> trusted;
  for (const scene::OrganSpec& organ : scene.organs) trusted.push_back(trusted_of(organ));
  return trusted;
}

std::optional<double> largest_of(const std::vector<float>& values) {
  if (values.empty()) return std::nullopt;
  return *std::ranges::max_element(values);
}

std::vector<msg::OrganInfo> infos_of(const std::vector<LoadedOrgan>& organs) {
  std::vector<msg::OrganInfo> infos;
  for (const LoadedOrgan& organ : organs)
    infos.push_back({.name = organ.name, .hash = organ.hash, .kind = organ.state_kind});
  return infos;
}

}  // namespace

scene::Trusted trusted_of(const scene::OrganSpec& organ) {
  const bool turns =
      organ.dynamics && (organ.dynamics->pieces == "fall" || organ.dynamics->law == "corotational");
  const auto model = std::ranges::find(scene::kOrganModels, organ.model, &scene::OrganModelWord::word);
  return turns ? scene::Trusted::kSmallStrains : model->trusted;
}

SessionWatch::SessionWatch(const scene::Scene& scene, const std::vector<LoadedOrgan>& organs,
                           std::int64_t begin_ns)
    : scene_name_(scene.name),
      max_force_n_(scene.haptics.max_force_n),
      loaded_(node::loaded_scene(scene, infos_of(organs))),
      begin_ns_(begin_ns),
      listened_ns_(begin_ns),
      tools_(scene.tools.size()),
      rows_(scene.tools.size()),
      histories_(scene.tools.size()),
      organs_(organs),
      echoes_(organs.size()),
      state_arrived_ns_(organs.size(), 0),
      full_stress_pa_(render::full_stress_pa(largest_young_pa(scene))),
      trusted_(all_trusted(scene)),
      strained_(organs.size()),
      stressed_pa_(organs.size()) {
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    ids_.push_back(scene.tools[t].id);
    rows_[t].name = scene.tools[t].name;
    rows_[t].colour = tool_colour(scene.tools[t].id);
    trocars_.emplace_back(scene.tools[t].trocar);
  }
}

void SessionWatch::listen(Inbox& inbox, SceneView& view, runtime::FaultList& faults, std::int64_t now_ns) {
  listen_to_scene(inbox, faults, now_ns);
  listen_to_organs(inbox, view, faults, now_ns);
  for (std::size_t t = 0; t < tools_.size(); ++t) listen_to_tool(inbox, t, now_ns);
  view.smoke(tools_, since_listened_s(now_ns));
  listened_ns_ = now_ns;
  find_deepest_dent(view, now_ns);
  statuses_ = inbox.statuses();
  incomplete_states_ = inbox.incomplete_states();
  unmatched_states_ = inbox.unmatched_states();
  ordered_to_pause_ = inbox.orders().paused();
  if (inbox.orders().take_reset()) {
    for (ForceHistory& history : histories_) history.clear();
  }
}

void SessionWatch::listen_to_scene(Inbox& inbox, runtime::FaultList& faults, std::int64_t now_ns) const {
  if (const msg::SceneInfo* info = inbox.fetch_scene_info()) {
    const auto why = node::contradicts(loaded_, *info);
    if (why && seconds_since_begin(now_ns) <= node::kSettled_s) throw std::runtime_error(*why);
    if (why) faults.raise(node::kForeignScene);
  }
}

void SessionWatch::listen_to_organs(Inbox& inbox, SceneView& view, runtime::FaultList& faults,
                                    std::int64_t now_ns) {
  for (std::size_t i = 0; i < echoes_.size(); ++i) {
    forces_on(i, ids_, now_ns - kForceGone_ns, max_force_n_, inbox, forces_);
    view.live(i, forces_, since_listened_s(now_ns));
    const AssembledState* state = inbox.fetch_state(i);
    if (!state) {
      view.refresh(i);
      continue;
    }
    if (!view.show(i, state->removed, state->values, shares_of(*state))) {
      faults.raise(kMisfitState);
      continue;
    }
    strained_[i] = largest_of(state->strain);
    stressed_pa_[i] = largest_of(state->stress_pa);
    echoes_[i] = state->echoes;
    state_arrived_ns_[i] = now_ns;
    fresh_echoes_ = true;
  }
}

void SessionWatch::show_as(TissueMap map) {
  map_ = map;
}

std::span<const float> SessionWatch::shares_of(const AssembledState& state) {
  shares_ = map_ == TissueMap::kStress ? state.stress_pa : state.strain;
  if (map_ == TissueMap::kOff) shares_.clear();
  const double full = map_ == TissueMap::kStress ? full_stress_pa_ : static_cast<double>(kFullStrain);
  for (float& share : shares_) share = full > 0 ? share / static_cast<float>(full) : 0.0f;
  return shares_;
}

void SessionWatch::listen_to_tool(Inbox& inbox, std::size_t tool, std::int64_t now_ns) {
  ToolNow& now = tools_[tool];
  transport::Arrived<msg::ToolPose> pose;
  now.seen = inbox.pose(ids_[tool], pose) && pose.age_ns(now_ns) < kToolGone_ns && pose.sample.valid &&
             is_plausible(pose.sample);
  if (now.seen) {
    const auto& q = pose.sample.orientation;
    now.p_WT = node::to_vector(pose.sample.position);
    now.q_WT = trocars_[tool].follow(now.p_WT, Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized());
    now.grip_rad = pose.sample.grip;
    now.cuts = (pose.sample.buttons & msg::BUTTON_CUT) != 0 && pose.age_ns(now_ns) < kForceGone_ns;
  }
  transport::Arrived<msg::ToolForce> force;
  const bool felt = inbox.force(ids_[tool], force) && force.age_ns(now_ns) < kForceGone_ns &&
                    is_plausible(force.sample, max_force_n_);
  now.force_n = felt ? node::to_vector(force.sample.force) : Vec3::Zero();
  now.contact_nodes.clear();
  now.contact_forces_n.clear();
  inbox.force_peaks().believe_up_to(max_force_n_);
  rows_[tool].most_n = static_cast<float>(inbox.force_peaks().peak_n(ids_[tool]));
  now.burning_at.reset();
  rows_[tool].present = now.seen;
  rows_[tool].state = force_state_words(felt ? force.sample.state : 0);
  if (now.seen && trocars_[tool].misses()) rows_[tool].state.emplace_back("off its trocar");
  rows_[tool].fault = felt && (force.sample.state & msg::FORCE_FAULT) != 0;
  if (felt) {
    listen_to_contact(inbox, tool, now_ns);
  } else {
    histories_[tool].interrupt();
  }
}

void SessionWatch::listen_to_contact(Inbox& inbox, std::size_t tool, std::int64_t now_ns) {
  ToolNow& now = tools_[tool];
  histories_[tool].add(seconds_since_begin(now_ns), now.force_n.norm());
  // a tool is drawn with the organ that it presses hardest
  double most_n = -1;
  for (std::size_t organ = 0; organ < loaded_.organ_count; ++organ) {
    const auto& [contact, arrived_ns] = inbox.contact(organ, ids_[tool]);
    if (now_ns - arrived_ns > kForceGone_ns)
      continue;  // haptic_node tells an organ that was left for a while only
    if (contact.cutting)
      now.burning_at = 0.5 * (node::to_vector(contact.edge.begin) + node::to_vector(contact.edge.end));
    const double total_n = node::total_force_n(contact);
    if (contact.nodes.empty() || !is_plausible(contact, max_force_n_) || total_n <= most_n) continue;
    most_n = total_n;
    draw_contact(contact, now);
  }
}

void SessionWatch::draw_contact(const msg::Contact& contact, ToolNow& now) {
  now.contact_organ = contact.organ;
  now.contact_nodes = contact.nodes;
  now.contact_forces_n.clear();
  for (const msg::Vec3& on_node : contact.forces) {
    now.contact_forces_n.push_back(static_cast<float>(node::to_vector(on_node).norm()));
  }
}

void SessionWatch::find_deepest_dent(const SceneView& view, std::int64_t now_ns) {
  dent_.reset();
  for (const ToolNow& tool : tools_) {
    // a tool of now and an organ of then make no dent
    if (tool.contact_organ >= loaded_.organ_count ||
        now_ns - state_arrived_ns_[tool.contact_organ] > OrganRow::kStaleState_ns)
      continue;
    const auto dent = view.dent_of(tool);
    if (dent && (!dent_ || dent->depth_m > dent_->depth_m)) dent_ = dent;
  }
  if (dent_) largest_dent_m_ = std::max(largest_dent_m_, dent_->depth_m);
}

void SessionWatch::shown(const Inbox& inbox, std::int64_t now_ns) {
  if (!fresh_echoes_) return;
  fresh_echoes_ = false;
  for (const msg::Echo& echo : echoes()) {
    if (const auto arrived = inbox.arrival_of(echo.tool, echo.seq))
      hand_to_picture_.add_ns(now_ns - *arrived);
  }
}

nlohmann::json SessionWatch::trocar_report() const {
  nlohmann::json report = nlohmann::json::array();
  for (std::size_t t = 0; t < trocars_.size(); ++t)
    if (trocars_[t].largest_miss_m())
      report.push_back({{"tool", ids_[t]}, {"largest_miss_mm", 1e3 * *trocars_[t].largest_miss_m()}});
  return report;
}

bool SessionWatch::paused(std::int64_t now_ns) const {
  return haptic_paused(statuses_, now_ns).value_or(ordered_to_pause_);
}

void SessionWatch::describe(const SceneView& view, std::int64_t now_ns, PanelView& panel) const {
  panel.scene = scene_name_;
  panel.time_s = seconds_since_begin(now_ns);
  panel.paused = paused(now_ns);
  panel.nodes = node_rows(statuses_, now_ns);
  panel.tools = rows_;
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    panel.tools[t].force_n = static_cast<float>(tools_[t].force_n.norm());
    panel.tools[t].largest_n = histories_[t].largest_n();
    panel.tools[t].curve = histories_[t].samples();
  }
  const msg::Percentiles round_trip = device_round_trip(statuses_);
  panel.hand_to_force_us = round_trip.p50;
  panel.hand_to_force_p99_us = round_trip.p99;
  panel.hand_to_picture_us = hand_to_picture_.percentile_us(0.5);
  panel.hand_to_picture_p99_us = hand_to_picture_.percentile_us(0.99);
  panel.real_time_factor = real_time_factor(statuses_, now_ns);
  panel.dents = false;
  panel.dent_mm = dent_ ? 1e3 * dent_->depth_m : 0;
  for (std::size_t i = 0; i < view.organ_count(); ++i) {
    OrganRow& row = panel.organs.emplace_back();
    if (view.organ_count() > 1) row.name = loaded_.organs[i].name;
    row.known = state_arrived_ns_[i] > 0;
    row.nodes = organs_[i].node_count;
    row.tetrahedra = organs_[i].tetrahedron_count;
    row.removed_tetrahedra = view.removed_count(i);
    row.length_mm = 1e3 * view.length_m(i);
    row.age_ns = now_ns - std::max(state_arrived_ns_[i], begin_ns_);
    row.mapped = view.mapped(i);
    row.trusted = trusted_[i];
    row.strained = strained_[i];
    row.stressed_pa = stressed_pa_[i];
    if (const PressedSurface* surface = view.surface(i)) {
      panel.dents = true;
      row.moved_mm = 1e3 * surface->skin.largest_displacement_m();
      row.limit_mm = 1e3 * kLinearShare * surface->skin.extent_m();
    }
  }
  panel.incomplete_states = incomplete_states_;
  panel.faults = all_faults(statuses_);
}

}  // namespace omentum::render
