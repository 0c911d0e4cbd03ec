#include "organ/build_organ.h"

#include "organ/organ_check.h"
#include "organ/organ_hash.h"
#include "organ/organ_writer.h"
#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "physics/blas_threads.h"
#include "physics/force_tensors.h"

#include <chrono>

namespace omentum::organ {

namespace {

using geometry::InputError;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Below this many free degrees of freedom a factorization does not repay a second BLAS thread.
constexpr std::int32_t kThreadedFactorFrom = 10000;

physics::StiffnessFactor factorize(const Organ& organ, const physics::FreeDofs& free, int threads) {
  const physics::BlasThreads blas(free.count < kThreadedFactorFrom ? 1 : threads);
  return {physics::assemble_stiffness(organ.tensor_mesh(), organ.material), free};
}

std::int32_t count_columns(const Organ& organ, const physics::FreeDofs& free) {
  std::int32_t columns = 0;
  const geometry::Surface& surface = organ.tensor_surface();
  for (std::int32_t s = 0; s < surface.mobile_count; ++s) {
    for (int axis = 0; axis < 3; ++axis) columns += free.of(surface.node[s], axis) >= 0;
  }
  return columns;
}

bool fill(const OrganWriter& writer, const Organ& organ, const physics::StiffnessFactor& factor,
          const physics::FreeDofs& free, const physics::TensorOptions& options) {
  return organ.storage == Storage::kFloat
             ? physics::compute_force_tensors(factor, free, organ.tensor_surface(), writer.single(),
                                              writer.bounds(), options)
             : physics::compute_force_tensors(factor, free, organ.tensor_surface(), writer.twofold(),
                                              writer.bounds(), options);
}

}  // namespace

Organ make_organ(std::string name, geometry::TetraMesh mesh, const physics::MaterialMap& material,
                 FixedComponents fixed, Storage storage, std::vector<std::uint8_t> dynamic,
                 BorderFaces border) {
  require_materials(material, "");
  // two meshes are no connected one: of those, the split asks for each piece of the precomputed part
  if (border.empty()) physics::require_held(mesh, fixed);
  Organ organ;
  organ.name = std::move(name);
  organ.surface = geometry::extract_surface(mesh, physics::pinned_nodes(fixed));
  if (organ.surface.mobile_count == 0) {
    throw InputError("the supports hold every node of the surface; expected at least one that can move");
  }
  organ.mesh = std::move(mesh);
  // labels that nobody gave a material say nothing of the tensors: the organ is that of a mesh without them
  if (material.regions.empty()) organ.mesh.regions.clear();
  const char* where = border.empty() ? "--dynamic: " : "--dynamic-mesh: ";
  if (!dynamic.empty())
    organ.split = split_organ(organ.mesh, fixed, std::move(dynamic), where, std::move(border));
  organ.material = material;
  organ.fixed = std::move(fixed);
  organ.storage = storage;
  organ.hash = organ_hash(organ);
  return organ;
}

bool is_up_to_date(const std::filesystem::path& file, const Organ& organ) {
  try {
    const Organ found = load_organ(file, Load::kMeshOnly);
    if (found.hash != organ.hash || found.name != organ.name) return false;
    require_whole(map_tensors(file, found), file);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

BuildResult build_organ(const Organ& organ, const std::filesystem::path& file, const BuildOptions& options) {
  BuildResult result;
  const Clock::time_point start = Clock::now();
  const physics::FreeDofs free = physics::free_dofs(organ.tensor_fixed());
  result.columns = count_columns(organ, free);
  if (!options.force && is_up_to_date(file, organ)) {
    result.up_to_date = true;
    return result;
  }
  const auto report = [&](const std::string& stage, double fraction) {
    if (options.on_progress) options.on_progress(stage, fraction);
    if (options.stopped && options.stopped())
      throw Interrupted("interrupted; " + file.string() + " was not written");
  };

  OrganWriter writer(file, organ);
  report("factorizing", 0);
  const Clock::time_point factor_start = Clock::now();
  const physics::StiffnessFactor factor = factorize(organ, free, options.threads);
  result.factor_s = seconds_since(factor_start);

  report("columns", 0);
  const Clock::time_point columns_start = Clock::now();
  const auto on_columns = [&](double fraction) {
    if (options.on_progress) options.on_progress("columns", fraction);
  };
  const auto on_idle = [&](const void* begin, std::size_t bytes) { writer.release(begin, bytes); };
  const bool whole =
      fill(writer, organ, factor, free, {options.threads, on_columns, options.stopped, on_idle});
  result.columns_s = seconds_since(columns_start);

  report("writing", 0);
  if (!whole) throw Interrupted("interrupted; " + file.string() + " was not written");
  writer.finish();
  result.total_s = seconds_since(start);
  return result;
}

}  // namespace omentum::organ
