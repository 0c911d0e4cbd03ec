#include "tests/geometry/cut_trials.h"

#include "geometry/mesh_topology.h"
#include "geometry/surface.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>

namespace omentum::geometry {
namespace {

using Corners = std::array<std::int32_t, 3>;

// The nodes of a face turned so that the smallest is first: equal for equal faces seen from the same side.
Corners turned(std::int32_t a, std::int32_t b, std::int32_t c) {
  Corners nodes{a, b, c};
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

struct FaceBook {
  std::int32_t behind;
  bool bared;
  auto operator<=>(const FaceBook&) const = default;
};

struct Books {
  std::vector<std::int32_t> uses;
  std::map<Corners, FaceBook> faces;  // by turned nodes, outward
  std::vector<NodeId> surface;
  std::map<std::int32_t, std::int32_t> piece;  // a tetrahedron of the same piece, of each that is left
  std::int32_t pieces = 0;
};

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

// One sequence in the making.
class Sequence {
 public:
  Sequence(const TetraMesh& mesh, std::uint32_t seed)
      : mesh_(mesh),
        random_(seed),
        uncut_(shuffled_surface()),
        editor_(mesh, {.smallest_piece_m3 = smallest_piece(), .uncut_surface = uncut_}) {}

  std::string run() {
    std::string wrong = check();
    for (int change = 0; wrong.empty() && editor_.removed_count() < total() && change < 300; ++change) {
      wrong = apply_one();
      if (!wrong.empty()) wrong += " at change " + std::to_string(change);
    }
    if (!wrong.empty()) return wrong;
    std::vector<TetId> all;
    for (std::int32_t t = 0; t < total(); ++t) all.emplace_back(t);
    wrong = cut(all);
    if (wrong.empty() && editor_.removed_count() != total()) wrong = "something is left at the end";
    return wrong;
  }

 private:
  std::int32_t total() const { return static_cast<std::int32_t>(mesh_.tetrahedra.size()); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  TetId any() { return TetId(static_cast<std::int32_t>(pick(total()))); }

  std::vector<NodeId> shuffled_surface() {
    std::vector<NodeId> nodes = extract_surface(mesh_, {}).node;
    std::shuffle(nodes.begin(), nodes.end(), random_);
    return nodes;
  }

  // None, or about that of one, three or thirty tetrahedra.
  double smallest_piece() {
    double volume = 0;
    for (const Tetrahedron& v : mesh_.tetrahedra)
      volume += signed_volume(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
    return std::array{0.0, 0.0, 1.0, 3.0, 30.0}[static_cast<std::size_t>(pick(5))] * volume / total();
  }
  const Vec3& at(NodeId n) const { return mesh_.positions[static_cast<std::size_t>(n)]; }
  Vec3 centre(TetId t) const {
    Vec3 sum = Vec3::Zero();
    for (const NodeId n : mesh_.tetrahedra[static_cast<std::size_t>(t)]) sum += at(n) / 4;
    return sum;
  }

  std::string apply_one() {
    const int kind = pick(40);
    if (kind == 0) return replace_set(true);
    if (kind == 1) return replace_set(false);
    if (kind < 6) return cut(stroke());
    if (kind < 10) return cut(batch());
    return cut({any()});
  }

  std::vector<TetId> batch() {
    std::vector<TetId> some = {TetId{}, TetId(total()), TetId(total() + 7)};
    for (int i = pick(12); i >= 0; --i) some.push_back(any());
    some.push_back(some.back());
    return some;
  }

  std::vector<TetId> stroke() {
    const Vec3 from = centre(any()), to = centre(any());
    const double reach = 0.1 * (mesh_.positions.front() - mesh_.positions.back()).norm();
    std::vector<TetId> near;
    for (std::int32_t t = 0; t < total(); ++t) {
      const Vec3 away = centre(TetId(t)) - from, along = to - from;
      const double s = std::clamp(along.dot(away) / (along.squaredNorm() + 1e-30), 0.0, 1.0);
      if ((away - s * along).norm() < 0.5 * reach) near.emplace_back(t);
    }
    return near;
  }

  std::string cut(const std::vector<TetId>& asked) {
    const std::vector<std::int32_t> before = left_of(editor_, mesh_);
    const Removal removal = editor_.remove(asked);
    std::set<std::int32_t> expected(before.begin(), before.end());
    for (const auto& part : {removal.asked, removal.repaired, removal.dropped}) {
      for (const TetId t : part) {
        if (expected.erase(t) == 0) return "a tetrahedron is removed twice, or was gone";
      }
    }
    if (!std::ranges::equal(expected, left_of(editor_, mesh_))) return "what is told is not what is gone";
    for (const TetId t : asked) {
      if (t.valid() && t < total() && !editor_.is_removed(t)) return "what is asked for is not gone";
    }
    const std::string wrong = check();
    return wrong.empty() ? not_manifold(editor_, mesh_) : wrong;
  }

  // Another editor's set replaces this one's, which is then taken up again; or the uncut mesh does for good.
  std::string replace_set(bool for_good) {
    const std::vector<std::uint8_t> own(editor_.removed_bits().begin(), editor_.removed_bits().end());
    std::vector<std::uint8_t> other(own.size());
    for (std::uint8_t& byte : other) byte = static_cast<std::uint8_t>(pick(256));
    editor_.set_removed(other);
    if (std::string wrong = check(); !wrong.empty()) return "a foreign set: " + wrong;
    if (for_good && pick(4) == 0) {
      editor_.restore();
    } else {
      editor_.set_removed(own);
    }
    return check();
  }

  std::string check() { return difference_from_scratch(editor_, mesh_, uncut_); }

  const TetraMesh& mesh_;
  std::mt19937 random_;
  std::vector<NodeId> uncut_;
  MeshEditor editor_;
};

}  // namespace

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

std::string try_cut_sequence(const TetraMesh& mesh, std::uint32_t seed) {
  return Sequence(mesh, seed).run();
}

}  // namespace omentum::geometry
