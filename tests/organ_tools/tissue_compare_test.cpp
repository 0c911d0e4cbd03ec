// What models of tissue are compared by, and the program that prints it.
#include "organ_tools/tissue_compare/equilibrium.h"
#include "organ_tools/tissue_compare/integrator_trials.h"
#include "organ_tools/tissue_compare/realism_trials.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include <map>

namespace omentum::tissue_compare {
namespace {

using testing::HasSubstr;

const physics::Material kTissue{5000, 0.4, 1000};

TEST(BeamTest, FillsItsVolumeAndMirrorsItself) {
  const Beam beam(4, kTissue);
  double volume = 0;
  for (std::size_t t = 0; t < beam.tissue.mesh.tetrahedra.size(); ++t) {
    const auto& nodes = beam.tissue.mesh.tetrahedra[t];
    const auto& p = beam.tissue.mesh.positions;
    volume += geometry::signed_volume(p[nodes[0]], p[nodes[1]], p[nodes[2]], p[nodes[3]]);
  }
  EXPECT_NEAR(volume, beam.volume(), 1e-9 * beam.volume());
  EXPECT_EQ(beam.tissue.mesh.tetrahedra.size(), 5u * 4 * 4 * 12);
  EXPECT_EQ(beam.slot().size(), 5u * 2 * 4);
}

TEST(EquilibriumTest, LeavesNoForceWhereNothingIsHeld) {
  const Beam beam(2, kTissue);
  const std::size_t size = 3 * beam.tissue.mesh.positions.size();
  std::vector<std::uint8_t> held(size, 0);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size)), f = u;
  for (std::size_t n = 0; n < size / 3; ++n) {
    if (!beam.at_end(geometry::NodeId(n))) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) held[3 * n + axis] = 1;
    u[static_cast<Eigen::Index>(3 * n)] = 0.2 * beam.tissue.mesh.positions[n].x();
  }
  const auto law = make_exact_law(Law::kCorotational, beam.tissue);
  relax(*law, held, 1e-4 * beam.cube, u);
  law->forces({u.data(), size}, {f.data(), size});
  double free = 0, holding = 0;
  for (std::size_t i = 0; i < size; ++i) {
    double& sum = held[i] != 0 ? holding : free;
    sum += f[static_cast<Eigen::Index>(i)] * f[static_cast<Eigen::Index>(i)];
  }
  EXPECT_GT(holding, 0);
  EXPECT_LE(free, 1e-12 * holding);
}

TEST(RealismTest, ContinuumLawsAreExactWhereStrainsAreUniform) {
  const Beam beam(2, kTissue);
  for (const Law law : {Law::kTensorMass, Law::kCorotational}) {
    const ContinuumErrors errors = errors_against_continuum(law, beam);
    EXPECT_NEAR(errors.compression, 0, 1e-6) << name_of(law);
    EXPECT_NEAR(errors.shear, 0, 1e-6) << name_of(law);
    EXPECT_GT(errors.bending, 0) << "a coarse mesh is too stiff";
  }
}

TEST(RealismTest, BendingErrorIsTheMeshsAndGoesWithItsSquare) {
  const double coarse = errors_against_continuum(Law::kTensorMass, Beam(2, kTissue)).bending;
  const double fine = errors_against_continuum(Law::kTensorMass, Beam(4, kTissue)).bending;
  EXPECT_NEAR(coarse / fine, 4, 1);
}

TEST(RealismTest, SpringsMissShearAndCompression) {
  const ContinuumErrors errors = errors_against_continuum(Law::kSpringMass, Beam(2, kTissue));
  EXPECT_GT(std::abs(errors.compression), 0.05);
  EXPECT_GT(std::abs(errors.shear), 0.05);
}

TEST(RealismTest, CutTakesForceAway) {
  const Beam beam(2, kTissue);
  for (const Law law : kLaws) {
    const double left = force_left_by_cut(law, beam);
    EXPECT_GT(left, 0.3) << name_of(law);
    EXPECT_LT(left, 0.95) << name_of(law);
  }
}

TEST(RealismTest, OnlyTheLinearLawResistsARotation) {
  const Beam beam(2, kTissue);
  EXPECT_GT(force_of_quarter_turn(Law::kTensorMass, beam.tissue), 1);
  EXPECT_LT(force_of_quarter_turn(Law::kCorotational, beam.tissue), 1e-10);
  EXPECT_LT(force_of_quarter_turn(Law::kSpringMass, beam.tissue), 1e-10);
}

TEST(IntegratorTrialTest, NoneDivergesOnTheBedAtNineTenthsOfItsStep) {
  const Beam beam(2, kTissue);
  for (const Law law : kLaws) {
    for (const IntegratorTrial& trial :
         compare_integrators(law, beam.tissue, {beam.on_bed(), 0.14, 0.01, 0.02})) {
      EXPECT_FALSE(trial.diverged) << name_of(law) << ", " << trial.scheme;
      EXPECT_GT(trial.step_s, 0) << name_of(law) << ", " << trial.scheme;
    }
  }
}

TEST(IntegratorTrialTest, ForwardEulerHasNoStepWithoutDamping) {
  const Beam beam(2, kTissue);
  const auto trials = compare_integrators(Law::kTensorMass, beam.tissue, {beam.on_bed(), 0, 0.01, 0});
  EXPECT_EQ(trials.at(0).scheme, "forward-euler");
  EXPECT_EQ(trials.at(0).step_s, 0);
  EXPECT_GT(trials.at(1).step_s, 0);
}

TEST(TissueCompare, PrintsBothTablesAndWritesTheirNumbers) {
  const test::ScratchFolder folder;
  const std::filesystem::path json = folder / "figures.json";
  test::Process program("tissue_compare", {"--cells", "2", "--seconds", "0.01", "--json", json.string()});
  ASSERT_EQ(program.wait(), 0) << program.messages();
  EXPECT_THAT(program.output(), HasSubstr("Cotin 1998, Table 1"));
  EXPECT_THAT(program.output(), HasSubstr("Cotin 1998, section 5.4"));
  std::map<std::string, double> figures;
  for (const auto& figure : nlohmann::json::parse(test::read_text(json)))
    figures[figure.at("name")] = figure.at("value");
  for (const Law law : kLaws) {
    const std::string of = std::string("/") + name_of(law);
    for (const char* name :
         {"cost/step", "cost/edge", "error/compression", "error/shear", "error/bending", "cut/force_change",
          "rotation/force", "real_time_factor/forward-euler", "real_time_factor/symplectic-euler",
          "real_time_factor/rk4", "real_time_factor/implicit"}) {
      EXPECT_TRUE(figures.contains(name + of)) << name << of;
    }
  }
  EXPECT_GT(figures["rotation/force/tensor-mass"], 100);
  EXPECT_LT(figures["rotation/force/corotational"], 1e-8);
}

TEST(TissueCompare, RefusesInOneLineAndWritesNothing) {
  const test::ScratchFolder folder;
  const std::filesystem::path json = folder / "figures.json";
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--cells", "3"}, {"--poisson", "0.5"}, {(folder / "no.h5").string()}}) {
    std::vector<std::string> arguments = wrong;
    arguments.insert(arguments.end(), {"--json", json.string()});
    test::Process program("tissue_compare", arguments);
    EXPECT_EQ(program.wait(), 2);
    EXPECT_THAT(program.messages(), HasSubstr(wrong.front()));
    EXPECT_EQ(std::ranges::count(program.messages(), '\n'), 1) << program.messages();
    EXPECT_FALSE(std::filesystem::exists(json));
  }
}

}  // namespace
}  // namespace omentum::tissue_compare
