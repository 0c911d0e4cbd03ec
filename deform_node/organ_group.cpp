#include "deform_node/organ_group.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace omentum::deform {

namespace {

std::vector<OrganModel*> models_of(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganModel*> models;
  for (const ServedOrgan& served : organs) models.push_back(served.model.get());
  return models;
}

// Beside the calling thread: one for each further organ that costs.
std::size_t helpers_for(const std::vector<ServedOrgan>& organs, std::size_t most_threads) {
  const auto costly = static_cast<std::size_t>(
      std::ranges::count_if(organs, [](const ServedOrgan& served) { return served.model->sizes().costs; }));
  return std::max<std::size_t>(1, std::min(costly, most_threads)) - 1;
}

}  // namespace

OrganGroup::OrganGroup(std::vector<ServedOrgan> organs, runtime::FaultList& faults, std::size_t most_threads)
    : organs_(std::move(organs)),
      faults_(faults),
      crew_(helpers_for(organs_, most_threads)),
      collision_(models_of(organs_), &crew_) {}

void OrganGroup::step(ContactBook& book, double dt_s) noexcept {
  crew_.share(organs_.size(), [&](std::size_t organ) {
    const auto i = static_cast<std::uint32_t>(organ);
    organs_[organ].model->step({.presses = book.loads(i), .cuts = book.cuts(i)}, dt_s);
  });
  if (!collision_.run()) faults_.raise("organs meet in more places than there is room for");
  collision_.note_touches(dt_s);
  for (std::uint32_t i = 0; i < organs_.size(); ++i) {
    heed(i, book);
    book.now_at(i, organs_[i].model->view().topology_version);
  }
}

void OrganGroup::reset(ContactBook& book) noexcept {
  for (std::uint32_t i = 0; i < organs_.size(); ++i) reset(i, book);
}

void OrganGroup::reset(std::uint32_t organ, ContactBook& book) noexcept {
  OrganModel& model = *organs_[organ].model;
  model.reset();
  ++organs_[organ].begun_anew;
  collision_.reset(organ);
  book.begins_at(organ, model.view().topology_version);
}

void OrganGroup::take_up(const std::vector<OrganCuts>& cuts, ContactBook& book) noexcept {
  for (std::uint32_t i = 0; i < organs_.size(); ++i) {
    OrganModel& model = *organs_[i].model;
    const OrganView now = model.view();
    const bool is_there =
        now.topology_version == cuts[i].version && std::ranges::equal(now.removed_bits, cuts[i].removed_bits);
    if (cuts[i].version == 0 || is_there) continue;
    const std::uint64_t version = std::max(cuts[i].version, now.topology_version + 1);
    model.take_up(cuts[i].removed_bits, cuts[i].burnt_bits, version);
    ++organs_[i].begun_anew;
    collision_.reset(i);
    book.begins_at(i, model.view().topology_version);
  }
}

void OrganGroup::heed(std::uint32_t organ, ContactBook& book) noexcept {
  ServedOrgan& served = organs_[organ];
  const ModelStatus status = served.model->status();
  const std::string_view what = status.diverged ? "diverged, back to rest" : status.fault;
  if (what.empty()) return;
  if (status.diverged) reset(organ, book);
  char line[runtime::FaultList::kTextSize + 1];
  std::snprintf(line, sizeof line, "organ %s: %.*s", served.source->organ.name.c_str(),
                static_cast<int>(what.size()), what.data());
  faults_.raise(line);
}

std::uint64_t OrganGroup::steps() const {
  std::uint64_t steps = 0;
  for (const ServedOrgan& served : organs_) steps += served.model->status().steps;
  return steps;
}

std::uint32_t OrganGroup::removed_tetrahedra() const {
  std::uint32_t removed = 0;
  for (const ServedOrgan& served : organs_) removed += served.model->status().removed_tetrahedra;
  return removed;
}

std::uint32_t OrganGroup::repaired_tetrahedra() const {
  std::uint32_t repaired = 0;
  for (const ServedOrgan& served : organs_) repaired += served.model->status().repaired_tetrahedra;
  return repaired;
}

CutAccount OrganGroup::cuts() const {
  CutAccount all;
  for (const ServedOrgan& served : organs_) {
    const CutAccount own = served.model->status().cuts;
    all.way_m += own.way_m;
    all.tools |= own.tools;
    all.lost_m3 += own.lost_m3;
  }
  return all;
}

std::optional<CollisionAccount> OrganGroup::collisions() const {
  std::optional<CollisionAccount> all;
  for (const ServedOrgan& served : organs_) {
    const std::optional<CollisionAccount> own = served.model->status().collisions;
    if (!own) continue;
    if (!all) all.emplace();
    all->contacts += own->contacts;
    all->held_back += own->held_back;
    all->left_out += own->left_out;
    all->deepest_m = std::max(all->deepest_m, own->deepest_m);
  }
  return all;
}

double OrganGroup::simulated_s() const {
  double slowest_s = 0;
  for (const ServedOrgan& served : organs_) {
    const double own_s = served.model->status().simulated_s;
    if (own_s > 0 && (slowest_s == 0 || own_s < slowest_s)) slowest_s = own_s;
  }
  return slowest_s;
}

}  // namespace omentum::deform
