// What is drawn of an organ: chosen by its kind, in one place.
#pragma once

#include "render_node/organ_look.h"
#include "render_node/organ_skin.h"
#include "scene/scene.h"

#include <memory>

namespace omentum::render {

/// One organ at rest: what its source says of it.
struct OrganShape {
  scene::OrganKind kind = scene::OrganKind::kTetrahedralMesh;
  geometry::Surface surface;
  std::vector<geometry::Vec3> rest;                       // [S], m
  std::vector<geometry::SurfaceId> surface_of_file_node;  // invalid where none
  Material material = tissue_material("liver");
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

/// The outside of an organ at rest, for the camera's distance and the ground under it.
struct RestOutline {
  std::vector<geometry::Vec3> points;  // in W, m
  std::vector<Vec3f> normals;          // of the points, outward, unit
  double area_m2 = 0;
};

/// From the values of an organ's states to lit vertices. One thread, the renderer's.
class OrganDrawing {
 public:
  virtual ~OrganDrawing() = default;

  virtual RestOutline rest_outline() const = 0;
  /// `values`: of a whole state of this organ's kind, x y z of each node.
  virtual void deform(std::span<const float> values) = 0;
  /// Its triangles stay what they are.
  virtual const MeshData& mesh() const = 0;
  virtual Material material() const = 0;
  /// Where tools dent it; null for an organ without such a surface.
  virtual const PressedSurface* surface() const { return nullptr; }
};

/// The drawing for an organ of that kind.
std::unique_ptr<OrganDrawing> make_drawing(const OrganShape& shape);

}  // namespace omentum::render
