// organ_build and organ_solve as a user runs them: real processes, real files.
#include "organ/csv.h"
#include "organ/organ.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace omentum::organ {
namespace {

using test::Process;
using testing::HasSubstr;

constexpr int kBadInput = 2;
constexpr int kInterrupted = 130;

class OrganProgramsTest : public testing::Test {
 protected:
  OrganProgramsTest() {
    geometry::write_mesh(test::make_box_mesh(4, 3, 3, {0.08, 0.06, 0.06}), mesh);
    // large enough that its tensors take a while
    geometry::write_mesh(test::make_box_mesh(18, 18, 18, {0.1, 0.1, 0.1}), large_mesh);
  }

  std::vector<std::string> build_arguments(const std::filesystem::path& from) const {
    return {from.string(), "-o",   organ.string(), "--young", "3000",    "--poisson",    "0.45",
            "--density",   "1050", "--scale",      "1",       "--fixed", "plane:x<0.001"};
  }

  // One option's value replaced, or an option added.
  std::vector<std::string> with(const std::string& option, const std::string& value) const {
    std::vector<std::string> arguments = build_arguments(mesh);
    const auto found = std::ranges::find(arguments, option);
    if (found == arguments.end()) {
      arguments.insert(arguments.end(), {option, value});
    } else {
      *(found + 1) = value;
    }
    return arguments;
  }

  void build() {
    Process program("organ_build", build_arguments(mesh));
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }

  // Exit code 2, one line that names what is wrong, and nothing left behind.
  void expect_refused(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& named) {
    SCOPED_TRACE(named);
    const bool had_organ = std::filesystem::exists(organ);
    Process process(program, arguments);
    EXPECT_EQ(process.wait(), kBadInput);
    const std::string message = process.messages();
    EXPECT_EQ(std::ranges::count(message, '\n'), 1) << message;
    EXPECT_THAT(message, HasSubstr(named));
    EXPECT_EQ(std::filesystem::exists(organ), had_organ);
    EXPECT_FALSE(std::filesystem::exists(partial));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.u.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.f.csv"));
  }

  std::vector<std::string> solve_arguments(const std::string& imposed) const {
    return {organ.string(), "--imposed", imposed, "-o", (folder / "s").string()};
  }

  std::vector<std::vector<double>> numbers(const std::string& name) const {
    std::vector<std::vector<double>> rows;
    for (const CsvLine& line : read_csv(folder / name)) {
      rows.emplace_back();
      for (const std::string& field : line.fields) rows.back().push_back(parse_number(field).value());
    }
    return rows;
  }

  test::ScratchFolder folder;
  const std::filesystem::path mesh = folder / "box.msh", large_mesh = folder / "large.msh";
  const std::filesystem::path organ = folder / "box.h5", partial = folder / "box.h5.partial";
};

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
  expect_refused("organ_build", with("--dynamic", "plane:x>0"), "not part of this version");
  expect_refused("organ_build", with("-o", (folder / "absent" / "o.h5").string()), "absent");
}

TEST_F(OrganProgramsTest, KilledBuildLeavesNothingThatLooksFinished) {
  Process program("organ_build", build_arguments(large_mesh));
  ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(partial); }));
  EXPECT_EQ(program.end(SIGKILL), -SIGKILL);

  EXPECT_FALSE(std::filesystem::exists(organ));
  EXPECT_THROW(load_organ(partial, Load::kMeshOnly), geometry::InputError);
  build();  // takes the remains over
  EXPECT_FALSE(std::filesystem::exists(partial));
  EXPECT_NO_THROW(load_organ(organ, Load::kWithTensors));
}

TEST_F(OrganProgramsTest, TerminatedBuildRemovesItsTracesAndKeepsTheOldOrgan) {
  build();
  const std::string hash = load_organ(organ, Load::kMeshOnly).hash;
  for (const int signal : {SIGTERM, SIGINT}) {
    Process program("organ_build", build_arguments(large_mesh));
    ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(partial); }));
    EXPECT_EQ(program.end(signal), kInterrupted);
    EXPECT_THAT(program.messages(), HasSubstr("interrupted"));
    EXPECT_FALSE(std::filesystem::exists(partial));
    EXPECT_EQ(load_organ(organ, Load::kWithTensors).hash, hash);
  }
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
    double scale_u = 0, scale_f = 0;
    for (const auto& row : u[1])
      scale_u = std::max({scale_u, std::abs(row[1]), std::abs(row[2]), std::abs(row[3])});
    for (const auto& row : f[1])
      scale_f = std::max({scale_f, std::abs(row[1]), std::abs(row[2]), std::abs(row[3])});
    for (int c = 0; c < 4; ++c) {
      for (std::size_t n = 0; n < u[0].size(); ++n) EXPECT_NEAR(u[0][n][c], u[1][n][c], 2e-5 * scale_u);
      for (std::size_t n = 0; n < f[0].size(); ++n) EXPECT_NEAR(f[0][n][c], f[1][n][c], 1e-5 * scale_f);
    }
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
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--model", "hybrid"},
                                      {"--model", "tensor-mass"},
                                      {"--remove", "tets.csv"},
                                      {"--gravity", "1,2"},
                                      {"-o", (folder / "absent" / "s").string()}}) {
    auto extended = arguments;
    if (option == "-o") extended.resize(3);
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

}  // namespace
}  // namespace omentum::organ
