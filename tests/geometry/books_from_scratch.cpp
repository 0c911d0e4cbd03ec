#include "tests/geometry/books_from_scratch.h"

#include "geometry/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>

namespace omentum::geometry {
namespace {

Corners turned(std::int32_t a, std::int32_t b, std::int32_t c) {
  Corners nodes{a, b, c};
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// The outward sides of the chosen tetrahedra, by turned nodes. Outward: away from the corner that is not in
// it.
std::map<Corners, std::int32_t> sides_of(const TetraMesh& mesh, const std::vector<std::int32_t>& chosen) {
  std::map<Corners, std::int32_t> sides;
  for (const std::int32_t t : chosen) {
    const auto& [a, b, c, d] = mesh.tetrahedra[static_cast<std::size_t>(t)];
    for (const Corners& side : {turned(a, c, b), turned(a, b, d), turned(b, c, d), turned(c, a, d)})
      sides.emplace(side, t);
  }
  return sides;
}

// Merges labels until neighbours agree.
void label_pieces(Books& books, const std::map<Corners, std::int32_t>& sides,
                  const std::vector<std::int32_t>& left) {
  for (const std::int32_t t : left) books.piece[t] = t;
  const auto root = [&](std::int32_t t) {
    while (books.piece[t] != t) t = books.piece[t];
    return t;
  };
  for (const auto& [side, t] : sides) {
    const auto other = sides.find(turned(side[2], side[1], side[0]));
    if (other != sides.end()) books.piece[root(t)] = root(other->second);
  }
  std::set<std::int32_t> roots;
  for (const std::int32_t t : left) roots.insert(root(t));
  for (const std::int32_t t : left) books.piece[t] = root(t);
  books.pieces = static_cast<std::int32_t>(roots.size());
}

bool same_pieces(const MeshEditor& editor, const Books& books) {
  std::map<std::int32_t, std::int32_t> theirs_of_ours;
  std::set<std::int32_t> used;
  for (const auto& [t, piece] : books.piece) {
    const std::int32_t theirs = editor.piece_of(TetId(t));
    const auto [known, fresh] = theirs_of_ours.try_emplace(piece, theirs);
    if (known->second != theirs || (fresh && !used.insert(theirs).second)) return false;
  }
  return editor.piece_count() == books.pieces;
}

bool same_faces(const MeshEditor& editor, const Books& books) {
  std::map<Corners, FaceBook> theirs;
  for (const SurfaceFace& face : editor.faces())
    theirs[turned(face.nodes[0], face.nodes[1], face.nodes[2])] = {face.behind, face.bared};
  return theirs == books.faces && editor.faces().size() == books.faces.size();
}

bool same_places(const MeshEditor& editor, const Books& books) {
  std::vector<SurfaceId> place(books.uses.size());
  for (std::size_t s = 0; s < books.surface.size(); ++s)
    place[static_cast<std::size_t>(books.surface[s])] = SurfaceId(s);
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (editor.surface_of(NodeId(n)) != place[n]) return false;
  }
  return std::ranges::equal(editor.surface_nodes(), books.surface);
}

bool same_uses(const MeshEditor& editor, const Books& books) {
  for (std::size_t n = 0; n < books.uses.size(); ++n) {
    if (editor.uses(NodeId(n)) != books.uses[n]) return false;
  }
  return true;
}

bool same_set(const MeshEditor& editor, std::size_t left, std::size_t all) {
  std::size_t set = 0;
  for (const std::uint8_t byte : editor.removed_bits()) set += static_cast<std::size_t>(std::popcount(byte));
  return set == all - left && static_cast<std::size_t>(editor.removed_count()) == all - left;
}

}  // namespace

Books books_from_scratch(const TetraMesh& mesh, const std::vector<std::int32_t>& left,
                         std::span<const NodeId> uncut) {
  Books books;
  books.uses.assign(mesh.positions.size(), 0);
  std::vector<std::int32_t> all(mesh.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  const auto whole = sides_of(mesh, all), sides = sides_of(mesh, left);
  std::set<NodeId> bared;
  for (const auto& [side, t] : sides) {
    const Corners back = turned(side[2], side[1], side[0]);
    if (sides.contains(back)) continue;
    books.faces[side] = {t, whole.contains(back)};
    for (const std::int32_t n : side) bared.insert(NodeId(n));
  }
  books.surface.assign(uncut.begin(), uncut.end());
  for (const NodeId n : uncut) bared.erase(n);
  books.surface.insert(books.surface.end(), bared.begin(), bared.end());
  for (const std::int32_t t : left) {
    for (const NodeId n : mesh.tetrahedra[static_cast<std::size_t>(t)])
      ++books.uses[static_cast<std::size_t>(n)];
  }
  label_pieces(books, sides, left);
  return books;
}

std::vector<std::int32_t> left_of(const MeshEditor& editor, const TetraMesh& mesh) {
  std::vector<std::int32_t> left;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (!editor.is_removed(TetId(t))) left.push_back(static_cast<std::int32_t>(t));
  }
  return left;
}

std::string difference_from_scratch(const MeshEditor& editor, const TetraMesh& mesh,
                                    std::span<const NodeId> uncut) {
  const std::vector<std::int32_t> left = left_of(editor, mesh);
  const Books books = books_from_scratch(mesh, left, uncut);
  if (!same_set(editor, left.size(), mesh.tetrahedra.size())) return "counts and bits of the removed differ";
  if (!same_uses(editor, books)) return "uses differ";
  if (!same_faces(editor, books)) return "faces differ";
  if (!same_places(editor, books)) return "surface nodes differ";
  if (!same_pieces(editor, books)) return "pieces differ";
  return {};
}

std::string not_manifold(const MeshEditor& editor, const TetraMesh& mesh) {
  std::vector<std::array<std::int32_t, 4>> left;
  for (const std::int32_t t : left_of(editor, mesh)) {
    const Tetrahedron& v = mesh.tetrahedra[static_cast<std::size_t>(t)];
    left.push_back({v[0], v[1], v[2], v[3]});
  }
  const std::vector<FaceSide> sides = collect_face_sides(left);
  if (!touching_along_edges(sides).empty()) return "boundary edges have more than two faces";
  if (!pinched_nodes(sides, left, mesh.positions.size()).empty()) return "nodes have several fans";
  if (!pinched_boundary_nodes(sides, mesh.positions.size()).empty()) return "hollows touch in nodes";
  return {};
}

}  // namespace omentum::geometry
