#include "render_node/gl/display.h"

#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"

#include <cstdio>
#include <cstdlib>

namespace omentum::render::gl {
namespace {

// Mesa's software OpenGL would take every core for each frame. Without threads of its own it draws in ours,
// at our priority and within our share of the time (docs/rendering.md); whoever set the variable knows
// better. Drivers of graphics cards ignore it.
void leave_cores_to_others() {
  setenv("LP_NUM_THREADS", "0", 0);
}

}  // namespace

std::unique_ptr<Renderer> open_display(bool headless, Size size, const std::string& title,
                                       const std::filesystem::path& out, float ui_scale) {
  leave_cores_to_others();
  const bool chosen = size != Size{};
  if (!headless) {
    try {
      return open_window(chosen ? size : kWindowSize, title, ui_scale);
    } catch (const DisplayError& error) {
      std::printf("no display (%s): writing pictures to %s instead\n", error.what(), out.c_str());
      std::fflush(stdout);
    }
  }
  return open_offscreen(chosen ? size : kOffscreenSize, ui_scale);
}

}  // namespace omentum::render::gl
