// What a frame costs a processor that draws it, at 1280 x 720: processor time of all threads to the end of
// glFinish(), so that other programs change little. Software OpenGL stands for a bad graphics card; where
// there is a better one, only its driver's work is seen. A ball of 2,048 triangles and two instruments.
//   frame/QUALITY      the whole frame: a new state, scene, panel; against frame/coarse
//   part/state         normals, shade and upload of a new state
//   part/large_state   the same of 16,386 nodes on the surface
//   part/real_liver    the same of a real liver of 26,000 nodes, 9,400 on its surface, where the data is
//   there part/no_panel      a faint frame of the same state without the panel part/empty         and without
//   anything in it: backdrop and stretching part/panel         that and the panel, laid out and blended as it
//   was kept (panel_refresh.h) part/new_panel     and drawn anew part/read_back     for a picture
//   settle/LOAD/FROM   until the frame rate's control keeps the rate, in simulated time: loads per piece of
//                      a tube, vertex or pixel (load_models.h), from the coarsest or finest level
// --pictures DIR: draws one moment at each quality into DIR instead (Raghupathi 2004, fig. 12).
// LP_NUM_THREADS: threads of Mesa's software rasterizer (0, as render_node has it, where it is not set).
#include "benchmarks/json_reporter.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/panel.h"
#include "render_node/picture_quality.h"
#include "render_node/png_file.h"
#include "render_node/scene_view.h"
#include "tests/render_node/ball_organ.h"
#include "tests/render_node/load_models.h"
#include "tests/support/real_mesh.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <time.h>

namespace {

using namespace omentum::render;

constexpr Size kSize{1280, 720};
constexpr double kRadius_m = 0.08;  // a liver's
const Vec3 kPressed = kRadius_m * Vec3(0, -0.8, 0.6), kTouched = kRadius_m * Vec3(0.64, -0.6, 0.48);

OrganShape ball(int splits) {
  return test::ball_organ(kRadius_m, splits);
}

// None, said on stdout, where the data is absent.
std::optional<OrganShape> real_liver() {
  constexpr double kMillimetre = 1e-3;
  const auto mesh = omentum::test::real_mesh("tet/openhelp_liver_132k.msh", kMillimetre);
  if (!mesh) return std::nullopt;
  OrganShape shape;
  shape.surface = omentum::geometry::extract_surface(*mesh, {});
  shape.rest = omentum::geometry::surface_positions(*mesh, shape.surface);
  std::printf("real_liver: %zu nodes, %zu on the surface\n", mesh->positions.size(), shape.rest.size());
  return shape;
}

PanelView panel_of_a_session() {
  PanelView panel;
  panel.scene = "liver";
  for (const char* node : {"haptic", "deform", "render", "device"})
    panel.nodes.push_back({node, false, 1000, 60, 0, false});
  panel.tools.resize(2);
  for (ToolRow& tool : panel.tools) {
    tool.name = "grasper";
    tool.present = true;
    tool.largest_n = 2;
    for (int k = 0; k < 200; ++k)
      tool.curve.push_back({0.02 * k, 1 + 0.005f * static_cast<float>(k % 50), false});
  }
  panel.time_s = 4;
  panel.hand_to_force_us = panel.hand_to_picture_us = 1000;
  return panel;
}

class Stage {
 public:
  explicit Stage(OrganShape shape, const Vec3& pressed = kPressed)
      : shape_(std::move(shape)),
        renderer_(gl::open_offscreen(kSize)),
        view_(scene_, std::vector{shape_}, *renderer_),
        panel_(panel_of_a_session()) {
    choices_.orbit = view_.first_camera();
    for (const double depth_m : {0.004, 0.008}) states_.push_back(test::dent(shape_, pressed, depth_m, 0.02));
    tools_ = {test::tool_at(kPressed, {0, -1, 1}), test::tool_at(kTouched, {1, 0, 0})};
  }

  struct Parts {
    Quality quality = Quality::kFine;
    bool scene = true, panel = true, new_panel = false;
  };
  void draw(const Parts& parts) {
    renderer_->begin_frame();
    if (parts.new_panel) panel_.time_s += 0.1;
    if (parts.panel) lay_out_panel(panel_);
    Frame frame = view_.frame(choices_, tools_, panel_share(kSize));
    frame.quality = parts.quality;
    if (!parts.scene) frame.items.clear();
    renderer_->draw(frame);
    renderer_->end_frame();
  }
  void show_next_state() { view_.deform(0, states_[++count_ % 2]); }
  Picture read_back() { return renderer_->read_back(); }

 private:
  OrganShape shape_;
  omentum::scene::Scene scene_ = test::scene_with({"probe", "grasper"});
  std::unique_ptr<Renderer> renderer_;
  SceneView view_;
  PanelView panel_;
  ViewChoices choices_;
  std::vector<std::vector<float>> states_;
  std::vector<ToolNow> tools_;
  std::size_t count_ = 0;
};

double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void measure(benchmark::State& state, const std::function<void()>& work) {
  work();  // the first one makes buffers and programs
  for (auto _ : state) {
    const double begin_s = processor_s();
    work();
    state.SetIterationTime(processor_s() - begin_s);
  }
}

// The same moment at every quality, as Raghupathi 2004 shows two in fig. 12.
void write_pictures(Stage& stage, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t q = 0; q < kQualityCount; ++q) {
    stage.draw({static_cast<Quality>(q)});
    const auto file = folder / (std::string(means_of(static_cast<Quality>(q)).word) + ".png");
    write_png(stage.read_back(), file);
    std::printf("%s\n", file.c_str());
  }
}

void measure_settling(omentum::bench::Results& results) {
  constexpr double kAsked_fps = 30, kReached = 0.95, kRun_s = 6, kLimit_s = 1;
  const std::array<std::pair<const char*, test::LoadModel>, 3> loads{
      {{"pieces", {.fixed_s = 0.002, .per_piece_s = 9e-5, .per_million_pixels_s = 2e-4}},
       {"vertices", {.fixed_s = 0.002, .per_thousand_vertices_s = 8e-4}},
       {"pixels", {.fixed_s = 0.004, .per_million_pixels_s = 0.08}}}};
  for (const auto& [name, load] : loads) {
    for (const bool from_finest : {false, true}) {
      test::RateSession session(kAsked_fps, kDrawingDuty);
      if (from_finest) session.run({.fixed_s = 1e-4}, kRun_s);
      const double begin_s = session.now_s();
      session.run(load, kRun_s);
      const double settled_s = session.settled_s(begin_s, kAsked_fps, kReached);
      std::printf("settle/%s/from_%s: %.2f s, then %s\n", name, from_finest ? "finest" : "coarsest",
                  settled_s, words(session.control().level()).c_str());
      results.add({.name = std::string("settle/") + name + (from_finest ? "/from_finest" : "/from_coarsest"),
                   .value = settled_s,
                   .unit = "s",
                   .limit = kLimit_s});
    }
  }
}

std::optional<std::filesystem::path> pictures_asked(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--pictures") return argv[i + 1];
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  omentum::bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  setenv("LP_NUM_THREADS", "0", 0);
  try {
    std::optional<Stage> stage(ball(4));
    if (const auto folder = pictures_asked(argc, argv)) {
      write_pictures(*stage, *folder);
      return 0;
    }
    measure_settling(results);
    const auto add = [&](const std::string& name, std::function<void()> work) {
      benchmark::RegisterBenchmark(name.c_str(), [work](benchmark::State& state) { measure(state, work); })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    };
    for (std::size_t q = 0; q < kQualityCount; ++q) {
      const auto quality = static_cast<Quality>(q);
      add(std::string("frame/") + means_of(quality).word, [&stage, quality] {
        stage->show_next_state();
        stage->draw({quality});
      });
    }
    add("part/state", [&] { stage->show_next_state(); });
    add("part/no_panel", [&] { stage->draw({Quality::kFaint, true, false}); });
    add("part/empty", [&] { stage->draw({Quality::kFaint, false, false}); });
    add("part/panel", [&] { stage->draw({Quality::kFaint, false}); });
    add("part/new_panel", [&] { stage->draw({Quality::kFaint, false, true, true}); });
    add("part/read_back", [&] { stage->read_back(); });
    // last ones: they take the others' place
    const auto add_state = [&](const std::string& name, const OrganShape& shape) {
      add(name, [&stage, shape, is_here = false]() mutable {
        if (!std::exchange(is_here, true)) stage.emplace(shape, shape.rest.front());
        stage->show_next_state();
      });
    };
    add_state("part/large_state", ball(6));
    if (const auto liver = real_liver()) add_state("part/real_liver", *liver);
    omentum::bench::JsonReporter reporter(results);
    benchmark::RunSpecifiedBenchmarks(&reporter);
  } catch (const gl::DisplayError& error) {
    std::fprintf(stderr, "picture_bench: %s\n", error.what());
    return 1;
  }
  for (const omentum::bench::Entry& entry : std::vector(results.entries()))
    if (entry.unit == "ms") results.compare(entry.name, "frame/coarse");
  results.write();
}
