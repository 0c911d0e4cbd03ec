// What render_node knows of its session at this moment.
#pragma once

#include "node_common/loaded_scene.h"
#include "render_node/force_history.h"
#include "render_node/inbox.h"
#include "render_node/node_forces.h"
#include "render_node/panel_view.h"
#include "render_node/scene_view.h"
#include "render_node/trocar_watch.h"
#include "runtime/histogram.h"

namespace omentum::render {

/// Where an organ's law is tissue's: its model's, but what falls goes far, and what turns with its tissue
/// may, so that neither is linear in displacements.
scene::Trusted trusted_of(const scene::OrganSpec& organ);

/// Takes from the inbox what came, moves the drawn organs, and says what the panel shows. Reads no clock:
/// times are given (steady clock, ns). One thread, the drawing one.
class SessionWatch {
 public:
  SessionWatch(const scene::Scene& scene, const std::vector<LoadedOrgan>& organs, std::int64_t begin_ns);

  /// What came since the last call. Throws std::runtime_error when deform_node serves another scene, within
  /// node::kSettled_s of the beginning; later such a scene is a fault.
  void listen(Inbox& inbox, SceneView& view, runtime::FaultList& faults, std::int64_t now_ns);
  /// What states are shown as from the next one on (Inbox::read_stress), and where that scale ends, Pa.
  void show_as(TissueMap map);
  double full_stress_pa() const { return full_stress_pa_; }
  /// The state of the last listen() is on the screen.
  void shown(const Inbox& inbox, std::int64_t now_ns);

  const std::vector<ToolNow>& tools() const { return tools_; }
  /// The newest pose of each tool in what is drawn.
  std::vector<msg::Echo> echoes() const { return merge_echoes(echoes_); }
  /// What haptic_node says of itself; where none speaks, what was commanded last.
  bool paused(std::int64_t now_ns) const;
  /// Of this moment, in any organ.
  const std::optional<Dent>& deepest_dent() const { return dent_; }
  /// Of the whole session, m.
  double largest_dent_m() const { return largest_dent_m_; }
  /// {"tool", "largest_miss_mm"} of each tool with a trocar that was seen (trocar_watch.h).
  nlohmann::json trocar_report() const;
  /// States that were not drawn because of their topology (inbox.h).
  std::uint64_t unmatched_states() const { return unmatched_states_; }

  /// Fills in everything but what the person at the window chose.
  void describe(const SceneView& view, std::int64_t now_ns, PanelView& panel) const;

 private:
  void listen_to_scene(Inbox& inbox, runtime::FaultList& faults, std::int64_t now_ns) const;
  void listen_to_organs(Inbox& inbox, SceneView& view, runtime::FaultList& faults, std::int64_t now_ns);
  void listen_to_tool(Inbox& inbox, std::size_t tool, std::int64_t now_ns);
  void listen_to_contact(Inbox& inbox, std::size_t tool, std::int64_t now_ns);
  std::span<const float> shares_of(const AssembledState& state);
  static void draw_contact(const msg::Contact& contact, ToolNow& now);
  void find_deepest_dent(const SceneView& view, std::int64_t now_ns);
  double since_listened_s(std::int64_t now_ns) const {
    return 1e-9 * static_cast<double>(now_ns - listened_ns_);
  }
  double seconds_since_begin(std::int64_t now_ns) const {
    return 1e-9 * static_cast<double>(now_ns - begin_ns_);
  }

  std::string scene_name_;
  std::vector<std::uint32_t> ids_;    // of the scene's tools
  double max_force_n_;                // of the scene
  std::vector<TrocarWatch> trocars_;  // per tool
  node::LoadedScene loaded_;
  std::int64_t begin_ns_, listened_ns_;
  std::vector<NodeForce> forces_;  // on an organ, workspace
  std::vector<ToolNow> tools_;
  std::vector<ToolRow> rows_;
  std::vector<ForceHistory> histories_;
  std::vector<LoadedOrgan> organs_;
  std::vector<std::vector<msg::Echo>> echoes_;  // per organ, of the state that is drawn
  std::vector<std::int64_t> state_arrived_ns_;  // per organ; 0: none came
  TissueMap map_ = TissueMap::kOff;
  double full_stress_pa_;
  std::vector<scene::Trusted> trusted_;             // per organ
  std::vector<std::optional<double>> strained_;     // per organ: the largest strain, where it is known
  std::vector<std::optional<double>> stressed_pa_;  // likewise
  std::vector<float> shares_;                       // of a map, workspace
  bool fresh_echoes_ = false;                       // since the last frame
  std::optional<Dent> dent_;
  double largest_dent_m_ = 0;
  std::vector<HeardStatus> statuses_;
  bool ordered_to_pause_ = false;
  std::uint64_t incomplete_states_ = 0, unmatched_states_ = 0;
  runtime::Histogram hand_to_picture_;
};

}  // namespace omentum::render
