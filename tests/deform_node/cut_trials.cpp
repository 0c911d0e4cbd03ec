#include "tests/deform_node/cut_trials.h"

#include "deform_node/body_stepper.h"
#include "geometry/mesh_editor.h"
#include "physics/dynamics/imposed_press.h"
#include "physics/unheld_pieces.h"
#include "tests/deform_node/rates.h"
#include "tests/geometry/books_from_scratch.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace omentum::deform {

namespace {

using geometry::TetId;

constexpr double kReach_m = 0.02, kMostForce_n = 20;
constexpr double kRounding = 1e-4;  // of forces that are told in float

class Trial {
 public:
  Trial(const TriedOrgan& organ, std::uint32_t seed) : organ_(organ), random_(seed), model_(organ.make()) {}

  std::string run(int ticks) {
    for (int i = 0; i < ticks && wrong_.empty(); ++i) {
      tick();
      if (!wrong_.empty()) wrong_ += ", at tick " + std::to_string(i);
    }
    return wrong_;
  }

 private:
  int any(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void require(bool holds, const char* what) {
    if (!holds && wrong_.empty()) wrong_ = what;
  }

  Vec3 any_place() {
    const auto i = static_cast<std::size_t>(any(static_cast<int>(organ_.places.size())));
    return organ_.mesh.positions[organ_.places[i]];
  }

  // A blade of a few centimetres, moved by as much.
  CutStroke stroke() {
    const Vec3 place = any_place();
    const auto aside = [&]() -> Vec3 {
      return Vec3(between(-1, 1), between(-1, 1), between(-1, 1)) * kReach_m;
    };
    const Vec3 along = aside(), way = aside();
    return {.tool = 0,
            .cut = 1,
            .from = {place - along, place + along},
            .to = {place - along + way, place + way}};
  }

  void tick() {
    const CutStroke blade = stroke();
    const bool cuts = any(3) == 0;
    if (any(60) == 0) {
      model_->reset();
      let_go();  // what was said of the organ before is refused (contact_book.h)
    }
    if (any(60) == 0) compare_taken_up();
    const ToolLoad load{.tool = 0, .nodes = pressed_, .displacements = places_, .forces = forces_};
    model_->step({.presses = {&load, pressed_.empty() ? 0U : 1U}, .cuts = {&blade, cuts ? 1U : 0U}}, kTick_s);
    check_state();
    press();
  }

  void check_state() {
    require(!model_->status().diverged, "it diverged");
    require(model_->status().fault.empty(), "it had a fault");
    require(std::ranges::all_of(model_->view().values, [](float v) { return std::isfinite(v); }),
            "a state is not finite");
    if (model_->view().topology_version == version_) return;
    version_ = model_->view().topology_version;
    geometry::MeshEditor editor(organ_.mesh);
    editor.set_removed(model_->view().removed_bits);
    if (const std::string why = geometry::not_manifold(editor, organ_.mesh); !why.empty() && wrong_.empty())
      wrong_ = why;
    if (organ_.is_static)
      require(physics::UnheldPieces(organ_.mesh, organ_.fixed).find(editor).empty(), "a piece floats");
    for (std::size_t t = 0; t < organ_.precomputed.size(); ++t)
      require(organ_.precomputed[t] == 0 || !editor.is_removed(TetId(t)), "a precomputed tetrahedron went");
  }

  // Where the hand is, it finds a patch, and answers with the force that brings the node in its middle there.
  void press() {
    if (any(20) == 0) place_ = any_place();
    if (!model_->local_model({0, place_, kReach_m}, patch_)) return let_go();
    check_patch();
    const auto n = static_cast<std::size_t>(any(static_cast<int>(patch_.node_count)));
    const std::size_t rows = 3 * patch_.node_count, first = 3 * n;
    const double yield = patch_.compliance[first * rows - first * (first + 1) / 2 + first];
    const NodeId node = node_at(patch_.nodes[n]);
    const Vec3 u = patch_.positions[n] - organ_.mesh.positions[node];
    const double way_m = std::clamp(organ_.depth_m - u.x(), -organ_.most_way_m, organ_.most_way_m);
    const double force_n = std::clamp(way_m / yield, -kMostForce_n, kMostForce_n);
    if (organ_.fixed[node] != 0 || any(10) == 0) return let_go();
    pressed_ = {node};
    forces_ = {Vec3(patch_.forces[n] + Vec3(force_n, 0, 0))};
    places_ = {Vec3(u + Vec3(force_n * yield, 0, 0))};
  }
  // A patch names nodes by their place in the mesh's file.
  NodeId node_at(std::uint32_t place) const {
    const auto& file_node = organ_.mesh.file_node;
    return NodeId(static_cast<std::size_t>(std::ranges::find(file_node, place) - file_node.begin()));
  }
  void let_go() {
    pressed_.clear();
    places_.clear();
    forces_.clear();
  }

  void check_patch() {
    const std::size_t rows = 3 * patch_.node_count;
    const auto finite = [](float c) { return std::isfinite(c); };
    require(
        std::all_of(patch_.compliance.begin(),
                    patch_.compliance.begin() + static_cast<std::ptrdiff_t>(rows * (rows + 1) / 2), finite),
        "a compliance is not finite");
    double said_n = 0;
    for (const Vec3& f : forces_) said_n += f.norm();
    for (std::size_t i = 0; i < patch_.node_count; ++i) {
      require(patch_.positions[i].allFinite() && patch_.forces[i].allFinite(), "a patch is not finite");
      require(patch_.forces[i].norm() <= physics::Press::kMostStrength * said_n * (1 + kRounding),
              "a force is beyond its bound");
    }
  }

  // A process that takes over answers the next press as this one does.
  void compare_taken_up() {
    const std::unique_ptr<OrganModel> other = organ_.make();
    const OrganView view = model_->view();
    other->take_up(view.removed_bits, view.burnt_bits, view.topology_version + 1);
    LocalPatch theirs(BodyStepper::kPatchNodes);
    const bool found = model_->local_model({0, place_, kReach_m}, patch_);
    require(std::ranges::equal(view.removed_bits, other->view().removed_bits),
            "who takes over has other cuts");
    if (organ_.turns || !pressed_.empty() || !found || !other->local_model({0, place_, kReach_m}, theirs))
      return;
    if (theirs.nodes != patch_.nodes) return;  // it lies elsewhere: one is bent
    for (std::size_t i = 0; i < 9 * patch_.node_count; ++i)
      require(std::abs(theirs.compliance[i] - patch_.compliance[i]) <= 1e-3F * patch_.compliance[0],
              "who takes over answers otherwise");
  }

  const TriedOrgan& organ_;
  std::mt19937 random_;
  std::unique_ptr<OrganModel> model_;
  LocalPatch patch_{BodyStepper::kPatchNodes};
  Vec3 place_ = Vec3::Zero();
  std::vector<NodeId> pressed_;
  std::vector<Vec3> places_, forces_;
  std::uint64_t version_ = 0;
  std::string wrong_;
};

}  // namespace

std::string try_cuts(const TriedOrgan& organ, std::uint32_t seed, int ticks) {
  return Trial(organ, seed).run(ticks);
}

}  // namespace omentum::deform
