// intestine_recall: what the searches for contacts find of all that collides in an intestine.
#include "files/png_file.h"
#include "geometry/tetra_mesh.h"
#include "organ_tools/intestine_recall/recall_plot.h"
#include "organ_tools/tissue_compare/figures.h"
#include "runtime/command_line.h"

#include <cstdio>

namespace {

using namespace omentum;
using namespace omentum::intestine_recall;

struct RecallCommand {
  RecallOptions options;
  int columns = 100, seed = 1;
  std::filesystem::path picture, json;
};

void add_options(runtime::CommandLine& line, RecallCommand& command) {
  line.option("--seconds", command.options.seconds, "of the gut's time")
      .between(0.05, 3600.0)
      .type_name("SECONDS")
      .show_default();
  line.option("--seed", command.seed, "of the hand and of the stochastic search")
      .between(0, 1000000)
      .type_name("NUMBER")
      .show_default();
  line.option("--masses", command.columns, "along the gut, four rows of them")
      .between(81, 4000)
      .type_name("COUNT")
      .show_default();
  line.option("-o,--output", command.picture, "draws recall over time").type_name("FILE.png").writes_file();
  line.option("--json", command.json, "writes all numbers as a list of name, value, unit")
      .type_name("FILE")
      .writes_file();
}

double per_cent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 100.0;
}

std::vector<tissue_compare::Figure> figures_of(const RecallReport& report) {
  std::vector<tissue_compare::Figure> figures{{"regions", static_cast<double>(report.regions), "1"},
                                              {"lasting_regions", static_cast<double>(report.lasting), "1"}};
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    const MethodTotals& totals = report.methods[i];
    const std::string method = std::string("/") + kMethods[i];
    figures.push_back({"recall" + method, per_cent(totals.found, report.regions), "%"});
    figures.push_back({"recall_in_time" + method, per_cent(totals.found_in_time, report.lasting), "%"});
    figures.push_back({"tests" + method, per_cent(totals.tests, report.exhaustive_tests), "%"});
  }
  return figures;
}

void print(const RecallReport& report) {
  std::vector<tissue_compare::Row> rows;
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    const MethodTotals& totals = report.methods[i];
    const double steps = static_cast<double>(std::max<std::size_t>(report.samples.size(), 1));
    char recall[3][32];
    std::snprintf(recall[0], sizeof recall[0], "%.3f %%", per_cent(totals.found, report.regions));
    std::snprintf(recall[1], sizeof recall[1], "%.3f %%", per_cent(totals.found_in_time, report.lasting));
    std::snprintf(recall[2], sizeof recall[2], "%.2f %%", per_cent(totals.tests, report.exhaustive_tests));
    rows.push_back({kMethods[i],
                    {recall[0], recall[1],
                     tissue_compare::number_text(static_cast<double>(totals.tests) / steps), recall[2]}});
  }
  char title[200];
  std::snprintf(
      title, sizeof title,
      "Colliding regions found, of %lld in %zu steps, %lld of which lasted beyond %d steps (Raghupathi "
      "2004, fig. 14):",
      static_cast<long long>(report.regions), report.samples.size(), static_cast<long long>(report.lasting),
      kGrace);
  std::fputs(tissue_compare::table(
                 title, {"in every step", "within 3 steps", "tests a step", "of every pair's"}, rows)
                 .c_str(),
             stdout);
}

void measure(RecallCommand& command) {
  command.options.anatomy.columns = command.columns;
  command.options.seed = static_cast<std::uint64_t>(command.seed);
  const RecallReport report = measure_recall(command.options);
  print(report);
  if (!command.picture.empty()) {
    const force_map::Canvas canvas = draw_recall(report, command.options.step_s);
    files::write_png(command.picture, canvas.width(), canvas.height(), canvas.rgba());
  }
  if (!command.json.empty()) tissue_compare::write_figures(command.json, figures_of(report));
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("intestine_recall",
                            "Lets a hand pull an intestine about and compares what the searches for contacts "
                            "find, the stochastic and the complete one, with every pair of its parts.");
  RecallCommand command;
  add_options(line, command);
  return line.run(argc, argv, [&] { measure(command); });
}
