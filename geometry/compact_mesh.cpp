#include "geometry/compact_mesh.h"

namespace omentum::geometry {
namespace {

// Marks the used ones with 0, the others with -1.
std::vector<std::int32_t> mark_used(std::size_t node_count, RawTetrahedra tetrahedra) {
  std::vector<std::int32_t> marks(node_count, -1);
  for (const auto& v : tetrahedra) {
    for (const std::int32_t node : v) marks[static_cast<std::size_t>(node)] = 0;
  }
  return marks;
}

template <class T>
std::vector<T> chosen(const std::vector<T>& of_all, std::span<const std::size_t> which) {
  std::vector<T> some;
  some.reserve(which.size());
  for (const std::size_t i : which) some.push_back(of_all[i]);
  return some;
}

// The file's own numbers; from 0 where it has none.
std::vector<std::int64_t> numbers_in_file(const std::vector<std::int64_t>& own, std::size_t count) {
  std::vector<std::int64_t> numbers = own;
  for (std::size_t i = numbers.size(); i < count; ++i) numbers.push_back(static_cast<std::int64_t>(i));
  return numbers;
}

}  // namespace

TetraMesh compact_mesh(const RawMesh& raw, std::span<const Vec3> positions, RawTetrahedra tetrahedra,
                       std::span<const std::size_t> kept) {
  TetraMesh mesh;
  std::vector<std::int32_t> compact = mark_used(positions.size(), tetrahedra);
  for (std::size_t n = 0; n < positions.size(); ++n) {
    if (compact[n] < 0) continue;
    compact[n] = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.push_back(positions[n]);
    mesh.file_node.push_back(static_cast<std::int32_t>(n));
  }
  const auto node = [&](std::int32_t n) { return NodeId(compact[static_cast<std::size_t>(n)]); };
  mesh.tetrahedra.reserve(tetrahedra.size());
  for (const auto& [a, b, c, d] : tetrahedra) mesh.tetrahedra.push_back({node(a), node(b), node(c), node(d)});
  mesh.file_node_count = static_cast<std::int32_t>(positions.size());
  mesh.node_numbers = numbers_in_file(raw.node_numbers, raw.positions.size());
  mesh.tetrahedron_numbers = chosen(numbers_in_file(raw.tetrahedron_numbers, raw.tetrahedra.size()), kept);
  if (!raw.regions.empty()) mesh.regions = chosen(raw.regions, kept);
  mesh.why_no_regions = raw.why_no_regions;
  return mesh;
}

}  // namespace omentum::geometry
