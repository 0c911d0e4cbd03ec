#include "deform_node/model_table.h"

#include "deform_node/dynamic_maker.h"
#include "deform_node/gut_maker.h"
#include "deform_node/quasi_static_model.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::deform {

namespace {

std::unique_ptr<OrganModel> make_quasi_static(const node::OrganSource& source, const scene::OrganSpec&) {
  const organ::Organ& organ = source.organ;
  return std::make_unique<QuasiStaticModel>(*organ.compliance, organ.surface, source.rest,
                                            geometry::cover_with_spheres(organ.mesh, organ.surface));
}

constexpr std::array kTable{
    ModelEntry{"quasi-static", organ::Load::kWithTensors, make_quasi_static},
    ModelEntry{"quasi-static-cut", organ::Load::kMeshOnly, make_quasi_static_cut},
    ModelEntry{"tensor-mass", organ::Load::kMeshOnly, make_tensor_mass},
    ModelEntry{"corotational", organ::Load::kMeshOnly, make_corotational},
    ModelEntry{"spring-mass", organ::Load::kMeshOnly, make_spring_mass},
    ModelEntry{"hybrid", organ::Load::kWithPart, make_hybrid},
    ModelEntry{"hybrid-cut", organ::Load::kMeshOnly, make_hybrid_cut},
    ModelEntry{"intestine", organ::Load::kMeshOnly, make_intestine},
};

}  // namespace

std::span<const ModelEntry> model_table() {
  return kTable;
}

const ModelEntry& find_model(std::span<const ModelEntry> table, std::string_view word) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const ModelEntry& entry) { return entry.word == word; });
  if (found == table.end())
    throw std::runtime_error("model of an organ: " + std::string(word) +
                             " is none that deform_node can make");
  return *found;
}

}  // namespace omentum::deform
