// The tubes among a scene's organs, as the renderer holds them.
#pragma once

#include "render_node/renderer.h"
#include "render_node/tube_frames.h"

namespace omentum::render {

/// Sends frames of tubes and tells how they are drawn. One thread, the renderer's.
class SceneTubes {
 public:
  explicit SceneTubes(Renderer& renderer) : renderer_(renderer) {}

  /// The place of one more, from 0. `frames` must outlive this.
  std::size_t add(TubeFrames& frames);
  /// As its frames are now.
  void send(std::size_t tube);

  /// From now on, within tube_resolution.h's bounds.
  void set_resolution(const TubeResolution& resolution);
  const TubeResolution& resolution() const { return resolution_; }
  /// Of all, as the next frame draws them.
  TubeCost cost() const;

  /// `is_map`: of its shares; `by_turn`: of its folds, whatever is_map.
  TubeItem item(std::size_t tube, bool is_map, bool by_turn, const Material& material) const;

 private:
  struct Held {
    TubeFrames* frames;
    TubeId id;
  };
  Renderer& renderer_;
  std::vector<Held> tubes_;
  TubeResolution resolution_;
};

}  // namespace omentum::render
