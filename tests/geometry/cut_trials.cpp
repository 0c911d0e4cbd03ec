#include "tests/geometry/cut_trials.h"

#include "geometry/surface.h"
#include "tests/geometry/books_from_scratch.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace omentum::geometry {
namespace {

// One sequence in the making.
class Sequence {
 public:
  Sequence(const TetraMesh& mesh, std::uint32_t seed)
      : mesh_(mesh),
        random_(seed),
        uncut_(shuffled_surface()),
        whole_m3_(volume_of(all())),
        smallest_m3_(smallest_piece()),
        editor_(mesh, {.smallest_piece_m3 = smallest_m3_, .uncut_surface = uncut_}) {}

  std::string run() {
    std::string wrong = check();
    for (int change = 0; wrong.empty() && editor_.removed_count() < total() && change < 300; ++change) {
      wrong = apply_one();
      if (!wrong.empty()) wrong += " at change " + std::to_string(change);
    }
    if (!wrong.empty()) return wrong;
    wrong = cut(as_tets(all()));
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

  std::vector<std::int32_t> all() const {
    std::vector<std::int32_t> numbers(mesh_.tetrahedra.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }
  static std::vector<TetId> as_tets(const std::vector<std::int32_t>& numbers) {
    std::vector<TetId> tets;
    for (const std::int32_t t : numbers) tets.emplace_back(t);
    return tets;
  }

  double volume_of(const std::vector<std::int32_t>& tetrahedra) const {
    double volume = 0;
    for (const std::int32_t t : tetrahedra) {
      const Tetrahedron& v = mesh_.tetrahedra[static_cast<std::size_t>(t)];
      volume += signed_volume(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
    }
    return volume;
  }
  // None, or about that of one, three or thirty tetrahedra.
  double smallest_piece() {
    return std::array{0.0, 0.0, 1.0, 3.0, 30.0}[static_cast<std::size_t>(pick(5))] * whole_m3_ / total();
  }

  // Volumes of the parts that these fall into, m^3.
  std::vector<double> part_volumes(const std::vector<std::int32_t>& tetrahedra) const {
    std::map<std::int32_t, double> volume;
    for (const auto& [t, part] : books_from_scratch(mesh_, tetrahedra, {}).piece)
      volume[part] += volume_of({t});
    std::vector<double> volumes;
    for (const auto& [part, m3] : volume) volumes.push_back(m3);
    return volumes;
  }
  // Every part that is left is large enough, and every one that was dropped was not; up to rounding.
  bool sizes_hold(std::span<const TetId> dropped) const {
    const double rounding = 1e-12 * whole_m3_;
    const auto large = [&](double m3) { return m3 > smallest_m3_ - rounding; };
    const auto small = [&](double m3) { return m3 < smallest_m3_ + rounding; };
    return std::ranges::all_of(part_volumes(left_of(editor_, mesh_)), large) &&
           std::ranges::all_of(part_volumes({dropped.begin(), dropped.end()}), small);
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
    if (!sizes_hold(removal.dropped)) return "pieces are dropped that are not to be, or the other way round";
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
  double whole_m3_, smallest_m3_;
  MeshEditor editor_;
};

}  // namespace

std::string try_cut_sequence(const TetraMesh& mesh, std::uint32_t seed) {
  return Sequence(mesh, seed).run();
}

}  // namespace omentum::geometry
