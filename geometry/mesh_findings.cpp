#include "geometry/mesh_findings.h"

#include "geometry/twin_nodes.h"

#include <algorithm>

namespace omentum::geometry {
namespace {

// Offenders named in a message before it only counts.
constexpr std::size_t kNamed = 5;

Offenders each_once(Offenders which) {
  std::sort(which.begin(), which.end());
  which.erase(std::unique(which.begin(), which.end()), which.end());
  return which;
}

std::string numbered(const FileNumbers& names, const Offenders& which) {
  std::string text;
  for (std::size_t i = 0; i < std::min(which.size(), kNamed); ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(names.of(which[i]));
  }
  if (which.size() > kNamed) text += ", ... (" + std::to_string(which.size()) + " in all)";
  return text;
}

}  // namespace

std::string MeshFindings::tetrahedron(std::size_t t) const {
  return "tetrahedron " + std::to_string(tetrahedra_.of(place_in_file(t)));
}

std::string MeshFindings::list_tetrahedra(const Offenders& which) const {
  Offenders places;
  for (const std::size_t t : which) places.push_back(place_in_file(t));
  return numbered(tetrahedra_, each_once(std::move(places)));
}

void MeshFindings::refuse_tetrahedra(const Offenders& which, const std::string& what) {
  if (!which.empty()) reasons_.push_back("tetrahedra" + list_tetrahedra(which) + ": " + what);
}

void MeshFindings::refuse_nodes(Offenders which, const std::string& what) {
  if (!which.empty())
    reasons_.push_back("nodes" + numbered(nodes_, each_once(std::move(which))) + ": " + what);
}

void MeshFindings::refuse_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs) {
  if (!pairs.empty()) reasons_.insert(reasons_.begin(), describe_twins(pairs, nodes_, kNamed));
}

void MeshFindings::stop_if_refused() const {
  if (reasons_.empty()) return;
  std::string message = raw_.source + ": not a valid mesh: ";
  for (std::size_t i = 0; i < reasons_.size(); ++i) message += (i == 0 ? "" : "; ") + reasons_[i];
  throw InputError(message);
}

void MeshFindings::warn(std::size_t count, const char* singular, const char* plural) {
  if (count > 0) warn(std::to_string(count) + " " + (count == 1 ? singular : plural));
}

}  // namespace omentum::geometry
