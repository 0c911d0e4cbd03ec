#include "organ/organ.h"

#include "organ/hdf5_file.h"
#include "organ/organ_check.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"
#include "organ/stored_tensors.h"

#include <cstdio>
#include <cstring>

namespace omentum::organ {

namespace {

using geometry::InputError;

// Numbers of the file as a list of Ts that are made of them (typed indices, vectors, triangles), a T a row.
template <class T, class Number>
std::vector<T> read_as(const Hdf5File& file, const char* dataset) {
  constexpr std::size_t kColumns = sizeof(T) / sizeof(Number);
  static_assert(sizeof(T) % sizeof(Number) == 0);
  const std::vector<Number> numbers = file.read<Number>(dataset, kColumns == 1 ? 0 : kColumns);
  std::vector<T> values(numbers.size() / kColumns);
  if (!values.empty())
    std::memcpy(static_cast<void*>(values.data()), numbers.data(), values.size() * sizeof(T));
  return values;
}

// Without the zeros of a whole number; whatever the file says.
std::string version_text(double version) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", version);
  return text;
}

Storage read_storage(const Hdf5File& hdf5, const std::filesystem::path& file) {
  const std::string text = hdf5.read_text(layout::kStorage);
  if (text != "float" && text != "double")
    throw InputError(file.string() + ": its '" + layout::kStorage + "' is neither float nor double");
  return text == "double" ? Storage::kDouble : Storage::kFloat;
}

void require_format(const Hdf5File& hdf5, const std::filesystem::path& file) {
  if (!hdf5.has_attribute(layout::kFormat) || hdf5.read_text(layout::kFormat) != layout::kFormatName) {
    throw InputError(file.string() + ": is an HDF5 file, but no organ file (organ_build makes them)");
  }
  const double version = hdf5.read_number(layout::kVersion);
  if (version != kFormatVersion) {
    throw InputError(file.string() + ": has format version " + version_text(version) + "; expected " +
                     std::to_string(kFormatVersion) + " (build it again with organ_build)");
  }
  if (!hdf5.has_attribute(layout::kFinished)) {
    throw InputError(file.string() + ": is unfinished (an interrupted organ_build); build it again");
  }
}

void read_regions(const Hdf5File& hdf5, const std::filesystem::path& file, Organ& organ) {
  organ.mesh.regions = hdf5.read<std::int32_t>(layout::kRegions, 0);
  const std::vector<std::int32_t> labels = hdf5.read<std::int32_t>(layout::kRegionLabels, 0);
  const auto materials = read_as<physics::Material, double>(hdf5, layout::kRegionMaterials);
  if (materials.size() != labels.size()) {
    throw InputError(file.string() + ": is damaged: '" + layout::kRegionMaterials + "' has " +
                     std::to_string(materials.size()) + " rows; expected " + std::to_string(labels.size()));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) organ.material.regions.push_back({labels[i], materials[i]});
}

Organ read_contents(const Hdf5File& hdf5, const std::filesystem::path& file) {
  Organ organ;
  organ.name = hdf5.read_text(layout::kName);
  organ.storage = read_storage(hdf5, file);
  organ.material.common = {hdf5.read_number(layout::kYoung), hdf5.read_number(layout::kPoisson),
                           hdf5.read_number(layout::kDensity)};
  organ.mesh.positions = read_as<geometry::Vec3, double>(hdf5, layout::kPositions);
  organ.mesh.tetrahedra = read_as<geometry::Tetrahedron, std::int32_t>(hdf5, layout::kTetrahedra);
  organ.mesh.file_node = hdf5.read<std::int32_t>(layout::kFileNode, 0);
  organ.mesh.file_node_count = hdf5.read_count(layout::kFileNodes, 4);
  organ.mesh.node_numbers = hdf5.read<std::int64_t>(layout::kNodeNumbers, 0);
  organ.mesh.tetrahedron_numbers = hdf5.read<std::int64_t>(layout::kTetrahedronNumbers, 0);
  if (hdf5.has_dataset(layout::kMerged))
    organ.mesh.merged = read_as<geometry::MergedNode, std::int32_t>(hdf5, layout::kMerged);
  if (hdf5.has_dataset(layout::kRegions)) read_regions(hdf5, file, organ);
  organ.surface.node = read_as<geometry::NodeId, std::int32_t>(hdf5, layout::kSurfaceNode);
  organ.surface.triangles = read_as<geometry::Triangle, std::int32_t>(hdf5, layout::kTriangles);
  organ.surface.tetrahedron = read_as<geometry::TetId, std::int32_t>(hdf5, layout::kBehind);
  organ.surface.fan_start = hdf5.read<std::int32_t>(layout::kFanStart, 0);
  organ.surface.fan = read_as<geometry::TriangleId, std::int32_t>(hdf5, layout::kFan);
  organ.surface.mobile_count = hdf5.read_count(layout::kMobile, 1);
  organ.fixed = hdf5.read<std::uint8_t>(layout::kFixed, 0);
  return organ;
}

void read_split(const Hdf5File& hdf5, const std::filesystem::path& file, Organ& organ) {
  organ.split.emplace();
  organ.split->dynamic = hdf5.read<std::uint8_t>(layout::kDynamic, 0);
  organ.split->tensor_node = read_as<geometry::NodeId, std::int32_t>(hdf5, layout::kTensorNode);
  if (hdf5.has_dataset(layout::kBorder))
    organ.split->border = read_as<std::array<geometry::NodeId, 3>, std::int32_t>(hdf5, layout::kBorder);
  if (organ.split->dynamic.size() == organ.mesh.tetrahedra.size()) return;
  throw InputError(file.string() + ": is damaged: '" + layout::kDynamic +
                   "' has not a number for each tetrahedron");
}

// Of a mesh that was checked. Its surface is numbered by today's program, its tensors by that which wrote
// them.
void split(Organ& organ, const std::filesystem::path& file) {
  const std::vector<geometry::NodeId> columns = std::move(organ.split->tensor_node);
  organ.split = split_organ(organ.mesh, organ.fixed, std::move(organ.split->dynamic), file.string() + ": ",
                            std::move(organ.split->border));
  if (organ.split->tie)
    organ.surface = geometry::without_covered(organ.mesh, organ.surface, organ.split->covered);
  if (columns == organ.split->tensor_node) return;
  throw InputError(file.string() +
                   ": its tensors are those of another split than its dynamic part's; build it again");
}

void require_wanted_tensors(const Organ& organ, Load what, const std::filesystem::path& file) {
  if (what == Load::kWithTensors && organ.split) {
    throw InputError(
        file.string() +
        ": is a hybrid organ, whose tensors are of its precomputed part alone; expected the model "
        "hybrid, or an organ built without --dynamic");
  }
  if (what == Load::kWithPart && !organ.split) {
    throw InputError(file.string() +
                     ": has no dynamic part; expected a hybrid organ (organ_build --dynamic)");
  }
}

// Which surface node each mesh node is.
std::vector<SurfaceId> invert(const std::vector<geometry::NodeId>& nodes, std::size_t node_count) {
  std::vector<SurfaceId> of_node(node_count);
  for (std::size_t s = 0; s < nodes.size(); ++s) of_node[nodes[s]] = SurfaceId(s);
  return of_node;
}

}  // namespace

std::vector<SurfaceId> Organ::surface_of_file_node() const {
  std::vector<SurfaceId> of_file(mesh.file_node_count);
  for (std::size_t s = 0; s < surface.node.size(); ++s)
    of_file[mesh.file_node[surface.node[s]]] = SurfaceId(s);
  for (const auto& [dropped, kept] : mesh.merged) of_file[dropped] = of_file[kept];
  return of_file;
}

Organ load_organ(const std::filesystem::path& file, Load what) {
  Organ organ;
  {
    const Hdf5File hdf5(file, Hdf5File::Mode::kRead);
    require_format(hdf5, file);
    organ = read_contents(hdf5, file);
    if (hdf5.has_dataset(layout::kDynamic)) read_split(hdf5, file, organ);
    organ.hash = organ_hash(organ);
    if (organ.hash != hdf5.read_text(layout::kHash)) {
      throw InputError(
          file.string() +
          ": its mesh, material or supports are not those that its tensors were computed from (hash " +
          organ.hash.substr(0, 12) + ", expected " + hdf5.read_text(layout::kHash).substr(0, 12) +
          "); build it again");
    }
  }
  require_consistent(organ, file);
  organ.surface.of_node = invert(organ.surface.node, organ.mesh.positions.size());
  if (organ.split) split(organ, file);
  require_wanted_tensors(organ, what, file);
  if (what == Load::kWithTensors) organ.compliance = surface_compliance(map_tensors(file, organ));
  if (what == Load::kWithPart) organ.split->compliance = surface_compliance(map_tensors(file, organ));
  return organ;
}

}  // namespace omentum::organ
