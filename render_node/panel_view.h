// What the panel says, as data: figures of the nodes, forces, faults.
#pragma once

#include "render_node/force_history.h"
#include "render_node/inbox.h"
#include "render_node/tissue_map.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::render {

/// A node's line.
struct NodeRow {
  std::string name;
  bool silent = false;    // no status for kSilent_ns (inbox.h)
  double rate_hz = 0;     // measured: one over the median period; the configured one before the first tick
  double compute_us = 0;  // median
  std::uint64_t missed = 0;
  bool misses_matter = false;  // of a real-time loop, more than one in a thousand
};

/// A tool's line.
struct ToolRow {
  std::string name;
  Vec3f colour;  // linear
  bool present = false;
  float force_n = 0;
  float largest_n = 0;             // of the curve
  float most_n = 0;                // of the whole session, each sample counted (docs/score.md)
  std::vector<std::string> state;  // what force safety did: "clamped", "stale" ...
  bool fault = false;              // latched, cleared by a person
  std::vector<ForceHistory::Sample> curve;
};

/// Above this strain Hooke's law is a guess: there U - I and Green's strain, of which a material law may be
/// linear in either, differ by a twentieth.
inline constexpr double kSmallStrain = 0.1;

/// An organ's line.
struct OrganRow {
  double moved_mm = 0;  // largest displacement of any of its nodes, the bending of the whole organ included
  double limit_mm = 0;  // up to where linear elasticity is trusted: kLinearShare of its size
  bool known = false;   // a state came
  std::int64_t age_ns = 0;     // of the newest state; where none came, since the start
  std::string name = {};       // empty where the scene has no other
  std::size_t nodes = 0;       // of a state of the uncut organ
  std::size_t tetrahedra = 0;  // of the uncut organ; 0: it has none
  std::int32_t removed_tetrahedra = 0;
  double length_mm = 0;  // of one long tube; 0 of any other

  scene::Trusted trusted = scene::Trusted::kSmallDisplacements;
  // The largest of any of its nodes, while they are read.
  std::optional<double> strained = {}, stressed_pa = {};
  bool mapped = false;  // drawn as the map that is on

  /// Moved too far for a law that is linear in displacements.
  bool beyond_linear() const { return trusted == scene::Trusted::kSmallDisplacements && moved_mm > limit_mm; }
  /// Strained too far for one that moves and turns with the tissue.
  bool beyond_small_strains() const {
    return trusted == scene::Trusted::kSmallStrains && strained && *strained > kSmallStrain;
  }
  bool stale() const { return age_ns > kStaleState_ns; }
  static constexpr std::int64_t kStaleState_ns =
      500'000'000;  // states come at 60 Hz or more; what is drawn is old
};

/// Parts of organs that touch (touch_view.h).
struct TouchRow {
  bool on = false;        // they are shown
  bool known = false;     // some moment was told, and lately
  std::size_t count = 0;  // of pairs
  double hardest_n = 0;   // the largest push
};

/// A video that is being recorded, or was.
struct RecordingRow {
  bool on = false;
  double seconds = 0;
  std::uint64_t pictures = 0, dropped = 0;  // of this one
};

struct PanelView {
  std::string scene;
  double time_s = 0;
  bool paused = false;
  bool interactive = false;  // somebody could press a button
  bool endoscope = false, arrows = true, markers = true, wires = false, folds = false;
  bool has_tube = false;    // an organ here can be coloured by its folds
  bool shows_help = false;  // the keys
  RecordingRow recording;
  TouchRow touches;
  TissueMap map = TissueMap::kOff;
  double full_stress_pa = 0;  // where the scale of stress ends
  std::vector<NodeRow> nodes;
  std::vector<ToolRow> tools;
  // from a pose to its force, as the device says, and from its arrival here to the end of the frame that
  // shows it; 0: unknown
  double hand_to_force_us = 0, hand_to_force_p99_us = 0;
  double hand_to_picture_us = 0, hand_to_picture_p99_us = 0;
  double real_time_factor = 0;  // of the organs that live in time of their own; 0: none does
  std::string picture;          // how finely and how often it is drawn, in words; empty: unknown
  std::string exposed_organ;    // of which the share below is told
  std::optional<double>
      exposed_share;   // that nothing hides; none: the scene asks for none, or it is out of sight
  bool dents = true;   // an organ here has a surface that tools dent
  double dent_mm = 0;  // the deepest of this moment (dent.h)
  std::vector<OrganRow> organs;
  std::uint64_t incomplete_states = 0;
  std::vector<std::string> faults;  // of all nodes, their name in front
  std::string mouse_help;  // what mouse and keys do to the instrument that they move; empty: they move none
};

/// What the person pressed.
struct PanelActions {
  bool start = false, pause = false, reset = false, clear_fault = false;
  bool record = false, stop_recording = false;
  bool switch_camera = false, switch_arrows = false, switch_markers = false, switch_wires = false;
  bool switch_folds = false, switch_touches = false, switch_map = false, switch_help = false;
};

/// Linear elasticity is trusted up to this share of the mesh's size (Cotin 1999, section 3-3).
inline constexpr double kLinearShare = 0.1;

/// Names, rates and silence of the nodes.
std::vector<NodeRow> node_rows(const std::vector<HeardStatus>& heard, std::int64_t now_ns);
/// From a pose to its force, as the device measures it on its own clock, us; the slowest device's, count 0
/// where none tells.
msg::Percentiles device_round_trip(const std::vector<HeardStatus>& heard);
/// The time that organs lived through over the time that went by, as the deform_node that serves says; 0
/// where none speaks or none of its organs lives in time of its own.
double real_time_factor(const std::vector<HeardStatus>& heard, std::int64_t now_ns);
/// Whether a haptic_node that still speaks says that it is paused; nothing where none speaks.
std::optional<bool> haptic_paused(const std::vector<HeardStatus>& heard, std::int64_t now_ns);
/// "deform_node: TEXT" for each fault of each node.
std::vector<std::string> all_faults(const std::vector<HeardStatus>& heard);
/// The words for ToolForce.state.
std::vector<std::string> force_state_words(std::uint32_t state);

}  // namespace omentum::render
