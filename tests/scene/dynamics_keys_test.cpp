#include "scene/scene.h"
#include "scene/scene_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace omentum::scene {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene whose organ has these lines beside its name; the first of them is the file's fourth.
std::filesystem::path with(const std::string& lines) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file = std::filesystem::path(::testing::TempDir()) / (std::string(info->name()) + ".toml");
  std::ofstream(file) << "name = \"test\"\n[[organs]]\nname = \"plate\"\n"
                      << lines << R"(
mesh = "phantom:plate"
young_pa = 12000
poisson = 0.4
density_kg_m3 = 1000
fixed = "plane:x<0.01"
[[tools]]
id = 0
name = "probe"
shape = "probe"
points = [[0, 0, 0]]
)";
  return file;
}

std::string message_of(const std::filesystem::path& file) {
  try {
    load_scene(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(DynamicsKeys, OneInEquilibriumIsCutButNeitherSwingsNorTears) {
  const OrganSpec organ =
      load_scene(with("model = \"quasi-static-cut\"\ncut_delay_s = 0.1\ncut_rate_per_s = 50\n"
                      "smallest_piece_m3 = 1e-6\ngravity_m_s2 = [0, 0, -1]"))
          .organs[0];
  ASSERT_TRUE(organ.dynamics.has_value());
  EXPECT_EQ(organ.dynamics->cut_delay_s, 0.1);
  EXPECT_EQ(organ.dynamics->cut_rate_per_s, 50);
  EXPECT_EQ(organ.dynamics->smallest_piece_m3, 1e-6);
  EXPECT_EQ(organ.dynamics->gravity_m_s2, Vec3(0, 0, -1));
  for (const std::string key : {"integrator = \"implicit\"", "step_s = 0.01", "mass_damping_per_s = 1",
                                "stiffness_damping_s = 1", "tear_edge_elongation = 1"})
    EXPECT_THAT(message_of(with("model = \"quasi-static-cut\"\n" + key)),
                HasSubstr(":5: organs[0]." + key.substr(0, key.find(' ')) + ": "));
}

TEST(DynamicsKeys, OneInEquilibriumSaysWhatBecomesOfItsPieces) {
  const std::string cut = "model = \"quasi-static-cut\"\n", fall = cut + "pieces = \"fall\"\n";
  EXPECT_EQ(load_scene(with(cut)).organs[0].dynamics->pieces, "drop");
  const Scene scene = load_scene(with(fall + "piece_gravity_m_s2 = [0, 0, -2]"));
  EXPECT_EQ(scene.organs[0].dynamics->pieces, "fall");
  EXPECT_EQ(scene.organs[0].dynamics->piece_gravity_m_s2, Vec3(0, 0, -2));
  EXPECT_THAT(scene_values(scene), Contains("organs[0].pieces = fall"));
  EXPECT_EQ(load_scene(with(fall)).organs[0].dynamics->piece_gravity_m_s2, Vec3(0, 0, -9.81));
  EXPECT_THAT(message_of(with(cut + "pieces = \"fly\"")), HasSubstr("one of \"drop\", \"fall\""));
  EXPECT_THAT(message_of(with(cut + "piece_gravity_m_s2 = [0, 0, -2]")), HasSubstr("unknown key"));
  EXPECT_THAT(message_of(with("model = \"tensor-mass\"\npieces = \"fall\"")), HasSubstr("unknown key"));
}

TEST(DynamicsKeys, AHybridThatIsCutAnywhereSwingsAndSaysWhatBecomesOfItsPieces) {
  const std::string hybrid = "dynamic = \"plane:x>0\"\nmodel = \"hybrid",
                    cut = hybrid + "-cut\"\nlaw = \"corotational\"\nmass_damping_per_s = 3\n";
  const OrganSpec organ = load_scene(with(cut)).organs[0];
  EXPECT_EQ(organ.dynamics->law, "corotational");
  EXPECT_EQ(organ.dynamics->mass_damping_per_s, 3);
  EXPECT_EQ(organ.dynamics->dynamic_part, "plane:x>0");
  EXPECT_EQ(organ.dynamics->pieces, "fall") << "as what has masses always did";
  EXPECT_EQ(load_scene(with(cut + "pieces = \"drop\"")).organs[0].dynamics->pieces, "drop");
  EXPECT_THAT(message_of(with(cut + "piece_gravity_m_s2 = [0, 0, -2]")), HasSubstr("unknown key"));
  EXPECT_THAT(message_of(with(cut + "integrator = \"rk4\"")), HasSubstr("\"implicit\""));
  EXPECT_THAT(message_of(with(hybrid + "\"\npieces = \"drop\"")), HasSubstr("unknown key"));
}

TEST(DynamicsKeys, ADynamicModelHasThemAndAPrecomputedOneDoesNot) {
  const auto file = with(
      "model = \"tensor-mass\"\nintegrator = \"rk4\"\nstep_s = 0.001\ngravity_m_s2 = [0, 0, -9.81]\n"
      "tear_stress_pa = 500\ncut_delay_s = 0");
  const OrganSpec organ = load_scene(file).organs[0];
  ASSERT_TRUE(organ.dynamics.has_value());
  EXPECT_EQ(organ.dynamics->integrator, "rk4");
  EXPECT_EQ(organ.dynamics->step_s, 0.001);
  EXPECT_EQ(organ.dynamics->gravity_m_s2, Vec3(0, 0, -9.81));
  EXPECT_EQ(organ.dynamics->tears.stress_pa, 500);
  EXPECT_FALSE(organ.dynamics->tears.volume_change.has_value());
  EXPECT_EQ(organ.dynamics->cut_delay_s, 0);
  EXPECT_EQ(organ.dynamics->where, file.string() + ":6") << "where its step is";
  EXPECT_FALSE(load_scene(with("")).organs[0].dynamics.has_value());
  EXPECT_THAT(message_of(with("gravity_m_s2 = [0, 0, -9.81]")),
              AllOf(HasSubstr(":4: organs[0].gravity_m_s2: "), HasSubstr("unknown key")));
}

TEST(DynamicsKeys, WhatCannotBeIsRefusedWithItsLine) {
  const struct {
    const char *line, *expected;
  } wrong[] = {{"integrator = \"verlet\"", "\"implicit\""},
               {"step_s = 0.5", "0.02"},
               {"step_s = 0", "1e-06"},
               {"mass_damping_per_s = -1", "0"},
               {"stiffness_damping_s = -0.1", "0"},
               {"gravity_m_s2 = -9.81", "three numbers"},
               {"tear_volume_change = 0", "0.001"},
               {"tear_mean_elongation = -0.2", "0.001"},
               {"tear_edge_elongation = 0.0", "0.001"},
               {"tear_stress_pa = 0", "1"},
               {"cut_delay_s = -1", "0"},
               {"cut_rate_per_s = 0", "above 0"},
               {"smallest_piece_m3 = -1e-9", "0"}};
  for (const auto& [line, expected] : wrong) {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    EXPECT_THAT(message_of(with("model = \"tensor-mass\"\n" + std::string(line))),
                AllOf(HasSubstr(":5: organs[0]." + key + ": found "), HasSubstr(expected)));
  }
}

TEST(DynamicsKeys, SpringsAreMovedOnExplicitlyAlone) {
  EXPECT_EQ(load_scene(with("model = \"spring-mass\"")).organs[0].dynamics->integrator, "symplectic");
  EXPECT_THAT(message_of(with("model = \"spring-mass\"\nintegrator = \"implicit\"")),
              HasSubstr(":5: organs[0].integrator: found "));
}

TEST(DynamicsKeys, ARegionOfADynamicOrganTearsByItself) {
  const auto scene_of = [](const std::string& model) {
    const auto file = with("model = \"" + model + "\"");
    std::ofstream(file, std::ios::app) << "[[organs]]\nname = \"other\"\nmodel = \"" << model << R"("
mesh = "phantom:plate"
young_pa = 12000
poisson = 0.4
density_kg_m3 = 1000
fixed = "plane:x<0.01"
[[organs.regions]]
ball = [0, 0, 0, 0.01]
young_pa = 500
tear_stress_pa = 50
)";
    return file;
  };
  EXPECT_EQ(load_scene(scene_of("tensor-mass")).organs[1].regions[0].tears.stress_pa, 50);
  EXPECT_THAT(message_of(scene_of("quasi-static")), HasSubstr("organs[1].regions[0].tear_stress_pa"));
}

TEST(DynamicsKeys, AHybridOrganSaysWhichPartMovesAndStepsImplicitly) {
  const std::string hybrid = "model = \"hybrid\"\n", part = "dynamic = \"plane:x>0.02\"\n";
  EXPECT_EQ(load_scene(with(hybrid + part)).organs[0].dynamics->dynamic_part, "plane:x>0.02");
  EXPECT_THAT(message_of(with(hybrid)), HasSubstr("dynamic: found nothing"));
  EXPECT_THAT(message_of(with("model = \"tensor-mass\"\n" + part)), HasSubstr("dynamic"));
  EXPECT_THAT(message_of(with(hybrid + part + "integrator = \"rk4\"")), HasSubstr("one of \"implicit\""));
}

TEST(DynamicsKeys, AHybridOrgansDynamicPartMayBeAnotherMesh) {
  const std::string hybrid = "model = \"hybrid\"\n", second = "dynamic_mesh = \"coarse.msh\"\n";
  const std::string mesh = load_scene(with(hybrid + second)).organs[0].dynamics->dynamic_mesh;
  EXPECT_THAT(mesh, testing::EndsWith("coarse.msh"));
  EXPECT_TRUE(std::filesystem::path(mesh).is_absolute()) << "beside the scene";
  const std::string phantom = "dynamic_mesh = \"phantom:cylinder-lower\"\n";
  EXPECT_EQ(load_scene(with(hybrid + phantom)).organs[0].dynamics->dynamic_mesh, "phantom:cylinder-lower");
  EXPECT_THAT(message_of(with(hybrid + "dynamic_mesh = \"phantom:spleen\"\n")),
              HasSubstr("phantom:cylinder-lower"));
  EXPECT_THAT(message_of(with(hybrid + second + "dynamic = \"plane:x>0.02\"\n")),
              HasSubstr("one of the two"));
  EXPECT_THAT(message_of(with("model = \"tensor-mass\"\n" + second)), HasSubstr("dynamic_mesh"));
}

TEST(DynamicsKeys, AHybridOrganSaysByWhichLawItsDynamicPartMoves) {
  const std::string hybrid = "model = \"hybrid\"\ndynamic = \"plane:x>0.02\"\n",
                    turned = "law = \"corotational\"";
  EXPECT_EQ(load_scene(with(hybrid)).organs[0].dynamics->law, "linear");
  const Scene scene = load_scene(with(hybrid + turned));
  EXPECT_EQ(scene.organs[0].dynamics->law, "corotational");
  EXPECT_THAT(scene_values(scene), Contains("organs[0].law = corotational"));
  EXPECT_THAT(message_of(with(hybrid + "law = \"springs\"")),
              HasSubstr("one of \"linear\", \"corotational\""));
  EXPECT_THAT(message_of(with("model = \"tensor-mass\"\n" + turned)), HasSubstr("law"));
}

TEST(DynamicsKeys, MachinesCompareThem) {
  const auto values = scene_values(load_scene(with("model = \"tensor-mass\"\ncut_delay_s = 0.25")));
  EXPECT_THAT(values, Contains("organs[0].cut_delay_s = 0.25"));
  EXPECT_THAT(values, Contains("organs[0].tear_stress_pa = none"));
  EXPECT_THAT(scene_values(load_scene(with(""))), Not(Contains(HasSubstr("cut_delay_s"))));
}

}  // namespace
}  // namespace omentum::scene
