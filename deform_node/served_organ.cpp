#include "deform_node/served_organ.h"

#include "deform_node/contact_reach.h"
#include "deform_node/quasi_static_model.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::deform {

namespace {

std::vector<msg::OrganState> prepare_blocks(std::uint32_t organ, std::int32_t node_count,
                                            transport::Profile profile) {
  const std::vector<StateBlock> split = split_state(node_count, nodes_per_block(profile));
  std::vector<msg::OrganState> blocks(split.size());
  for (std::size_t b = 0; b < split.size(); ++b) {
    blocks[b].organ = organ;
    blocks[b].block = static_cast<std::uint32_t>(b);
    blocks[b].block_count = static_cast<std::uint32_t>(split.size());
    blocks[b].kind = msg::KIND_SURFACE;
    blocks[b].first = static_cast<std::uint32_t>(split[b].first);
    blocks[b].node_count = static_cast<std::uint32_t>(node_count);
    blocks[b].values.resize(3 * static_cast<std::size_t>(split[b].count));
    blocks[b].echoes.reserve(kMaxTools);
  }
  return blocks;
}

}  // namespace

std::vector<ServedOrgan> load_organs(const scene::Scene& scene, transport::Profile profile) {
  std::vector<ServedOrgan> organs;
  for (const scene::OrganSpec& spec : scene.organs) {
    if (spec.file.empty())
      throw std::runtime_error(scene.file.string() + ": organ " + spec.name +
                               " has no file; expected a resolved scene (scene_prepare) or --organ FILE.h5");
    ServedOrgan served;
    served.organ = organ::load_organ(spec.file, organ::Load::kWithTensors);
    served.blocks =
        prepare_blocks(static_cast<std::uint32_t>(organs.size()), served.organ.surface.node_count(), profile);
    organs.push_back(std::move(served));
    // the model refers to the tensors where the vector finally keeps them
  }
  for (ServedOrgan& served : organs)
    served.model =
        std::make_unique<QuasiStaticModel>(*served.organ.compliance, served.organ.surface.node_count());
  return organs;
}

OrganNumbers numbers_of(const organ::Organ& organ) {
  return {.surface_of_file_node = organ.surface_of_file_node(),
          .mobile_count = organ.surface.mobile_count,
          .topology_version = 0,
          .reach_m = reach_of(geometry::surface_positions(organ.mesh, organ.surface)),
          .compliance = &*organ.compliance};
}

msg::Topology uncut_topology(std::uint32_t organ, const organ::Organ& source) {
  msg::Topology topology{};
  topology.organ = organ;
  topology.tetrahedron_count = static_cast<std::uint32_t>(source.mesh.tetrahedra.size());
  topology.removed_bits.assign((source.mesh.tetrahedra.size() + 7) / 8, 0);
  return topology;
}

std::vector<msg::OrganInfo> describe(const std::vector<ServedOrgan>& organs) {
  std::vector<msg::OrganInfo> infos;
  for (const ServedOrgan& served : organs)
    infos.push_back(
        {.name = served.organ.name, .hash = served.organ.hash, .kind = served.blocks.front().kind});
  return infos;
}

void fill_blocks(ServedOrgan& organ, std::uint64_t seq, std::int64_t stamp_ns,
                 std::span<const msg::Echo> echoes) noexcept {
  const std::span<const float> displacements = organ.model->displacements();
  for (msg::OrganState& block : organ.blocks) {
    block.seq = seq;
    block.stamp_ns = stamp_ns;
    block.echoes.assign(echoes.begin(), echoes.end());
    const auto values = displacements.subspan(3 * static_cast<std::size_t>(block.first), block.values.size());
    std::copy(values.begin(), values.end(), block.values.begin());
  }
}

}  // namespace omentum::deform
