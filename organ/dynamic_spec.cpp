#include "organ/dynamic_spec.h"

#include "organ/csv.h"
#include "organ/place_spec.h"
#include "organ/plausibility.h"
#include "organ/tetrahedra_csv.h"

#include <algorithm>

namespace omentum::organ {

namespace {

using geometry::TetId;
using geometry::TetraMesh;

constexpr std::string_view kLabel = "label:";

[[noreturn]] void refuse(const std::string& spec, const std::string& what) {
  throw geometry::InputError("--dynamic " + spec + ": " + what);
}

std::vector<TetId> centred_in(const Place& place, const TetraMesh& mesh) {
  std::vector<TetId> found;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    geometry::Vec3 sum = geometry::Vec3::Zero();
    for (const geometry::NodeId n : mesh.tetrahedra[t]) sum += mesh.positions[n];
    if (place(sum / 4)) found.emplace_back(t);
  }
  return found;
}

std::vector<TetId> labelled(const std::string& spec, const TetraMesh& mesh) {
  const auto label = parse_integer(spec.substr(kLabel.size()));
  if (!label) refuse(spec, "not a label; expected label:N, a whole number");
  if (mesh.regions.empty()) {
    refuse(spec, "the mesh file gives its tetrahedra no labels" +
                     (mesh.why_no_regions.empty() ? "" : ": " + mesh.why_no_regions));
  }
  std::vector<TetId> found;
  for (std::size_t t = 0; t < mesh.regions.size(); ++t)
    if (mesh.regions[t] == *label) found.emplace_back(t);
  return found;
}

std::vector<TetId> named_by(const std::string& spec, const TetraMesh& mesh, geometry::Numbering numbering) {
  if (spec.starts_with(kLabel)) return labelled(spec, mesh);
  if (const Place place = place_of(spec, "--dynamic", spec)) return centred_in(place, mesh);
  return read_tetrahedra(spec, mesh, numbering);
}

}  // namespace

std::vector<std::uint8_t> parse_dynamic(std::span<const std::string> specs, const TetraMesh& mesh,
                                        geometry::Numbering numbering) {
  if (specs.empty()) return {};
  std::vector<std::uint8_t> dynamic(mesh.tetrahedra.size(), 0);
  for (const std::string& joined : specs) {
    for (const std::string& spec : split_joined(joined)) {
      const std::vector<TetId> found = named_by(spec, mesh, numbering);
      if (found.empty()) refuse(spec, "names no tetrahedron; the mesh extends over " + extent_text(mesh));
      for (const TetId t : found) dynamic[t] = 1;
    }
  }
  return dynamic;
}

}  // namespace omentum::organ
