#include "tests/organ/organ_programs.h"

#include <sys/stat.h>

namespace omentum::organ {
namespace {

TEST_F(OrganProgramsTest, RegionsThatMeanNothingAreRefused) {
  expect_refused("organ_build", with("--region", "ball=1,1,1,0.01; young=5000"),
                 "no tetrahedron has its centre there");
  expect_refused("organ_build", with("--region", "label=4; young=5000"),
                 "--region label=4; young=5000: names no");
  expect_refused("organ_build", with("--region", "ball=0,0,0,0.05; poisson=0.6"), "Poisson's ratio is 0.6");
}

TEST_F(OrganProgramsTest, OrganCheckSaysWhatIsThereAndFindsAByteThatChanged) {
  Process made("organ_build", with("--region", "box=0.06,0,0,0.08,0.06,0.06; young=9000"));
  ASSERT_EQ(made.wait(), 0) << made.messages();
  Process check("organ_check", {organ.string()});
  ASSERT_EQ(check.wait(), 0) << check.messages();
  EXPECT_THAT(check.output(), HasSubstr("box: whole: 80 nodes, "));
  EXPECT_THAT(check.output(),
              HasSubstr("elsewhere: 162 tetrahedra, 216 cm^3: 3000 Pa, Poisson's ratio 0.45, 1050 kg/m^3"));
  EXPECT_THAT(check.output(),
              HasSubstr("region 2: 54 tetrahedra, 72 cm^3: 9000 Pa, Poisson's ratio 0.45, 1050 kg/m^3"));
  std::string content = test::read_text(organ);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
  std::ofstream(organ, std::ios::binary) << content;
  expect_refused("organ_check", {organ.string()}, "its tensors are damaged (checksum");
}

// The labels that a mesh file brings are those of --region; a label alone changes no organ.
TEST_F(OrganProgramsTest, ALabelOfTheMeshFileGetsAMaterial) {
  geometry::TetraMesh labelled = test::make_box_mesh(4, 3, 3, {0.08, 0.06, 0.06});
  labelled.regions.assign(labelled.tetrahedra.size(), 1);
  geometry::write_mesh(labelled, mesh);
  build();
  const Organ plain = load_organ(organ, Load::kMeshOnly);
  labelled.regions.back() = 6;
  geometry::write_mesh(labelled, mesh);
  build();
  EXPECT_EQ(load_organ(organ, Load::kMeshOnly).hash, plain.hash);
  Process program("organ_build", with("--region", "label=6; density=5"));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_THAT(program.messages(), HasSubstr("warning: region 6: the density is 5 kg/m^3"));
  EXPECT_THAT(program.messages(), HasSubstr("warning: region 6: 1 tetrahedron; expected 20 or more"));
  const Organ made = load_organ(organ, Load::kMeshOnly);
  EXPECT_EQ(made.mesh.regions, labelled.regions);
  ASSERT_EQ(made.material.regions.size(), 1u);
  EXPECT_EQ(made.material.regions[0].label, 6);
  EXPECT_EQ(made.material.regions[0].material.young_pa, 3000);
  EXPECT_EQ(made.material.regions[0].material.density_kg_m3, 5);
}

TEST_F(OrganProgramsTest, BuildMakesAnOrganThatLoadsAndSecondBuildFindsItUpToDate) {
  build();
  const Organ built = load_organ(organ, Load::kWithTensors);
  EXPECT_EQ(built.name, "box");
  Process again("organ_build", build_arguments(mesh));
  EXPECT_EQ(again.wait(), 0);
  EXPECT_THAT(again.output(), HasSubstr("up to date"));
  Process changed("organ_build", with("--young", "4000"));
  EXPECT_EQ(changed.wait(), 0);
  EXPECT_THAT(changed.output(), HasSubstr("built"));
  EXPECT_NE(load_organ(organ, Load::kMeshOnly).hash, built.hash);
}

TEST_F(OrganProgramsTest, BuildRefusesBadInput) {
  expect_refused("organ_build", {}, "mesh");
  expect_refused("organ_build", build_arguments(folder / "absent.msh"), "absent.msh");
  expect_refused("organ_build", build_arguments(write("broken.msh", "$MeshFormat\nnonsense\n")),
                 "broken.msh");
  expect_refused("organ_build", with("--young", "-1"), "Young");
  expect_refused("organ_build", with("--young", "much"), "--young");
  expect_refused("organ_build", with("--poisson", "0.5"), "Poisson");
  expect_refused("organ_build", with("--density", "0"), "density");
  expect_refused("organ_build", with("--scale", "0"), "0");
  expect_refused("organ_build", with("--fixed", "plane:x<-5"), "extends over x");
  expect_refused("organ_build", with("--fixed", write("one.csv", "0\n")), "floating");
  expect_refused("organ_build", with("--fixed", "plane:x<0.001:x"), "floating");
  expect_refused("organ_build", with("--fixed", "plane:x<10"), "hold every node");
  expect_refused("organ_build", with("--store", "half"), "half");
  expect_refused("organ_build", with("--law", "law.csv"), "not part of this version");
  expect_refused("organ_build", with("--dynamic", "plane:x>0"), "every tetrahedron");
  expect_refused("organ_build", with("--dynamic", "plane:x>5"), "names no tetrahedron");
  expect_refused("organ_build", with("--dynamic", "label:2"), "names no tetrahedron");
  expect_refused("organ_build", with("--dynamic", write("tets.csv", "0\n-3\n")), "tets.csv:2");
  expect_refused("organ_build", with("-o", (folder / "absent" / "o.h5").string()), "absent");
  const std::string before = test::read_text(mesh);
  expect_refused("organ_build", with("-o", mesh.string()), "is the mesh itself");
  EXPECT_EQ(test::read_text(mesh), before);
}

TEST_F(OrganProgramsTest, TensorsAndDirectSolveAgreeThroughTheFiles) {
  build();
  const std::string imposed = write("imposed.csv", "node,ux,uy,uz\n79,0.001,0,-0.002\n59,0,0.001,0\n");
  for (const char* gravity : {"0,0,0", "0,-9.81,0"}) {
    std::vector<std::vector<double>> u[2], f[2];
    for (const int model : {0, 1}) {
      auto arguments = solve_arguments(imposed);
      arguments.insert(arguments.end(), {"--model", model == 0 ? "tensors" : "direct", "--gravity", gravity});
      Process program("organ_solve", arguments);
      ASSERT_EQ(program.wait(), 0) << program.messages();
      u[model] = numbers("s.u.csv");
      f[model] = numbers("s.f.csv");
    }
    ASSERT_EQ(u[0].size(), 5u * 4 * 4);
    ASSERT_EQ(f[0].size(), 2u);
    EXPECT_EQ(f[0][0][0], 79);
    EXPECT_LE(largest_difference(u[0], u[1]), 2e-5 * largest_entry(u[1]));
    EXPECT_LE(largest_difference(f[0], f[1]), 1e-5 * largest_entry(f[1]));
    EXPECT_NEAR(u[0][79][3], -0.002, 1e-9);
  }
}

TEST_F(OrganProgramsTest, SolveRefusesBadInput) {
  build();
  const auto refused = [&](const std::string& csv, const std::string& named) {
    expect_refused("organ_solve", solve_arguments(write("i.csv", csv)), named);
  };
  refused("79,0,0,0.001\n79,0,0,0.002\n", "i.csv:2: node 79 is listed twice");
  refused("80,0,0,0\n", "0 to 79");
  refused("0,0,0,0.001\n", "node 0 is held by a support");
  refused("79,0,0\n", "expected 4");
  refused("79,0,0,nan\n", "'nan'");
  refused("node,ux,uy,uz\n", "holds no numbers");
  // node (2, 1, 1) lies inside
  refused("27,0,0,0.001\n", "node 27 is inside");
  expect_refused("organ_solve", solve_arguments((folder / "absent.csv").string()), "absent.csv");
  auto arguments = solve_arguments(write("i.csv", "79,0,0,0.001\n"));
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--model", "plastic"},
                                      {"--remove", "tets.csv"},
                                      {"--gravity", "1,2"},
                                      {"-o", (folder / "absent" / "s").string()}}) {
    auto extended = arguments;
    if (option == "-o") extended.resize(5);
    extended.insert(extended.end(), {option, value});
    expect_refused("organ_solve", extended, option == "-o" ? "absent" : option + " " + value);
  }
  arguments[0] = write("garbage.h5", "garbage");
  expect_refused("organ_solve", arguments, "garbage.h5");
}

TEST_F(OrganProgramsTest, InnerNodeIsSolvedDirectly) {
  build();
  auto arguments = solve_arguments(write("i.csv", "27,0,0,0.001\n"));
  arguments.insert(arguments.end(), {"--model", "direct"});
  Process program("organ_solve", arguments);
  EXPECT_EQ(program.wait(), 0) << program.messages();
  EXPECT_EQ(numbers("s.u.csv")[27][3], 0.001);
}

TEST_F(OrganProgramsTest, NodesThatNoTetrahedronUsesKeepTheirNumbers) {
  geometry::RawMesh raw = test::make_raw_box(4, 3, 3, {0.08, 0.06, 0.06});
  raw.positions.insert(raw.positions.begin() + 7, geometry::Vec3(1, 1, 1));
  for (auto& tetrahedron : raw.tetrahedra) {
    for (auto& node : tetrahedron) node += node >= 7;
  }
  std::swap(raw.tetrahedra[5][0], raw.tetrahedra[5][1]);
  std::string vtk = "# vtk DataFile Version 3.0\nunused node\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
                    std::to_string(raw.positions.size()) + " double\n";
  const auto add = [&vtk](double value) { vtk += std::to_string(value) + " "; };
  for (const geometry::Vec3& p : raw.positions) add(p.x()), add(p.y()), add(p.z());
  const std::size_t cells = raw.tetrahedra.size();
  vtk += "\nCELLS " + std::to_string(cells) + " " + std::to_string(5 * cells) + "\n";
  for (const auto& t : raw.tetrahedra) {
    vtk += "4";
    for (const auto node : t) vtk.append(" ").append(std::to_string(node));
    vtk += "\n";
  }
  vtk += "CELL_TYPES " + std::to_string(cells) + "\n";
  for (std::size_t t = 0; t < cells; ++t) vtk += "10\n";

  Process builder("organ_build", build_arguments(write("unused.vtk", vtk)));
  ASSERT_EQ(builder.wait(), 0) << builder.messages();
  EXPECT_THAT(builder.messages(), HasSubstr("1 node belongs to no tetrahedron"));
  EXPECT_THAT(builder.messages(), HasSubstr("1 tetrahedron"));
  expect_refused("organ_solve", solve_arguments(write("i.csv", "7,0,0,0.001\n")),
                 "belongs to no tetrahedron");
  Process solver("organ_solve", solve_arguments(write("i.csv", "80,0,0,0.001\n")));
  ASSERT_EQ(solver.wait(), 0) << solver.messages();
  const auto u = numbers("s.u.csv");
  ASSERT_EQ(u.size(), raw.positions.size());
  EXPECT_THAT(u[7], testing::ElementsAre(7, 0, 0, 0));
  EXPECT_NEAR(u[80][3], 0.001, 1e-9);
}

// A bar that hangs from its top at z = h: without lateral contraction its end goes down by rho g h^2 / (2 E).
TEST_F(OrganProgramsTest, AHangingBarStretchesByItsWeight) {
  constexpr int kSection = 3 * 3;  // nodes
  constexpr double kHeight_m = 0.2, kYoung_pa = 3000, kDensity = 1050, kGravity = 9.81;
  const auto bar = folder / "bar.msh";
  geometry::write_mesh(test::make_box_mesh(2, 2, 20, {0.02, 0.02, kHeight_m}), bar);
  std::vector<std::string> arguments = build_arguments(bar);
  for (auto& argument : arguments) {
    if (argument == "plane:x<0.001") argument = "plane:z>0.1999";
    if (argument == "0.45") argument = "0.0";
  }
  Process builder("organ_build", arguments);
  ASSERT_EQ(builder.wait(), 0) << builder.messages();
  for (const char* model : {"tensors", "direct"}) {
    Process solver("organ_solve", {organ.string(), "--gravity", "0,0,-9.81", "--model", model, "-o",
                                   (folder / "s").string()});
    ASSERT_EQ(solver.wait(), 0) << solver.messages();
    const Rows u = numbers("s.u.csv");
    double end = 0;
    for (int n = 0; n < kSection; ++n) end += u[n][3] / kSection;  // the mean over the lowest section
    const double theory = -kDensity * kGravity * kHeight_m * kHeight_m / (2 * kYoung_pa);
    EXPECT_NEAR(end, theory, 1e-4 * std::abs(theory)) << model;
  }
}

// The contract of organ_solve (issue 2, "done when"), through files and programs, on meshes that nobody here
// made: 1e-9 stored in double; stored in float 1e-5 of the largest force, 2e-5 of the largest displacement.
class RealOrganTest : public OrganProgramsTest,
                      public testing::WithParamInterface<std::tuple<const char*, const char*>> {};

TEST_P(RealOrganTest, TensorsEqualTheDirectSolve) {
  const auto& [name, precision] = GetParam();
  const std::filesystem::path real = test::data_file(name);
  if (!std::filesystem::exists(real)) GTEST_SKIP() << real << " is not there";
  const geometry::TetraMesh checked = geometry::check_mesh(geometry::read_mesh(real), 0.001).mesh;
  double low = checked.positions[0].x(), high = low;
  for (const auto& p : checked.positions) low = std::min(low, p.x()), high = std::max(high, p.x());
  std::vector<std::string> arguments = build_arguments(real);
  for (auto& argument : arguments) {
    if (argument == "1") argument = "0.001";
    if (argument == "plane:x<0.001") argument = "plane:x<" + std::to_string(low + 0.1 * (high - low));
  }
  arguments.insert(arguments.end(), {"--store", precision});
  Process builder("organ_build", arguments);
  ASSERT_EQ(builder.wait(), 0) << builder.messages();

  const Organ built = load_organ(organ, Load::kMeshOnly);
  const bool twofold = std::string(precision) == "double";
  for (const int count : {1, 3, 12}) {
    std::string csv;
    for (int i = 0; i < count; ++i) {  // scattered evenly over the surface, each its own way
      const std::int32_t s = (2 * i + 1) * built.surface.mobile_count / (2 * count);
      csv += std::to_string(built.mesh.file_node[built.surface.node[s]]);
      for (int axis = 0; axis < 3; ++axis)
        csv.append(",").append(std::to_string(0.002 * std::sin(i + 2.0 * axis)));
      csv += "\n";
    }
    const std::string imposed = write("imposed.csv", csv);
    std::vector<std::vector<double>> u[2], f[2];
    for (const int model : {0, 1}) {
      auto solve = solve_arguments(imposed);
      solve.insert(solve.end(), {"--model", model == 0 ? "tensors" : "direct"});
      Process solver("organ_solve", solve);
      ASSERT_EQ(solver.wait(), 0) << solver.messages();
      u[model] = numbers("s.u.csv"), f[model] = numbers("s.f.csv");
    }
    EXPECT_LE(largest_difference(f[0], f[1]), (twofold ? 1e-9 : 1e-5) * largest_entry(f[1])) << count;
    EXPECT_LE(largest_difference(u[0], u[1]), (twofold ? 1e-9 : 2e-5) * largest_entry(u[1])) << count;
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealOrganTest,
                         testing::Combine(testing::Values("tet/openhelp_liver_7k.msh",
                                                          "tet/sofamcp_prostate.vtk",
                                                          "tet/sofaenv_gallbladder.vtk"),
                                          testing::Values("float", "double")));

}  // namespace
}  // namespace omentum::organ
