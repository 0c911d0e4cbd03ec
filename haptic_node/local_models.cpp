#include "haptic_node/local_models.h"

#include "node_common/vectors.h"

#include <algorithm>
#include <utility>

namespace omentum::haptic {
namespace {

// Of one patch: a making thread that is so far behind is flooded by more than deform_node.
constexpr std::size_t kMostWaiting = 16;

constexpr auto kSilence_ns = static_cast<std::int64_t>(1e9 * kModelSilence_s);

bool is_silent(std::int64_t heard_ns, std::int64_t now_ns) {
  return heard_ns == 0 || now_ns - heard_ns > kSilence_ns;
}

std::vector<Vec3> vectors(const std::vector<msg::Vec3>& from) {
  std::vector<Vec3> to;
  to.reserve(from.size());
  for (const msg::Vec3& v : from) to.push_back(node::to_vector(v));
  return to;
}

}  // namespace

LocalPatch patch_of_message(const msg::LocalModel& model) {
  LocalPatch patch;
  patch.organ = model.organ;
  patch.topology_version = model.topology_version;
  patch.nodes.assign(model.nodes.begin(), model.nodes.end());
  patch.positions = vectors(model.positions);
  patch.velocities = vectors(model.velocities);
  patch.forces = vectors(model.forces);
  for (std::size_t t = 0; t + 3 <= model.triangles.size(); t += 3) {
    geometry::Triangle triangle;
    for (std::size_t v = 0; v < 3; ++v) triangle[v] = SurfaceId(std::int32_t{model.triangles[t + v]});
    patch.triangles.push_back(triangle);
  }
  patch.compliance.assign(model.compliance.begin(), model.compliance.end());
  return patch;
}

std::optional<std::string> reason_against(const LocalPatch& patch, const LocalOrgan& organ) {
  for (std::size_t n = 0; n < patch.nodes.size(); ++n) {
    if (patch.nodes[n] >= organ.rest_of_file_node.size())
      return "node " + std::to_string(patch.nodes[n]) + ", which the mesh file does not have";
    const Vec3& rest = organ.rest_of_file_node[patch.nodes[n]];
    if (!((patch.positions[n] - rest).norm() <= organ.reach_m))
      return "a node farther from its rest than tissue gets";
  }
  return std::nullopt;
}

LocalModels::LocalModels(const HapticSetup& setup, std::vector<BodyDoor>& doors, runtime::FaultList& faults,
                         const runtime::Clock& clock, const runtime::StartWork& start)
    : setup_(setup), doors_(doors), faults_(faults), clock_(clock), organs_(setup.model.organs.size()) {
  std::size_t place = setup.model.organs.size();
  for (const LocalOrgan& known : setup.local_organs) {
    Organ& organ = organs_[known.organ];
    organ.known = &known;
    for (std::size_t tool = 0; tool < setup.tool_ids.size(); ++tool) {
      organ.patches.push_back(std::make_unique<Patch>());
      organ.patches.back()->organ = known.organ;
      organ.patches.back()->tool = tool;
      organ.patches.back()->place = place++;
    }
  }
  making_ = start([this] { make(); });
}

void LocalModels::hear(const msg::LocalModel& model) {
  heard_.fetch_add(1, std::memory_order_relaxed);
  Patch* const patch = patch_of(model);
  if (!patch) return;
  if (!patch->waiting.push({model, clock_.now_ns()})) drop("more of them than can be looked at");
  making_->wake();
}

bool LocalModels::Waiting::push(Heard heard) {
  const std::lock_guard lock(mutex_);
  const bool fits = heard_.size() < kMostWaiting;
  if (!fits) heard_.erase(heard_.begin());
  heard_.push_back(std::move(heard));
  return fits;
}

std::vector<LocalModels::Heard> LocalModels::Waiting::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(heard_, {});
}

LocalModels::Patch* LocalModels::patch_of(const msg::LocalModel& model) {
  if (model.organ >= organs_.size()) {
    drop("no such organ in this scene");
  } else if (!organs_[model.organ].known) {
    drop("an organ that is felt by its tensors");
  } else {
    const auto tool = std::ranges::find(setup_.tool_ids, model.patch);
    if (tool != setup_.tool_ids.end())
      return organs_[model.organ].patches[static_cast<std::size_t>(tool - setup_.tool_ids.begin())].get();
    drop("around a tool that the scene does not have");
  }
  return nullptr;
}

void LocalModels::drop(const std::string& why) {
  dropped_.fetch_add(1, std::memory_order_relaxed);
  faults_.raise("local model dropped: " + why);
}

LocalModelCounts LocalModels::counts() const noexcept {
  return {heard_.load(std::memory_order_relaxed), dropped_.load(std::memory_order_relaxed),
          gone_.load(std::memory_order_relaxed)};
}

// ---- the making thread

// After a silence another deform_node may number anew.
const char* LocalModels::too_late(const Heard& heard, const Patch& patch) {
  if (is_silent(patch.heard_ns, heard.arrival_ns)) return nullptr;
  if (heard.model.topology_version < patch.version) return "of an older topology version";
  if (heard.model.seq <= patch.seq) return "repeated, or overtaken";
  return nullptr;
}

void LocalModels::make() {
  const std::int64_t now_ns = clock_.now_ns();
  for (const Organ& organ : organs_) {
    for (const auto& patch : organ.patches) {
      make(*patch);
      if (patch->made_ns == 0 || now_ns - patch->made_ns <= kSilence_ns) continue;
      empty(*patch);
      gone_.fetch_add(1, std::memory_order_relaxed);
    }
  }
}

// What is no model leaves what stands there, until that is too old.
void LocalModels::make(Patch& patch) {
  std::optional<LocalPatch> newest;
  for (const Heard& heard : patch.waiting.take())
    if (auto told = accept(heard, patch)) newest = std::move(told);
  if (!newest) return;
  if (newest->nodes.empty()) return empty(patch);
  const LocalOrgan& known = *organs_[patch.organ].known;
  for (const std::uint32_t n : newest->nodes) newest->at_rest.push_back(known.rest_of_file_node[n]);
  doors_[patch.place].post(make_local_body(*newest));
  patch.made_ns = newest->arrival_ns;
}

// Numbers of what is no model are not noted: they would shut out those that are.
std::optional<LocalPatch> LocalModels::accept(const Heard& heard, Patch& patch) {
  const Organ& organ = organs_[patch.organ];
  LocalPatch told = patch_of_message(heard.model);
  told.tool = patch.tool;
  told.arrival_ns = heard.arrival_ns;
  told.bends_freely = organ.known->bends_freely;
  std::optional<std::string> why;
  if (const char* late = too_late(heard, patch)) why = late;
  if (!why && !told.nodes.empty()) why = reason_against(told, setup_.model.organs.size());
  if (!why) why = reason_against(told, *organ.known);
  if (why) {
    drop(*why);
    return std::nullopt;
  }
  patch.heard_ns = heard.arrival_ns;
  patch.seq = heard.model.seq;
  patch.version = heard.model.topology_version;
  return told;
}

void LocalModels::empty(Patch& patch) {
  if (patch.made_ns != 0) doors_[patch.place].post(nullptr);
  patch.made_ns = 0;
}

}  // namespace omentum::haptic
