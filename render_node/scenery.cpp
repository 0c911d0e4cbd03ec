#include "render_node/scenery.h"

#include "geometry/mesh_io/stl.h"
#include "geometry/surface.h"
#include "render_node/few_triangles.h"
#include "render_node/organ_drawing.h"
#include "render_node/solids.h"
#include "render_node/surface_shading.h"

#include <algorithm>
#include <iostream>

namespace omentum::render {
namespace {

constexpr float kFurrow_m = 0.03f;          // what shades a furrow between two lobes of fat
constexpr std::size_t kShadeSamples = 600;  // of the organs: with 3,000 vertices some 10 ms at start

constexpr float kFewSide_m = 0.02f;  // what the coarsest pictures show of it

// A ridge as sharp as a rib's is as pale as this; a bend that is less sharp by so much is not.
constexpr float kRidgePallor = 0.6f;
constexpr float kPlain_per_m = 4, kSharp_per_m = 30;

// How much a surface bends away from its normal at each vertex, 1/m: above 0 on a ridge, below in a furrow.
// The mean over its edges of the curvature of the circle through both ends.
std::vector<float> ridges(const MeshData& mesh) {
  std::vector<float> sum(mesh.vertices.size(), 0), edges(mesh.vertices.size(), 0);
  for (const MeshTriangle& triangle : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3];
      const Vec3f edge = mesh.vertices[b].position - mesh.vertices[a].position;
      if (edge.isZero(0)) continue;
      sum[a] -= 2 * edge.dot(mesh.vertices[a].normal) / edge.squaredNorm();
      edges[a] += 1;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (edges[v] > 0) sum[v] /= edges[v];
  return sum;
}

void pale_ridges(MeshData& mesh) {
  const std::vector<float> bend = ridges(mesh);
  for (std::size_t v = 0; v < bend.size(); ++v) {
    const float sharp = std::clamp((bend[v] - kPlain_per_m) / (kSharp_per_m - kPlain_per_m), 0.0f, 1.0f);
    mesh.vertices[v].pallor = kRidgePallor * sharp;
  }
}

// As it is, without the refinement of organs: nobody looks at it closely, and its vertices are lit in each
// frame.
MeshData shaded(std::span<const geometry::Vec3> places, std::span<const geometry::Triangle> triangles,
                bool has_furrows) {
  std::vector<Vec3f> positions;
  for (const geometry::Vec3& p : places) positions.push_back(p.cast<float>());
  std::vector<Vec3f> normals(positions.size(), Vec3f::UnitZ());
  std::vector<float> openness(positions.size(), 1.0f);
  smooth_normals(triangles, positions, normals);
  if (has_furrows) openness_of(triangles, positions, normals, kFurrow_m, openness);
  MeshData mesh;
  for (std::size_t v = 0; v < positions.size(); ++v)
    mesh.vertices.push_back({positions[v], normals[v], positions[v], openness[v]});
  for (const auto& [a, b, c] : triangles) {
    const auto vertex = [](geometry::SurfaceId s) { return static_cast<std::uint32_t>(s); };
    mesh.triangles.push_back({vertex(a), vertex(b), vertex(c)});
  }
  return mesh;
}

SceneryPiece load_piece(const scene::ScenerySpec& spec) {
  if (geometry::is_stl(spec.file)) {
    geometry::TriangleSurface surface = geometry::read_stl(spec.file);
    for (geometry::Vec3& p : surface.positions) p *= spec.metres_per_unit;
    return make_scenery(surface.positions, std::move(surface.triangles), spec.look);
  }
  const geometry::TetraMesh mesh =
      geometry::check_mesh(geometry::read_mesh(spec.file), spec.metres_per_unit).mesh;
  const geometry::Surface surface = geometry::extract_surface(mesh, {});
  return make_scenery(geometry::surface_positions(mesh, surface), surface.triangles, spec.look);
}

}  // namespace

std::vector<SceneryPiece> load_scenery(std::span<const scene::ScenerySpec> scenery) {
  std::vector<SceneryPiece> pieces;
  for (std::size_t i = 0; i < scenery.size(); ++i) {
    const std::string name = "scenery[" + std::to_string(i) + "]";
    if (scenery[i].file.empty()) {
      std::cerr << "render_node: " << name << ", " << scenery[i].mesh
                << ", has no file: left out (launch_scripts/run makes it)\n";
      continue;
    }
    try {
      pieces.push_back(load_piece(scenery[i]));
    } catch (const geometry::InputError& error) {
      throw geometry::InputError(name + ": " + error.what());
    }
  }
  return pieces;
}

SceneryPiece make_scenery(std::span<const geometry::Vec3> places, std::vector<geometry::Triangle> triangles,
                          const std::string& look) {
  const bool is_wall = look == "wall";
  if (is_wall)
    for (auto& [a, b, c] : triangles) std::swap(b, c);
  SceneryPiece piece{shaded(places, triangles, !is_wall), is_wall ? Look::kWall : Look::kTissue,
                     tissue_material(look)};
  if (is_wall) pale_ridges(piece.mesh);
  return piece;
}

void Scenery::set(std::vector<SceneryPiece> pieces, const Outline& outline) {
  pieces_ = std::move(pieces);
  for (SceneryPiece& piece : pieces_) {
    const std::vector<float> left =
        light_left(outline.points, outline.normals, outline.area_m2, kShadeSamples, piece.mesh.vertices);
    for (std::size_t v = 0; v < left.size(); ++v) piece.mesh.vertices[v].openness *= left[v];
    add_few_triangles(piece.mesh, kFewSide_m);
    meshes_.push_back(renderer_.add_mesh(piece.mesh));
  }
}

bool Scenery::encloses() const {
  return std::ranges::any_of(pieces_, [](const SceneryPiece& piece) { return piece.look == Look::kWall; });
}

std::vector<const MeshData*> Scenery::covers() const {
  std::vector<const MeshData*> meshes;
  for (const SceneryPiece& piece : pieces_)
    if (piece.look != Look::kWall) meshes.push_back(&piece.mesh);
  return meshes;
}

void Scenery::draw(std::vector<DrawItem>& items) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    items.push_back({meshes_[i], pieces_[i].look, Mat4f::Identity(), pieces_[i].material});
}

}  // namespace omentum::render
