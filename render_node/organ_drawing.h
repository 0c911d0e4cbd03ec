// What is drawn of an organ: chosen by its kind, in one place.
#pragma once

#include "geometry/gut_shape.h"
#include "render_node/organ_look.h"
#include "render_node/organ_skin.h"
#include "scene/scene.h"

#include <memory>

namespace omentum::render {

class TubeFrames;

/// One organ at rest: what its source says of it.
struct OrganShape {
  scene::OrganKind kind = scene::OrganKind::kTetrahedralMesh;
  geometry::Surface surface;
  std::vector<geometry::Vec3> rest;                       // [S], m
  std::vector<geometry::SurfaceId> surface_of_file_node;  // invalid where none
  Material material = tissue_material("liver");
  Material bared = bared_material("liver");
  // What the surface bounds; null: it is never cut. Shared, because shapes are copied and meshes are large.
  std::shared_ptr<const geometry::TetraMesh> mesh{};
  std::vector<geometry::CoveredFace> covered{};     // of it, that are no surface as yet
  std::shared_ptr<const geometry::GutShape> gut{};  // of a tube, which has no surface of its own; else null
};

/// A surface that tools press: its skin, and which of its nodes a file's node is.
struct PressedSurface {
  OrganSkin skin;
  std::vector<geometry::SurfaceId> surface_of_file_node;

  /// Invalid where the file's node is not on the surface.
  geometry::SurfaceId node(std::uint32_t file_node) const {
    return file_node < surface_of_file_node.size() ? surface_of_file_node[file_node] : geometry::SurfaceId();
  }
};

/// The outside of an organ, for the camera's distance and the ground under it.
struct Outline {
  std::vector<geometry::Vec3> points;  // in W, m
  std::vector<Vec3f> normals;          // of the points, outward, unit; zero where only the place counts
  double area_m2 = 0;
};

/// What a topology is to an organ that is drawn.
enum class CutOutcome {
  kMisfit,  // no state that lacks this has so many nodes; nothing was changed
  kSame,    // it is drawn so already
  kCut,     // more lies bare, or less
};

/// A further mesh of an organ, with a material of its own: as many vertices and triangles as ever.
struct OrganPart {
  const MeshData* mesh;
  Look look;
  Material material;
};

/// From the values of an organ's states to lit vertices. One thread, the renderer's.
class OrganDrawing {
 public:
  virtual ~OrganDrawing() = default;

  /// As it lies now where it wanders(), else at rest.
  virtual Outline outline() const = 0;
  /// Whether it moves so far that the ground's shade has to follow.
  virtual bool wanders() const { return false; }
  /// `values`: of a whole state of this organ's kind, x y z of each node.
  virtual void deform(std::span<const float> values) = 0;
  /// From here on exactly this is removed of it, and its states have `node_count` nodes.
  [[nodiscard]] virtual CutOutcome cut(const RemovedSet& removed, std::size_t /*node_count*/) {
    return removed.whole() ? CutOutcome::kSame : CutOutcome::kMisfit;
  }
  /// `shares`: of the map's scale at each node of the state that is drawn next (tissue_map.h). False: this
  /// organ is not drawn as a map.
  [[nodiscard]] virtual bool map(std::span<const float> /*shares*/) { return false; }
  /// `dt_s` go by under these forces of all tools: tissue pales (pallor.h), blood runs. Whether meshes
  /// changed. Nodes that it does not have are left out.
  virtual bool live(std::span<const NodeForce> /*forces*/, double /*dt_s*/) { return false; }
  /// As many vertices and triangles as ever.
  virtual const MeshData& mesh() const = 0;
  /// What is drawn instead of mesh(), where the organ is a tube, whose mesh() is only what other programs of
  /// the processor look at; null for any other organ.
  virtual TubeFrames* tube() { return nullptr; }
  /// Which triangles of mesh() the last cut() changed.
  virtual std::span<const TriangleRun> changed() const { return {}; }
  /// What cuts laid bare, of any size; null before the first one.
  virtual const MeshData* bared() const { return nullptr; }
  /// Drops on it, always as many vertices and triangles; null before the first one bled.
  virtual const MeshData* blood() const { return nullptr; }
  virtual Material bared_material() const { return material(); }
  /// Tetrahedra, now.
  virtual std::int32_t removed_count() const { return 0; }
  virtual Material material() const = 0;
  virtual Look look() const { return Look::kTissue; }
  /// What is drawn beside mesh() and moves with it, always the same parts.
  virtual std::vector<OrganPart> parts() const { return {}; }
  /// How long it is now, m; 0 for an organ that is not one long tube.
  virtual double length_m() const { return 0; }
  /// Where tools dent it; null for an organ without such a surface.
  virtual const PressedSurface* surface() const { return nullptr; }
};

/// All that is drawn of an organ now.
std::vector<const MeshData*> meshes_of(const OrganDrawing& drawing);

/// The drawing for an organ of that kind.
std::unique_ptr<OrganDrawing> make_drawing(const OrganShape& shape);

}  // namespace omentum::render
