#include "scene/dynamics_keys.h"

#include "scene/step_range.h"

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// Numbers of a mesh are good to 1e-12; a limit that a breath of load passes would let all tissue go at rest.
constexpr Range kLimit{.minimum = 1e-3};
constexpr Range kStress_pa{.minimum = 1};
// Longer looks like a tool that does not cut.
constexpr Range kDelay_s{.minimum = 0, .maximum = 10};

// Springs have no stiffness that stays near that at rest, as an implicit step on a kept factor needs it. What
// a hybrid organ's precomputed part answers has to be of the same step.
void read_integrator(TomlSection& s, const std::string& model, std::string& integrator) {
  std::vector<std::string> words{"symplectic", "euler", "rk4"};
  if (is_hybrid(model)) words.clear();
  if (model != "spring-mass") words.insert(words.begin(), "implicit");
  integrator = words.front();
  s.read_word("integrator", integrator, kOptional, words);
}

// Of the part that has masses: a precomputed one is linear.
void read_law(TomlSection& s, std::string& law) {
  law = "linear";
  s.read_word("law", law, kOptional, {"linear", "corotational"});
}

// An organ in its bed has its weight in its shape, and no gravity of its own; what falls out of it has. A
// dynamic part's pieces fall as they are, and so do those that take precomputed tissue along.
void read_pieces(TomlSection& s, const std::string& model, DynamicsSpec& dynamics) {
  dynamics.pieces = is_hybrid(model) ? "fall" : "drop";
  s.read_word("pieces", dynamics.pieces, kOptional, {"drop", "fall"});
  if (dynamics.pieces == "fall" && !is_hybrid(model))
    s.read("piece_gravity_m_s2", dynamics.piece_gravity_m_s2, kOptional);
}

// What has masses swings and tears.
void read_motion(TomlSection& s, const std::string& model, DynamicsSpec& dynamics) {
  read_integrator(s, model, dynamics.integrator);
  if (is_hybrid(model)) read_law(s, dynamics.law);
  s.read("step_s", dynamics.step_s, kStepRange_s);
  s.read("mass_damping_per_s", dynamics.mass_damping_per_s, kOptional, kNotNegative);
  s.read("stiffness_damping_s", dynamics.stiffness_damping_s, kOptional, kNotNegative);
  dynamics.tears = read_tears(s);
  dynamics.where = s.place("step_s");
}

}  // namespace

TearSpec read_tears(TomlSection& s) {
  TearSpec tears;
  s.read("tear_volume_change", tears.volume_change, kLimit);
  s.read("tear_mean_elongation", tears.mean_elongation, kLimit);
  s.read("tear_edge_elongation", tears.edge_elongation, kLimit);
  s.read("tear_stress_pa", tears.stress_pa, kStress_pa);
  return tears;
}

bool has_masses(const std::string& model) {
  return model != "quasi-static-cut";
}

bool is_hybrid(const std::string& model) {
  return model == "hybrid" || model == "hybrid-cut";
}

DynamicsSpec read_dynamics(TomlSection& s, const std::string& model) {
  DynamicsSpec dynamics;
  if (has_masses(model)) read_motion(s, model, dynamics);
  if (model == "hybrid-cut" || !has_masses(model)) read_pieces(s, model, dynamics);
  s.read("gravity_m_s2", dynamics.gravity_m_s2, kOptional);
  s.read("cut_delay_s", dynamics.cut_delay_s, kOptional, kDelay_s);
  s.read("cut_rate_per_s", dynamics.cut_rate_per_s, kOptional, kPositive);
  s.read("smallest_piece_m3", dynamics.smallest_piece_m3, kOptional, kNotNegative);
  return dynamics;
}

}  // namespace omentum::scene
