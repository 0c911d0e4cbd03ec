// What is seen around the organs: meshes that stand still, loaded once and sent once.
#pragma once

#include "geometry/types.h"
#include "render_node/renderer.h"
#include "scene/scenery_spec.h"

#include <span>
#include <vector>

namespace omentum::render {

struct Outline;

/// A piece of scenery as it is drawn.
struct SceneryPiece {
  MeshData mesh;  // in W
  Look look = Look::kTissue;
  Material material;
};

/// Of a scene's [[scenery]]. What is only a word, in a scene that nobody prepared, is left out, which is said
/// on standard error: a session without scenery is none the worse. Throws geometry::InputError naming file
/// and place for an STL surface or a mesh that cannot be read or is not valid.
std::vector<SceneryPiece> load_scenery(std::span<const scene::ScenerySpec> scenery);

/// A surface as that look has it: of a "wall" the inside alone is seen, paler where it goes over a ridge,
/// which stretches it. `triangles` outward.
SceneryPiece make_scenery(std::span<const geometry::Vec3> places, std::vector<geometry::Triangle> triangles,
                          const std::string& look);

/// The scenery that a renderer holds. One thread, the renderer's.
class Scenery {
 public:
  explicit Scenery(Renderer& renderer) : renderer_(renderer) {}

  /// From now on it is this, shaded by the organs of `outline`. Once.
  void set(std::vector<SceneryPiece> pieces, const Outline& outline);
  /// Whether there is a wall, which needs no ground below the organs.
  bool encloses() const;
  void draw(std::vector<DrawItem>& items) const;
  /// What may hide an organ: all but walls.
  std::vector<const MeshData*> covers() const;

 private:
  Renderer& renderer_;
  std::vector<SceneryPiece> pieces_;
  std::vector<MeshId> meshes_;  // of the pieces
};

}  // namespace omentum::render
