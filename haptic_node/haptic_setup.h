// From a scene to what the loop runs: checked, complete, or refused with what and where.
#pragma once

#include "haptic_node/force_safety.h"
#include "haptic_node/haptic_model.h"
#include "node_common/loaded_scene.h"
#include "organ/organ.h"
#include "scene/scene.h"

#include <stop_token>

namespace omentum::haptic {

/// An organ that is felt by local models: how they name its nodes, and where these may be.
struct LocalOrgan {
  std::uint32_t organ = 0;  // index into the scene's
  // [nodes of the mesh file, or of an intestine's skin] in W, m; NaN where the mesh has none
  std::vector<Vec3> rest_of_file_node;
  double reach_m = 0;         // no model takes a node farther (organ_reach.h)
  bool bends_freely = false;  // LocalPatch::bends_freely
};

struct HapticSetup {
  HapticModel model;
  std::vector<LocalOrgan> local_organs;
  std::vector<std::uint32_t> tool_ids;  // one per tool of the model ...
  std::vector<std::string> devices;     // ... and the device that the scene wants for it, or empty
  ForceLimits limits;
  double pull_limit_n = 0;  // of the trainee's score
  node::LoadedScene scene;
};

/// All organs of the scene and all its tools. Throws std::runtime_error (scene without organ, organ file or
/// tools, more points than can be solved) or geometry::InputError (organ file). `rate_hz`: the loop's nominal
/// rate. `words`: how the organs' models are felt.
HapticSetup make_setup(const scene::Scene& scene, double rate_hz,
                       std::span<const scene::OrganModelWord> words = scene::kOrganModels);

/// Of all organs' mapped tensors, bytes.
std::uint64_t tensor_bytes(const HapticModel& model);

/// Reads every page of all tensors once, where they may stay in memory (runtime/memory_limit.h), so that the
/// loop meets none for the first time on the disk. An ordinary thread's work: it takes as long as the disk
/// does, or until `stop`.
void warm_up(const HapticModel& model, const std::stop_token& stop = {});

}  // namespace omentum::haptic
