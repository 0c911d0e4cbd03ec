// tissue_compare: tensor-mass, co-rotational and spring-mass tissue side by side, in numbers.
#include "organ/organ.h"
#include "organ_tools/fast_blas.h"
#include "organ_tools/tissue_compare/figures.h"
#include "organ_tools/tissue_compare/integrator_trials.h"
#include "organ_tools/tissue_compare/realism_trials.h"
#include "runtime/command_line.h"

#include <cstdio>
#include <functional>

namespace {

using namespace omentum;
using namespace omentum::tissue_compare;

struct CompareCommand {
  std::filesystem::path organ, json;
  physics::Material material{5000, 0.45, 1060};
  int cells = 6;
  IntegratorOptions integrators{{}, 0.14, 0.01};
};

void add_options(runtime::CommandLine& line, CompareCommand& command) {
  line.option("organ", command.organ,
              "organ file: costs, rotation and integrators are its own; without it the beam's")
      .type_name("ORGAN.h5");
  line.option("--young", command.material.young_pa, "of the beam, Pa")
      .between(1.0, 1e12)
      .type_name("PA")
      .show_default();
  line.option("--poisson", command.material.poisson, "of the beam")
      .between(0.0, 0.499)
      .type_name("RATIO")
      .show_default();
  line.option("--density", command.material.density_kg_m3, "of the beam, kg/m^3")
      .between(1.0, 1e5)
      .type_name("KG/M3")
      .show_default();
  line.option("--cells", command.cells, "cubes of five tetrahedra across the beam, an even number")
      .between(2, 20)
      .type_name("COUNT")
      .show_default();
  line.option("--damping-ratio", command.integrators.damping_ratio,
              "of critical damping, of the fastest mode; proportional to stiffness")
      .between(0.0, 10.0)
      .type_name("RATIO")
      .show_default();
  line.option("--implicit-step", command.integrators.implicit_step_s, "of the implicit integrator, s")
      .between(1e-6, 1.0)
      .type_name("SECONDS")
      .show_default();
  line.option("--seconds", command.integrators.trial_s, "of computing, for each integrator")
      .between(0.0, 60.0)
      .type_name("SECONDS")
      .show_default();
  line.option("--json", command.json, "writes all numbers as a list of name, value, unit")
      .type_name("FILE")
      .writes_file();
}

// Rows of a table, a cell for each law, and the same numbers for programs.
class Properties {
 public:
  void add(const std::string& what, const std::string& name, const std::string& unit,
           const std::function<double(Law)>& value) {
    Row row{what, {}};
    for (const Law law : kLaws) {
      figures.push_back({name + "/" + name_of(law), value(law), unit});
      row.cells.push_back(number_text(figures.back().value, unit == "1" ? "" : unit));
    }
    rows.push_back(row);
  }

  std::vector<Row> rows;
  std::vector<Figure> figures;
};

void compare_costs(const Tissue& tissue, Properties& properties) {
  const double edges = edge_count(tissue);
  std::array<double, kLaws.size()> seconds;
  for (const Law law : kLaws) seconds[static_cast<std::size_t>(law)] = force_seconds(law, tissue);
  const auto of = [&seconds](Law law) { return seconds[static_cast<std::size_t>(law)]; };
  properties.add("forces of one step", "cost/step", "us", [&of](Law law) { return 1e6 * of(law); });
  properties.add("forces per edge", "cost/edge", "ns",
                 [&of, edges](Law law) { return 1e9 * of(law) / edges; });
}

void compare_realism(const Beam& beam, Properties& properties) {
  std::array<ContinuumErrors, kLaws.size()> errors;
  for (const Law law : kLaws) errors[static_cast<std::size_t>(law)] = errors_against_continuum(law, beam);
  const auto add = [&](const std::string& mode, double ContinuumErrors::*of_mode) {
    properties.add("beam: error in " + mode, "error/" + mode, "%", [&errors, of_mode](Law law) {
      return 100 * (errors[static_cast<std::size_t>(law)].*of_mode);
    });
  };
  add("compression", &ContinuumErrors::compression);
  add("shear", &ContinuumErrors::shear);
  add("bending", &ContinuumErrors::bending);
  properties.add("beam: change of force by a cut", "cut/force_change", "%",
                 [&beam](Law law) { return 100 * (force_left_by_cut(law, beam) - 1); });
}

std::vector<Figure> compare_laws(const Beam& beam, const Tissue& tissue, const std::string& name) {
  Properties properties;
  compare_costs(tissue, properties);
  compare_realism(beam, properties);
  properties.add("force of a quarter turn, of that of 10 % compression", "rotation/force", "%",
                 [&tissue](Law law) { return 100 * force_of_quarter_turn(law, tissue); });
  std::vector<std::string> columns;
  for (const Law law : kLaws) columns.emplace_back(name_of(law));
  std::fputs(table("Models of " + name + " (Cotin 1998, Table 1):", columns, properties.rows).c_str(),
             stdout);
  return properties.figures;
}

Row row_of(Law law, const IntegratorTrial& trial, double forward_euler_s) {
  Row row{std::string(name_of(law)) + ", " + trial.scheme, {}};
  if (!(trial.step_s > 0)) return {row.what, {"none is stable", "", "", ""}};
  row.cells = {number_text(1e3 * trial.step_s, "ms"),
               forward_euler_s > 0 ? number_text(trial.step_s / forward_euler_s) : "",
               number_text(1e6 * trial.seconds, "us"),
               trial.diverged ? "diverged" : number_text(trial.real_time_factor())};
  return row;
}

void compare_steps(const Tissue& tissue, const IntegratorOptions& options, const std::string& name,
                   std::vector<Figure>& figures) {
  std::vector<Row> rows;
  for (const Law law : kLaws) {
    const std::vector<IntegratorTrial> trials = compare_integrators(law, tissue, options);
    for (const IntegratorTrial& trial : trials) {
      rows.push_back(row_of(law, trial, trials.front().step_s));
      const std::string of = std::string("/") + trial.scheme + "/" + name_of(law);
      figures.push_back({"step" + of, trial.step_s, "s"});
      figures.push_back({"step_cost" + of, 1e6 * trial.seconds, "us"});
      figures.push_back({"real_time_factor" + of, trial.diverged ? 0 : trial.real_time_factor(), "1"});
    }
  }
  std::string title = "\nIntegrators of " + name;
  title += ", " + number_text(options.damping_ratio) + " of critical damping at its fastest mode";
  title += " (Cotin 1998, section 5.4):";
  std::fputs(table(title, {"step", "forward Euler's", "computed in", "real-time factor"}, rows).c_str(),
             stdout);
}

void compare(CompareCommand command) {
  if (command.cells % 2 != 0)
    throw geometry::InputError("--cells " + std::to_string(command.cells) + ": expected an even number");
  Tissue tissue;
  std::string name = "a beam";
  if (!command.organ.empty()) {
    organ::Organ organ = organ::load_organ(command.organ, organ::Load::kMeshOnly);
    name = organ.name;
    tissue = {std::move(organ.mesh), organ.material};
    command.integrators.fixed = std::move(organ.fixed);
    command.material = organ.material.common;
  }
  const Beam beam(command.cells, command.material);
  if (command.organ.empty()) {
    tissue = beam.tissue;
    command.integrators.fixed = beam.on_bed();
  }
  std::printf("%s: %zu nodes, %zu tetrahedra, %d edges\n", name.c_str(), tissue.mesh.positions.size(),
              tissue.mesh.tetrahedra.size(), edge_count(tissue));
  std::vector<Figure> figures = compare_laws(beam, tissue, name);
  compare_steps(tissue, command.integrators, name, figures);
  if (!command.json.empty()) write_figures(command.json, figures);
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);
  organ_tools::require_blas_memory("tissue_compare", 1);
  runtime::CommandLine line(
      "tissue_compare",
      "Compares tensor-mass, co-rotational and spring-mass tissue: cost, truth to the continuum, "
      "behaviour under cuts and rotations, and integrators in time.");
  CompareCommand command;
  add_options(line, command);
  return line.run(argc, argv, [&] { compare(command); });
}
