// render_node: shows the session. A window, or pictures where there is no display.
#include "node_common/node_identity.h"
#include "render_node/gl/display.h"
#include "render_node/option_words.h"
#include "render_node/render_loop.h"
#include "runtime/niceness.h"
#include "runtime/rate_loop.h"
#include "runtime/report.h"
#include "runtime/signals.h"

#include <nlohmann/json.hpp>

#include <algorithm>

int main(int argc, char** argv) {
  using namespace omentum;
  runtime::CommandLine line(
      "render_node", "Shows the scene's organs, instruments and forces in a window or as PNG pictures.");
  render::RenderOptions options;
  runtime::add_node_options(line, options.node);
  line.needs(render::gl::kRoomToDraw);
  line.flag("--headless", options.headless, "draw off-screen even where there is a display");
  line.option(
          "--size", [&](const std::string& text) { return render::parse_size(text, options.size); },
          "of the picture, default 1280x800 in a window and 960x600 off-screen")
      .type_name("WxH");
  line.option("--fps", options.fps, "most frames per second").between(1.0, 240.0).show_default();
  line.option("--seconds", options.seconds, "end after so long (0: never)").not_negative();
  line.option("--out", options.out, "folder for pictures (off-screen: the current one)").type_name("DIR");
  line.option("--picture-period-s", options.picture_period_s, "between two pictures (0: none but the last)")
      .not_negative();
  line.option(
          "--map", [&](const std::string& text) { return render::parse_map(text, options.map); },
          "colour organs by strain or stress (key S switches)")
      .type_name("WHICH");
  line.flag("--folds", options.folds, "colour intestines by how sharply they are folded");
  line.flag("--no-panel", options.no_panel, "draw the scene only");
  render::add_window_options(line, options);

  return line.run(argc, argv, [&] {
    if (options.record) options.fps = std::max(options.fps, options.record_fps);
    runtime::RateLoop pace(render::kTicksPerFrame * options.fps);
    runtime::StopSignal signal([&] { pace.stop(); });
    runtime::take_nice(runtime::kPictureNice);  // pictures must never take the force loop's time
    const auto folder = options.out.empty() ? std::filesystem::path(".") : options.out;
    const auto renderer =
        render::gl::open_display(options.headless, options.size, "Omentum", folder, options.ui_scale);
    if (!renderer->has_window()) options.out = folder;
    const auto open_bus = [&] { return node::open_bus(options.node, "render_node"); };
    render::RenderLoop loop(options, open_bus, *renderer, pace);
    loop.run();
    if (!options.node.report.empty()) runtime::write_report(loop.report(), options.node.report);
    loop.require_written();
  });
}
