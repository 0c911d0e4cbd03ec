#include "render_node/organ_drawing.h"

#include "geometry/tetra_faces.h"
#include "render_node/tube_drawing.h"

#include <optional>
#include <stdexcept>

namespace omentum::render {
namespace {

double area_of(std::span<const geometry::Triangle> triangles, std::span<const geometry::Vec3> p) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  return area;
}

// What is covered, as far as it is there: by the surface's nodes.
std::vector<geometry::Triangle> lining_of(const OrganShape& shape) {
  std::vector<geometry::Triangle> lining;
  for (const geometry::CoveredFace& face : shape.covered) {
    const geometry::Tetrahedron& v = shape.mesh->tetrahedra[face.behind];
    const auto& [j, k, l] = geometry::kFaceOpposite[static_cast<std::size_t>(face.corner)];
    const auto node = [&](int i) { return shape.surface.of_node[v[static_cast<std::size_t>(i)]]; };
    lining.push_back({node(j), node(k), node(l)});
  }
  return lining;
}

/// The boundary of a tetrahedral mesh; states are displacements of its nodes.
class SurfaceDrawing final : public OrganDrawing {
 public:
  explicit SurfaceDrawing(const OrganShape& shape)
      : shape_(shape),
        surface_{{shape.surface, shape.rest, lining_of(shape)}, shape.surface_of_file_node},
        outline_{shape.rest, {}, area_of(shape.surface.triangles, shape.rest)} {
    for (std::int32_t s = 0; s < surface_.skin.node_count(); ++s)
      outline_.normals.push_back(surface_.skin.rest_normal(geometry::SurfaceId(s)));
  }

  Outline outline() const override { return cut_ ? outline_now() : outline_; }
  // what was cut off falls, and comes back with a reset
  bool wanders() const override { return cut_.has_value(); }
  void deform(std::span<const float> values) override { surface_.skin.deform(values); }
  CutOutcome cut(const RemovedSet& removed, std::size_t node_count) override;
  bool map(std::span<const float> shares) override {
    surface_.skin.map(shares);
    return true;
  }
  bool live(std::span<const NodeForce> forces, double dt_s) override;
  const MeshData& mesh() const override { return surface_.skin.mesh(); }
  std::span<const TriangleRun> changed() const override { return surface_.skin.changed(); }
  const MeshData* bared() const override { return cut_ ? &surface_.skin.bared() : nullptr; }
  const MeshData* blood() const override {
    const MeshData& drops = surface_.skin.bleeding().mesh();
    return drops.vertices.empty() ? nullptr : &drops;
  }
  Material material() const override { return shape_.material; }
  Material bared_material() const override { return shape_.bared; }
  std::int32_t removed_count() const override { return removed_count_; }
  const PressedSurface* surface() const override { return &surface_; }

 private:
  void show_cut();
  Outline outline_now() const;

  OrganShape shape_;
  PressedSurface surface_;
  Outline outline_;
  RemovedSet removed_;           // of what is drawn
  std::optional<OrganCut> cut_;  // made when it is first cut
  std::int32_t removed_count_ = 0;
  std::vector<Press> on_skin_, on_bared_;  // workspace
};

// Of what is left, where it is; each node stands for as much of the surface as it did.
Outline SurfaceDrawing::outline_now() const {
  Outline now;
  const OrganSkin& skin = surface_.skin;
  for (geometry::SurfaceId s(0); s < skin.node_count(); s = geometry::SurfaceId(s + 1)) {
    if (!skin.has(s)) continue;
    now.points.push_back(skin.position(s).cast<double>());
    now.normals.push_back(skin.normal(s));
  }
  now.area_m2 =
      outline_.area_m2 * static_cast<double>(now.points.size()) / static_cast<double>(outline_.points.size());
  return now;
}

bool SurfaceDrawing::live(std::span<const NodeForce> forces, double dt_s) {
  on_skin_.clear();
  on_bared_.clear();
  OrganSkin& skin = surface_.skin;
  for (const auto& [file_node, force_n] : forces) {
    const geometry::SurfaceId s = surface_.node(file_node);
    if (!s.valid() || !skin.has(s)) continue;
    (skin.bare(s) ? on_bared_ : on_skin_).push_back(press_of(skin.position(s), skin.normal(s), force_n));
  }
  return skin.live(on_skin_, on_bared_, dt_s);
}

CutOutcome SurfaceDrawing::cut(const RemovedSet& removed, std::size_t node_count) {
  if (removed == removed_ || (removed.whole() && !cut_)) {
    const bool fits = node_count == static_cast<std::size_t>(surface_.skin.node_count());
    return fits ? CutOutcome::kSame : CutOutcome::kMisfit;
  }
  if (!shape_.mesh) return CutOutcome::kMisfit;
  if (!cut_) cut_.emplace(*shape_.mesh, shape_.surface, shape_.covered);
  cut_->set(removed);
  if (cut_->node_count() != node_count) return CutOutcome::kMisfit;
  removed_ = removed;
  show_cut();
  return CutOutcome::kCut;
}

void SurfaceDrawing::show_cut() {
  const CutShape now = cut_->shape();
  surface_.skin.cut(now);
  surface_.surface_of_file_node = shape_.surface_of_file_node;
  for (std::size_t s = shape_.rest.size(); s < now.node.size(); ++s) {
    const auto file_node = static_cast<std::size_t>(shape_.mesh->file_node[now.node[s]]);
    surface_.surface_of_file_node[file_node] = geometry::SurfaceId(s);
  }
  removed_count_ = cut_->removed_count();
}

}  // namespace

std::vector<const MeshData*> meshes_of(const OrganDrawing& drawing) {
  std::vector<const MeshData*> meshes{&drawing.mesh()};
  if (drawing.bared()) meshes.push_back(drawing.bared());
  for (const OrganPart& part : drawing.parts()) meshes.push_back(part.mesh);
  return meshes;
}

std::unique_ptr<OrganDrawing> make_drawing(const OrganShape& shape) {
  switch (shape.kind) {
    case scene::OrganKind::kTetrahedralMesh:
      return std::make_unique<SurfaceDrawing>(shape);
    case scene::OrganKind::kTube:
      return make_tube_drawing(*shape.gut, shape.material);
  }
  throw std::invalid_argument("an organ of a kind that nobody draws");
}

}  // namespace omentum::render
