#include "render_node/tube_compare/levels.h"

#include "render_node/gl/gl_renderer.h"
#include "render_node/organ_look.h"
#include "render_node/png_file.h"
#include "render_node/tube_compare/half_picture.h"
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_frames.h"
#include "render_node/tube_resolution.h"

#include <algorithm>
#include <cstdio>

namespace omentum::render::trial {
namespace {

// Pixels cost the same at both ends; as few as may be, so that the tube's own share is seen. The picture
// itself is drawn finely.
constexpr Quality kTimed = Quality::kDraft;

struct Level {
  TubeResolution resolution;
  Picture picture{};
  double prepare_us = 0, draw_us = 0;  // of a frame
  TubeCost cost{};                     // of the last one
};

void fold(const LevelsCommand& command, Renderer& renderer, Level& level) {
  const auto masses = static_cast<std::size_t>(command.masses);
  TubeFrames tube(folding_axis(masses, 0), kRadius_m);
  tube.set_eps(level.resolution.eps);
  const TubeId id = renderer.add_tube();
  for (int f = 0; f < command.frames; ++f) {
    const double share = command.frames > 1 ? static_cast<double>(f) / (command.frames - 1) : 1;
    const std::vector<geometry::Vec3> axis = folding_axis(masses, command.folded * share);
    Frame frame = seen_from_above(axis);
    frame.quality = kTimed;
    frame.tubes.push_back({id, Look::kGut, level.resolution, tube.radius_m(), tissue_material("gut"), false});
    const double begin_us = cpu_us();
    tube.deform(axis);
    const double prepared_us = cpu_us();
    renderer.update_tube(id, tube.frames());
    draw(renderer, frame);
    if (f > 0) level.draw_us += cpu_us() - prepared_us;  // the first one compiles shaders
    level.prepare_us += prepared_us - begin_us;
    frame.quality = Quality::kFine;
    if (f + 1 == command.frames) level.picture = draw(renderer, frame);
  }
  level.prepare_us /= command.frames;
  level.draw_us /= std::max(1, command.frames - 1);
  level.cost = tube_cost(tube.frames().size(), level.resolution.n);
}

void print(const Level& level) {
  const double frame_us = level.prepare_us + level.draw_us;
  std::printf("%8g %3d %10zu %14.0f %11.1f %12.0f\n", level.resolution.eps, level.resolution.n,
              level.cost.vertices, level.prepare_us, 1e-3 * level.draw_us, 1e6 / frame_us);
}

}  // namespace

void show_levels(const LevelsCommand& command) {
  const auto renderer = gl::open_offscreen(kHalf);
  Level coarse{kTubeLadder.front()}, fine{kTubeLadder.back()};
  std::printf("a tube of %d axis masses that folds in %d frames, at both ends of the control\n",
              command.masses, command.frames);
  std::printf("%8s %3s %10s %14s %11s %12s\n", "eps", "n", "vertices", "to prepare, us", "to draw, ms",
              "frames a s");
  for (Level* level : {&coarse, &fine}) {
    fold(command, *renderer, *level);
    print(*level);
  }
  std::printf(
      "(light at the vertices; the processor's time, which with software OpenGL is all of a frame)\n");
  write_png(side_by_side(coarse.picture, fine.picture), command.picture);
}

}  // namespace omentum::render::trial
