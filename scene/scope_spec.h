// An endoscope as data.
#pragma once

namespace omentum::scene {

/// The optics of an endoscope and what holds the picture upright. In its tool's frame T the lens is at the
/// tip; the view axis is inclined against the shaft towards -y, so that 30 degree optics look down while the
/// y axis of T is up; the picture's upper edge is on the side of +y. Both roll with the scope.
struct ScopeSpec {
  double optics_deg = 30;         // view axis against the shaft's own direction (-z of T)
  double field_of_view_deg = 62;  // of the picture's height; a laparoscope's round field is 6 % wider
};

}  // namespace omentum::scene
