#include "scene_session.h"

#include "device_bridge/hand_script.h"
#include "tests/support/process.h"
#include "tests/support/trial_organs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omentum::haptic_test {
namespace {

// About what a sample takes on one machine: an answer is there before the next period.
constexpr std::int64_t kWire_ns = 100'000;
constexpr std::int64_t kBegin_ns = 1'000'000'000;  // the clock began before the session

}  // namespace

std::optional<scene::Scene> liver_scene(double young_pa) {
  test::OrganRecipe recipe = test::organ_recipe("phantom");
  recipe.young_pa = young_pa;
  const auto organ = test::trial_organ_file(recipe);
  if (!organ) return std::nullopt;
  const test::ScratchFolder folder;
  test::Process prepare("scene_prepare", {OMENTUM_SOURCE_DIR "/scenes/liver.toml", "--organ", organ->string(),
                                          "--keep-points", "-o", folder / "scene.toml"});
  if (prepare.wait() != 0) throw std::runtime_error(prepare.messages());
  return scene::load_scene(folder / "scene.toml");
}

void EnergyAccount::add(double work_j) {
  given_j += work_j;
  turned_over_j += std::abs(work_j);
  most_given_j = std::max(most_given_j, given_j);
  put_in_j = std::max(put_in_j, -given_j);
  excess_j = std::max(excess_j, given_j - kGain * put_in_j);
}

void CountedHand::command(const device::Wrench& wrench) noexcept {
  force_ = wrench.force;
  hand_.command(wrench);
}

device::Measurement CountedHand::measure(std::int64_t now_ns) noexcept {
  const device::Measurement measured = hand_.measure(now_ns);
  if (tip_) energy_.add(force_.dot(measured.position - *tip_));
  tip_ = measured.position;
  return measured;
}

SceneSession::SceneSession(const scene::Scene& scene, double rate_hz)
    : rate_hz_(rate_hz),
      setup_(haptic::make_setup(scene, rate_hz)),
      state_(setup_.model),
      work_(setup_.model),
      inputs_(setup_.tool_ids.size()),
      outputs_(setup_.tool_ids.size()) {
  for (const scene::HandSpec& spec : scene.hands) add_hand(scene, spec);
}

void SceneSession::add_hand(const scene::Scene& scene, const scene::HandSpec& spec) {
  const auto id = std::ranges::find(setup_.tool_ids, spec.tool);
  const auto tool = static_cast<std::size_t>(id - setup_.tool_ids.begin());
  auto counted = std::make_unique<CountedHand>(spec, scene.tools.at(tool), rate_hz_);
  auto hand = std::make_unique<Hand>();
  hand->tool = tool;
  hand->counted = counted.get();
  hand->channel = std::make_unique<device::ToolChannel>(std::move(counted), faults_);
  hand->line = std::make_unique<haptic::ToolLine>(spec.tool, setup_.limits, faults_);
  hand->line->hear(hand->channel->info());
  hands_.push_back(std::move(hand));
  seconds_ = std::max(seconds_, device::script_period_s(spec));
}

void SceneSession::run() {
  const auto count = static_cast<std::uint64_t>(std::ceil(seconds_ * rate_hz_));
  while (ticks_ < count) tick(kBegin_ns + std::llround(1e9 * static_cast<double>(ticks_) / rate_hz_));
}

void SceneSession::tick(std::int64_t now_ns) {
  const std::int64_t heard_ns = now_ns + kWire_ns, answered_ns = heard_ns + kWire_ns;
  double given_j = 0;
  for (const auto& hand : hands_) {
    static_cast<void>(hand->line->hear(hand->channel->tick(now_ns), heard_ns));
    static_cast<void>(hand->line->listen(heard_ns, inputs_[hand->tool]));
    given_j += hand->counted->energy().given_j;
  }
  together_.add(given_j - together_.given_j);
  haptic::haptic_step(setup_.model, inputs_, state_, work_, outputs_);
  const double dt_s = ticks_ == 0 ? 0 : 1 / rate_hz_;
  ++ticks_;
  for (const auto& hand : hands_) {
    hand->line->answer(outputs_[hand->tool], heard_ns, dt_s, false);
    static_cast<void>(hand->channel->receive(hand->line->to_send(ticks_), answered_ns));
    hand->line->sent(true);
  }
}

}  // namespace omentum::haptic_test
