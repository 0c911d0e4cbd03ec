#include "scene/camera_keys.h"

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

constexpr Range kFieldOfView{.minimum = 1, .maximum = 170};

}  // namespace

CameraSpec read_camera(TomlSection s, bool given) {
  CameraSpec camera;
  s.read_word("mode", camera.mode, kOptional, {"orbit", "endoscope"});
  s.read("eye", camera.eye, given ? kRequired : kOptional);
  s.read("target", camera.target, given ? kRequired : kOptional);
  s.read_direction("up", camera.up, kOptional);
  s.read("field_of_view_deg", camera.field_of_view_deg, kOptional, kFieldOfView);
  s.refuse_unknown_keys();
  return camera;
}

}  // namespace omentum::scene
