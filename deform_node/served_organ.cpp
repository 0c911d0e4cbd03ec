#include "deform_node/served_organ.h"

#include "deform_node/contact_reach.h"
#include "geometry/gut_skin.h"
#include "node_common/organ_reach.h"
#include "transport/messages.h"

#include <string>

namespace omentum::deform {

namespace {

// A set that the wire cannot carry would be one organ here and another one there.
void require_told(const scene::Scene& scene, const scene::OrganSpec& spec, const ServedOrgan& served) {
  if (served.model->sizes().removed_bytes <= msg::MAX_REMOVED_BYTES) return;
  throw std::runtime_error(scene.file.string() + ": organ " + spec.name + " can be cut and has " +
                           std::to_string(served.source->organ.mesh.tetrahedra.size()) +
                           " tetrahedra; expected at most " +
                           std::to_string(8 * std::size_t{msg::MAX_REMOVED_BYTES}));
}

}  // namespace

std::vector<ServedOrgan> load_organs(const scene::Scene& scene, std::span<const ModelEntry> table) {
  std::vector<ServedOrgan> organs;
  for (const scene::OrganSpec& spec : scene.organs) {
    const ModelEntry& entry = find_model(table, spec.model);
    ServedOrgan& served = organs.emplace_back();
    served.source = std::make_unique<node::OrganSource>(node::load_organ_source(scene, spec, entry.needs));
    served.model = entry.make(*served.source, spec);
    require_told(scene, spec, served);
  }
  return organs;
}

namespace {

// A hand numbers the nodes of the skin.
OrganNumbers numbers_of(const geometry::GutShape& gut) {
  const geometry::GutSkin skin(gut);
  OrganNumbers numbers{.node_of_file = {}, .surface_of_node = {}, .pinned = {}};
  for (std::size_t n = 0; n < skin.node_count(); ++n) {
    numbers.node_of_file.emplace_back(n);
    numbers.pinned.push_back(skin.is_held(NodeId(n)));
  }
  numbers.reach_m = node::reach_m(gut.positions);
  return numbers;
}

}  // namespace

OrganNumbers numbers_of(const node::OrganSource& source) {
  if (source.gut) return numbers_of(*source.gut);
  const organ::Organ& organ = source.organ;
  return {.node_of_file = organ.mesh.nodes_of_file(),
          .surface_of_node = organ.surface.of_node,
          .pinned = physics::pinned_nodes(organ.fixed),
          .reach_m = organ.compliance ? reach_of(source.rest) : node::reach_m(organ.mesh.positions),
          .compliance = organ.compliance ? &*organ.compliance : nullptr};
}

std::vector<OrganNumbers> numbers_of_all(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganNumbers> numbers;
  numbers.reserve(organs.size());
  for (const ServedOrgan& served : organs) numbers.push_back(numbers_of(*served.source));
  return numbers;
}

std::vector<msg::OrganInfo> describe(const std::vector<ServedOrgan>& organs) {
  std::vector<msg::OrganInfo> infos;
  for (const ServedOrgan& served : organs) infos.push_back(node::describe(*served.source));
  return infos;
}

}  // namespace omentum::deform
