// Contacts that are set aside as open change nothing: the solution is that of all contacts together.
#include "haptic_node/lost_contact.h"
#include "haptic_node/point_contacts.h"
#include "tests/haptic_node/haptic_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::haptic_test {
namespace {

using haptic::HapticState;
using haptic::HapticWorkspace;

constexpr double kSame_n = 1e-5;

/// Two round tools that press, slide and turn about each other.
class PressingTools {
 public:
  PressingTools()
      : model_(make_model(block(), {round_tool(), round_tool()})), state_(model_), work_(model_) {}

  void step(int tick) {
    const double turn = 0.004 * tick;
    const Vec3 middle(0.05, 0.05, 0.037 + 0.003 * std::cos(0.7 * turn));
    const Vec3 side = 0.008 * Vec3(std::cos(turn), std::sin(turn), 0);
    for (std::size_t t = 0; t < 2; ++t) {
      inputs_[t].engaged = true;
      inputs_[t].frame.p_WT = t == 0 ? Vec3(middle + side) : Vec3(middle - side);
    }
    compare();
    haptic::haptic_step(model_, inputs_, state_, work_, outputs_);
  }

  int aside = 0;          // contacts
  int wrong_guesses = 0;  // ticks that were solved again with all of them

 private:
  // This tick's contacts, not solved for.
  HapticState find() {
    HapticState state = state_;
    work_.bodies[haptic::BodyId(0)].contact_nodes().begin_tick();
    haptic::place_tools(model_, inputs_, state, work_.bodies);
    haptic::evaluate_neighbourhood(state, work_.bodies);
    haptic::leave_astray(model_, state, work_.bodies);
    haptic::follow_surface(model_, state, work_.bodies);
    haptic::meet_appeared(state, work_.bodies);
    haptic::find_contacts(state, work_.bodies);
    return state;
  }

  void compare() {
    HapticState state = find();
    // bolder than set_open_aside: whatever did not touch in the last tick
    const auto open = std::ranges::partition(state.active(), &haptic::ToolContact::touches);
    const int near = state.contact_count - static_cast<int>(open.size());
    for (int i = 0; i < state.contact_count; ++i) {
      work_.before[i] = state.contacts[i].force;
      work_.free_gaps[i] = haptic::free_gap(state, state.contacts[i]);
    }
    HapticState all = state;
    static_cast<void>(haptic::solve_point_contacts(model_, inputs_, near, state, work_));
    aside += state.contact_count - work_.problem.count;
    wrong_guesses += near < work_.problem.count;
    static_cast<void>(haptic::solve_point_contacts(model_, inputs_, all.contact_count, all, work_));
    for (int i = 0; i < state.contact_count; ++i)
      EXPECT_LE((state.contacts[i].force - all.contacts[i].force).norm(), kSame_n) << "contact " << i;
  }

  haptic::HapticModel model_;
  HapticState state_;
  HapticWorkspace work_;
  std::array<haptic::ToolInput, 2> inputs_;
  std::array<haptic::ToolOutput, 2> outputs_;
};

TEST(PointContacts, WhatIsSetAsideAsOpenChangesNothing) {
  PressingTools tools;
  for (int tick = 0; tick < 3000; ++tick) tools.step(tick);
  EXPECT_GT(tools.aside, 1000);
  EXPECT_GT(tools.wrong_guesses, 0);
}

}  // namespace
}  // namespace omentum::haptic_test
