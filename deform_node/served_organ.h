// An organ of the scene as deform_node serves it: where it comes from and what moves it.
#pragma once

#include "deform_node/contact_book.h"
#include "deform_node/model_table.h"

#include <memory>
#include <vector>

namespace omentum::deform {

struct ServedOrgan {
  std::unique_ptr<const node::OrganSource> source;  // the model refers to it
  std::unique_ptr<OrganModel> model;
  std::uint64_t begun_anew = 0;  // how often it was put back to rest, or to what another node left of it
};

/// Loads every organ of the scene and makes the model that the scene chose for it. Throws
/// geometry::InputError (organ file) or std::runtime_error (a scene whose organ has no file, a model that
/// `table` lacks, an organ that is cut and has more tetrahedra than a Topology has bits).
std::vector<ServedOrgan> load_organs(const scene::Scene& scene,
                                     std::span<const ModelEntry> table = model_table());

/// Refers to the organ's tensors.
OrganNumbers numbers_of(const node::OrganSource& source);
std::vector<OrganNumbers> numbers_of_all(const std::vector<ServedOrgan>& organs);

/// Who is in the scene, as SceneInfo tells it.
std::vector<msg::OrganInfo> describe(const std::vector<ServedOrgan>& organs);

}  // namespace omentum::deform
