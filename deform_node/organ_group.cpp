#include "deform_node/organ_group.h"

#include <cstdio>
#include <utility>

namespace omentum::deform {

namespace {

std::vector<OrganModel*> models_of(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganModel*> models;
  for (const ServedOrgan& served : organs) models.push_back(served.model.get());
  return models;
}

}  // namespace

OrganGroup::OrganGroup(std::vector<ServedOrgan> organs, runtime::FaultList& faults)
    : organs_(std::move(organs)), faults_(faults), collision_(models_of(organs_)) {}

void OrganGroup::step(ContactBook& book, double dt_s) noexcept {
  for (std::size_t i = 0; i < organs_.size(); ++i)
    organs_[i].model->step({.presses = book.loads(static_cast<std::uint32_t>(i)), .cuts = {}}, dt_s);
  if (!collision_.run()) faults_.raise("organs meet in more places than there is room for");
  for (ServedOrgan& served : organs_) heed(served);
}

void OrganGroup::reset() noexcept {
  for (ServedOrgan& served : organs_) served.model->reset();
}

void OrganGroup::heed(ServedOrgan& served) noexcept {
  const ModelStatus status = served.model->status();
  const std::string_view what = status.diverged ? "diverged, back to rest" : status.fault;
  if (what.empty()) return;
  if (status.diverged) served.model->reset();
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

double OrganGroup::simulated_s() const {
  double slowest_s = 0;
  for (const ServedOrgan& served : organs_) {
    const double own_s = served.model->status().simulated_s;
    if (own_s > 0 && (slowest_s == 0 || own_s < slowest_s)) slowest_s = own_s;
  }
  return slowest_s;
}

}  // namespace omentum::deform
