#include "render_node/tube_compare/comparison.h"

#include "render_node/gl/gl_renderer.h"
#include "render_node/organ_look.h"
#include "render_node/png_file.h"
#include "render_node/tube_compare/half_picture.h"
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_cylinder.h"

#include <cmath>
#include <cstdio>

namespace omentum::render::trial {
namespace {

// What either way took and made, over the whole animation.
struct Figures {
  double prepare_us = 0;  // of a frame
  std::size_t vertices = 0, inside_out = 0;
  double smallest_m = INFINITY;  // from a section, or frame, to the next one
};

template <class Sections>
void take_distance(const Sections& sections, Figures& figures) {
  for (std::size_t j = 1; j < sections.size(); ++j)
    figures.smallest_m = std::min(figures.smallest_m,
                                  static_cast<double>((sections[j].origin - sections[j - 1].origin).norm()));
}

struct Comparison {
  BruteSweep brute;
  TubeFrames skinned;
  TubeCylinder cylinder;
  Figures of_brute, of_skinned;

  explicit Comparison(const CompareCommand& command)
      : brute(static_cast<std::size_t>(command.masses),
              std::size_t{2} << static_cast<unsigned>(command.resolution.n)),
        skinned(folding_axis(static_cast<std::size_t>(command.masses), 0), kRadius_m),
        cylinder(make_tube_cylinder(command.resolution.n)) {
    skinned.set_eps(command.resolution.eps);
  }

  void show(const std::vector<geometry::Vec3>& axis, const TubeResolution& resolution) {
    const double begin_us = cpu_us();
    brute.deform(axis);
    const double between_us = cpu_us();
    skinned.deform(axis);
    of_brute.prepare_us += between_us - begin_us;
    of_skinned.prepare_us += cpu_us() - between_us;
    take_distance(brute.sections(), of_brute);
    take_distance(skinned.frames(), of_skinned);
    of_brute.vertices = std::max(of_brute.vertices, brute.mesh().vertices.size());
    of_skinned.vertices =
        std::max(of_skinned.vertices, tube_cost(skinned.frames().size(), resolution.n).vertices);
    of_brute.inside_out = std::max(of_brute.inside_out, turned_inside_out(brute.mesh()));
    of_skinned.inside_out =
        std::max(of_skinned.inside_out,
                 turned_inside_out(skinned_tube(skinned.frames(), skinned.radius_m(), cylinder)));
  }
};

void print(const CompareCommand& command, const Comparison& comparison) {
  std::printf("a tube of %d axis masses that folds in %d frames; eps %g, n %d (%d sections of a piece)\n",
              command.masses, command.frames, command.resolution.eps, command.resolution.n,
              2 << command.resolution.n);
  std::printf("%-12s %14s %10s %26s %22s\n", "", "to prepare, us", "vertices", "nearest sections, radii",
              "triangles inside out");
  const auto row = [&](const char* name, const Figures& f) {
    std::printf("%-12s %14.0f %10zu %26.3f %22zu\n", name, f.prepare_us / command.frames, f.vertices,
                f.smallest_m / kRadius_m, f.inside_out);
  };
  row("brute force", comparison.of_brute);
  row("skinned", comparison.of_skinned);
  std::printf("(time: the mean of a frame, of the processor; the rest: the worst of all frames)\n");
}

void write_picture(const CompareCommand& command, Comparison& comparison,
                   std::span<const geometry::Vec3> axis) {
  const auto renderer = gl::open_offscreen(kHalf);
  const Material gut = tissue_material("gut");
  comparison.brute.shade(comparison.skinned.shade());
  Frame left = seen_from_above(axis), right = left;
  left.items.push_back({renderer->add_mesh(comparison.brute.mesh()), Look::kGut, Mat4f::Identity(), gut});
  const TubeId tube = renderer->add_tube();
  renderer->update_tube(tube, comparison.skinned.frames());
  right.tubes.push_back({tube, command.folds ? Look::kMap : Look::kGut, command.resolution,
                         comparison.skinned.radius_m(), gut, command.folds});
  write_png(side_by_side(draw(*renderer, left), draw(*renderer, right)), command.picture);
}

}  // namespace

void compare(const CompareCommand& command) {
  Comparison comparison(command);
  std::vector<geometry::Vec3> axis;
  for (int f = 0; f < command.frames; ++f) {
    const double share = command.frames > 1 ? static_cast<double>(f) / (command.frames - 1) : 1;
    axis = folding_axis(static_cast<std::size_t>(command.masses), command.folded * share);
    comparison.show(axis, command.resolution);
  }
  print(command, comparison);
  if (!command.picture.empty()) write_picture(command, comparison, axis);
}

}  // namespace omentum::render::trial
