#include "haptic_node/haptic_setup.h"

#include "geometry/gut_skin.h"
#include "node_common/organ_reach.h"
#include "node_common/organ_source.h"
#include "runtime/memory_limit.h"
#include "transport/messages.h"

#include <unistd.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace omentum::haptic {
namespace {

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& what) {
  throw std::runtime_error(scene.file.string() + ": " + what);
}

std::vector<ToolModel> make_tools(const scene::Scene& scene) {
  std::vector<ToolModel> tools;
  for (const scene::ToolSpec& spec : scene.tools) {
    if (spec.id >= msg::MAX_TOOLS) {
      refuse(scene,
             "tool id " + std::to_string(spec.id) + ", expected 0 to " + std::to_string(msg::MAX_TOOLS - 1));
    }
    if (spec.points.empty() && !spec.scope)
      refuse(scene, "tool " + std::to_string(spec.id) + " has no points");
    ToolModel tool;
    tool.points = spec.points;
    tool.grasps = spec.shape == "grasper";
    tool.grip_force_n = spec.grip_force_n;
    tool.trocar = spec.trocar;
    tool.edge = spec.edge;
    tools.push_back(std::move(tool));
  }
  require_solvable(tools);
  return tools;
}

ElasticSurface no_surface() {
  return {.surface = {}, .rest = {}, .compliance = {0, nullptr, nullptr, nullptr}, .file_node = {}};
}

ElasticSurface make_surface(node::OrganSource&& source) {
  organ::Organ& organ = source.organ;
  std::vector<std::uint32_t> file_node;
  for (const geometry::NodeId n : organ.surface.node) {
    file_node.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[n]));
  }
  return {std::move(organ.surface), std::move(source.rest), *std::move(organ.compliance),
          std::move(file_node)};
}

LocalOrgan local_organ(const geometry::GutShape& gut, std::uint32_t organ) {
  const geometry::GutSkin skin(gut);
  LocalOrgan local{.organ = organ,
                   .rest_of_file_node = std::vector<Vec3>(skin.node_count()),
                   .reach_m = node::reach_m(gut.positions),
                   .bends_freely = true};
  skin.place(gut.positions, local.rest_of_file_node);
  return local;
}

LocalOrgan local_organ(const node::OrganSource& source, std::uint32_t organ) {
  if (source.gut) return local_organ(*source.gut, organ);
  const geometry::TetraMesh& mesh = source.organ.mesh;
  LocalOrgan local{.organ = organ, .rest_of_file_node = {}, .reach_m = 0};
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const geometry::NodeId n : mesh.nodes_of_file())
    local.rest_of_file_node.push_back(n.valid() ? mesh.positions[n] : none);
  local.reach_m = node::reach_m(mesh.positions);
  return local;
}

scene::Feel feel_of(const scene::OrganSpec& spec, std::span<const scene::OrganModelWord> words) {
  const auto found = std::ranges::find(words, spec.model, &scene::OrganModelWord::word);
  if (found == words.end()) throw std::runtime_error("model " + spec.model + ": nobody knows how it is felt");
  return found->feel;
}

// The organs, and what is there of them from the start.
std::vector<msg::OrganInfo> add_organs(const scene::Scene& scene,
                                       std::span<const scene::OrganModelWord> words, HapticSetup& setup) {
  std::vector<msg::OrganInfo> infos;
  for (const scene::OrganSpec& spec : scene.organs) {
    const bool by_tensors = feel_of(spec, words) == scene::Feel::kTensors;
    node::OrganSource source =
        node::load_organ_source(scene, spec, by_tensors ? organ::Load::kWithTensors : organ::Load::kMeshOnly);
    infos.push_back(node::describe(source));
    if (!by_tensors)
      setup.local_organs.push_back(local_organ(source, static_cast<std::uint32_t>(infos.size() - 1)));
    setup.model.organs.push_back(by_tensors ? make_surface(std::move(source)) : no_surface());
  }
  return infos;
}

std::uint64_t tensor_bytes(const physics::SurfaceCompliance& compliance) {
  return std::uint64_t{sizeof(float)} * static_cast<std::uint64_t>(compliance.mobile_count()) *
         static_cast<std::uint64_t>(compliance.cluster_count()) * physics::SurfaceCompliance::kTileFloats;
}

}  // namespace

HapticSetup make_setup(const scene::Scene& scene, double rate_hz,
                       std::span<const scene::OrganModelWord> words) {
  if (scene.organs.empty()) refuse(scene, "no organ, expected one at least");
  const scene::HapticsSpec& h = scene.haptics;
  HapticSetup setup;
  setup.scene = node::loaded_scene(scene, add_organs(scene, words, setup));
  setup.model.tools = make_tools(scene);
  setup.model.spare_places = setup.local_organs.size() * setup.model.tools.size();
  setup.model.friction = h.friction;
  setup.model.mode = h.contact == "spread" ? ContactMode::kSpread : ContactMode::kPoint;
  setup.limits = {h.max_force_n, h.max_torque_nm, h.max_slew_n_s, h.ramp_s,
                  h.stale_s,     h.decay_s,       1 / rate_hz};
  setup.pull_limit_n = scene.score.pull_limit_n;
  for (const scene::ToolSpec& tool : scene.tools) {
    setup.tool_ids.push_back(tool.id);
    setup.devices.push_back(tool.device);
  }
  return setup;
}

std::uint64_t tensor_bytes(const HapticModel& model) {
  std::uint64_t bytes = 0;
  for (const ElasticSurface& organ : model.organs) bytes += tensor_bytes(organ.compliance);
  return bytes;
}

void warm_up(const HapticModel& model, const std::stop_token& stop) {
  if (!runtime::may_stay_in_memory(tensor_bytes(model), runtime::memory_limit_bytes())) return;
  const auto page_floats = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / sizeof(float);
  for (const ElasticSurface& organ : model.organs) {
    const std::uint64_t bytes = tensor_bytes(organ.compliance);
    if (bytes == 0) continue;
    const volatile float* begin = organ.compliance.tile(physics::SurfaceId(0), 0);
    for (std::uint64_t i = 0; i < bytes / sizeof(float) && !stop.stop_requested(); i += page_floats)
      static_cast<void>(begin[i]);
  }
}

}  // namespace omentum::haptic
