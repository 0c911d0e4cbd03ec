#include "render_node/tube_compare/half_picture.h"

#include "render_node/camera.h"
#include "render_node/lighting.h"
#include "render_node/tube_compare/tube_trial.h"

#include <algorithm>
#include <ctime>

namespace omentum::render::trial {
namespace {

constexpr std::size_t kShown = 28;  // masses, from the first one on: three folds

}  // namespace

double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

Frame seen_from_above(std::span<const geometry::Vec3> axis) {
  Ball ball = ball_around(axis.first(std::min(kShown, axis.size())));
  ball.radius += kRadius_m;
  const Camera camera = start_camera({}, ball, geometry::Vec3(0, -0.35, 1), kHalf.aspect());
  Frame frame;
  frame.view = view_of(camera, ball, kHalf.aspect(), 0);
  frame.lighting = light_scene(camera, ball);
  frame.with_panel = false;
  return frame;
}

Picture draw(Renderer& renderer, const Frame& frame) {
  renderer.draw(frame);
  return renderer.read_back();
}

Picture side_by_side(const Picture& left, const Picture& right) {
  Picture both{{left.size.width + right.size.width, left.size.height}, {}};
  const auto width = static_cast<std::size_t>(4 * left.size.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(left.size.height); ++row)
    for (const Picture* half : {&left, &right})
      both.rgba.insert(both.rgba.end(), half->rgba.begin() + static_cast<std::ptrdiff_t>(row * width),
                       half->rgba.begin() + static_cast<std::ptrdiff_t>((row + 1) * width));
  return both;
}

}  // namespace omentum::render::trial
