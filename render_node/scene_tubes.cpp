#include "render_node/scene_tubes.h"

#include "render_node/tube_cylinder.h"

namespace omentum::render {

std::size_t SceneTubes::add(TubeFrames& frames) {
  frames.set_eps(resolution_.eps);
  tubes_.push_back({&frames, renderer_.add_tube()});
  send(tubes_.size() - 1);
  return tubes_.size() - 1;
}

void SceneTubes::send(std::size_t tube) {
  renderer_.update_tube(tubes_[tube].id, tubes_[tube].frames->frames());
}

void SceneTubes::set_resolution(const TubeResolution& resolution) {
  const bool cut_anew = clamped(resolution).eps != resolution_.eps;
  resolution_ = clamped(resolution);
  for (std::size_t t = 0; cut_anew && t < tubes_.size(); ++t) {
    tubes_[t].frames->set_eps(resolution_.eps);
    send(t);
  }
}

TubeCost SceneTubes::cost() const {
  TubeCost sum;
  for (const Held& tube : tubes_) {
    const TubeCost cost = tube_cost(tube.frames->frames().size(), resolution_.n);
    sum.segments += cost.segments;
    sum.vertices += cost.vertices;
  }
  return sum;
}

TubeItem SceneTubes::item(std::size_t tube, bool is_map, bool by_turn, const Material& material) const {
  return {tubes_[tube].id, is_map || by_turn ? Look::kMap : Look::kGut,
          resolution_,     tubes_[tube].frames->radius_m(),
          material,        by_turn};
}

}  // namespace omentum::render
