// Which model moves which organ: the one place that knows them all.
#pragma once

#include "deform_node/organ_models.h"
#include "node_common/organ_source.h"

#include <memory>

namespace omentum::deform {

/// A scene's word for a model, what it reads of the organ file, and how it is made. `source` outlives the
/// model, which may refer to it; `spec` has the model's parameters.
struct ModelEntry {
  std::string_view word;
  organ::Load needs = organ::Load::kMeshOnly;
  std::unique_ptr<OrganModel> (*make)(const node::OrganSource& source,
                                      const scene::OrganSpec& spec) = nullptr;
};

/// One entry for each of scene::kOrganModels.
std::span<const ModelEntry> model_table();

/// Throws std::runtime_error when `table` has no such model.
const ModelEntry& find_model(std::span<const ModelEntry> table, std::string_view word);

}  // namespace omentum::deform
