// intestine_soak: whether an intestine ever passes through itself, over minutes and over a billion pairs.
#include "geometry/gut_anatomy.h"
#include "organ_tools/intestine_soak/soak_run.h"
#include "organ_tools/tissue_compare/figures.h"
#include "runtime/command_line.h"

#include <cstdio>
#include <functional>

#include <time.h>

namespace {

using namespace omentum;
using namespace omentum::intestine_soak;

struct SoakCommand {
  double minutes = 10, pair_steps = 1e9;
  int columns = 100, seed = 1;
  std::filesystem::path json;
};

void add_options(runtime::CommandLine& line, SoakCommand& command) {
  line.option("--minutes", command.minutes, "of the gut's time, pulled by a hand and stirred by a probe")
      .between(0.0, 600.0)
      .type_name("MINUTES")
      .show_default();
  line.option("--pair-steps", command.pair_steps, "pairs of parts to look at in violent motion")
      .between(0.0, 1e12)
      .type_name("COUNT")
      .show_default();
  line.option("--masses", command.columns, "along the gut, four rows of them")
      .between(81, 4000)
      .type_name("COUNT")
      .show_default();
  line.option("--seed", command.seed, "of all that is random")
      .between(0, 1000000)
      .type_name("NUMBER")
      .show_default();
  line.option("--json", command.json, "writes all numbers as a list of name, value, unit")
      .type_name("FILE")
      .writes_file();
}

// A run and how long it took on a core: what other programs take of the machine is not in it.
struct Timed {
  SoakReport report;
  double seconds = 0;
};

double core_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Timed timed(const std::function<SoakReport()>& run) {
  const double begin = core_s();
  Timed result{run()};
  result.seconds = core_s() - begin;
  return result;
}

std::vector<tissue_compare::Figure> figures_of(const std::string& of, const Timed& run) {
  const SoakReport& r = run.report;
  const auto count = [](std::int64_t n) { return static_cast<double>(n); };
  return {{"steps/" + of, count(r.steps), "1"},
          {"pair_steps/" + of, count(r.pairs), "1"},
          {"crossings/" + of, count(r.crossings), "1"},
          {"bound_acted/" + of, count(r.bound_acted), "1"},
          {"left_out/" + of, count(r.left_out), "1"},
          {"early_pairs/" + of, count(r.early_pairs), "1"},
          {"most_pairs/" + of, count(r.most_pairs), "1"},
          {"deepest/" + of, r.deepest_m, "m"},
          {"most_energy/" + of, r.most_j, "J"},
          {"diverged/" + of, r.diverged ? 1.0 : 0.0, "1"},
          {"took/" + of, run.seconds, "s"}};
}

void print(const std::vector<tissue_compare::Figure>& figures) {
  for (const tissue_compare::Figure& figure : figures)
    std::printf("%-24s %14.6g %s\n", figure.name.c_str(), figure.value,
                figure.unit == "1" ? "" : figure.unit.c_str());
}

// Whether everything held.
bool soak(const SoakCommand& command) {
  geometry::GutAnatomy anatomy;
  anatomy.columns = command.columns;
  const geometry::GutShape gut = make_gut(anatomy);
  const auto seed = static_cast<std::uint64_t>(command.seed);
  const Timed calm = timed([&] { return run_long(gut, {.seconds = 60 * command.minutes, .seed = seed}); });
  std::vector<tissue_compare::Figure> figures = figures_of("long", calm);
  figures.push_back({"real_time/long", 60 * command.minutes / std::max(calm.seconds, 1e-9), "1"});
  print(figures);
  std::fflush(stdout);
  const Timed violent = timed([&] { return run_violently(gut, command.pair_steps, seed); });
  const auto of_violent = figures_of("violent", violent);
  print(of_violent);
  figures.insert(figures.end(), of_violent.begin(), of_violent.end());
  if (!command.json.empty()) tissue_compare::write_figures(command.json, figures);
  return calm.report.holds() && violent.report.holds();
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("intestine_soak",
                            "Pulls and stirs an intestine for minutes and shakes it violently, and counts "
                            "exactly what passes through what. Ends with 1 where anything does.");
  SoakCommand command;
  add_options(line, command);
  bool holds = true;
  const int code = line.run(argc, argv, [&] { holds = soak(command); });
  return code == 0 && !holds ? 1 : code;
}
