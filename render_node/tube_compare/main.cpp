// tube_compare: a folding tube, swept by brute force and skinned on adaptive frames, side by side.
#include "render_node/gl/display.h"
#include "render_node/tube_compare/comparison.h"
#include "render_node/tube_compare/levels.h"
#include "runtime/command_line.h"

int main(int argc, char** argv) {
  using namespace omentum;
  using namespace omentum::render;
  runtime::CommandLine line("tube_compare",
                            "Folds a tube and draws it twice (Raghupathi 2004, fig. 11): left swept by brute "
                            "force, right skinned between adaptive frames; and prints what either costs.");
  trial::CompareCommand command;
  line.needs(gl::kRoomToDraw);
  line.option("--masses", command.masses, "of the axis").between(3, 10000).show_default();
  line.option("--frames", command.frames, "of the animation").between(1, 100000).show_default();
  line.option("--folded", command.folded, "at its end: 0 straight, 1 folded sharply")
      .between(0.0, 1.0)
      .show_default();
  line.option("--eps", command.resolution.eps, "masses that turn by more get pieces of their own")
      .between(kFinestTubeEps, kCoarsestTubeEps)
      .show_default();
  line.option("--n", command.resolution.n, "2^(n+1) sections of a piece")
      .between(kLeastTubeN, kMostTubeN)
      .show_default();
  line.flag("--folds", command.folds, "right: coloured by how much it is folded (fig. 10)");
  line.option("--picture", command.picture, "both, of the last frame").type_name("FILE.png").writes_file();
  std::filesystem::path levels;
  line.option("--levels", levels,
              "instead: left as coarsely, right as finely as the frame rate's control may draw (fig. 12)")
      .type_name("FILE.png")
      .writes_file();
  return line.run(argc, argv, [&] {
    if (levels.empty()) {
      trial::compare(command);
    } else {
      trial::show_levels({levels, command.masses, command.frames, command.folded});
    }
  });
}
