// An organ of the scene as deform_node serves it: its file, its model, its messages.
#pragma once

#include "deform_node/contact_book.h"
#include "deform_node/state_blocks.h"
#include "organ/organ.h"
#include "scene/scene.h"

#include <memory>
#include <vector>

namespace omentum::deform {

struct ServedOrgan {
  organ::Organ organ;  // kept for as long as the model lives: it owns the tensors
  std::unique_ptr<OrganModel> model;
  std::vector<msg::OrganState> blocks;  // one per block, memory taken beforehand
};

/// Loads every organ of the scene and chooses its model. Throws geometry::InputError (organ file) or
/// std::runtime_error (a scene whose organ has no file).
std::vector<ServedOrgan> load_organs(const scene::Scene& scene, transport::Profile profile);

/// Refers to the organ's tensors.
OrganNumbers numbers_of(const organ::Organ& organ);

/// The topology of an organ as it was loaded: version 0, nothing removed. A reset publishes none, since no
/// model of today cuts: an organ that comes back whole from a cut gets the next version (idl/organ.idl).
msg::Topology uncut_topology(std::uint32_t organ, const organ::Organ& source);
/// Who is in the scene, as SceneInfo tells it.
std::vector<msg::OrganInfo> describe(const std::vector<ServedOrgan>& organs);

/// Fills `organ`'s blocks with the state of this moment; allocates nothing.
void fill_blocks(ServedOrgan& organ, std::uint64_t seq, std::int64_t stamp_ns,
                 std::span<const msg::Echo> echoes) noexcept;

}  // namespace omentum::deform
