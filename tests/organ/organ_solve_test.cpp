// What organ_solve promises of its answers, and what it refuses to answer.
#include "tests/organ/organ_programs.h"

#include <random>
#include <regex>

namespace omentum::organ {
namespace {

class OrganSolveTest : public OrganProgramsTest {
 protected:
  struct Solved {
    Rows u, f;
    std::string messages;
  };

  Solved solve(const std::string& csv, const std::string& model) const {
    auto arguments = solve_arguments(write("imposed.csv", csv));
    arguments.insert(arguments.end(), {"--model", model});
    Process program("organ_solve", arguments);
    EXPECT_EQ(program.wait(), 0) << program.messages();
    return {numbers("s.u.csv"), numbers("s.f.csv"), program.messages()};
  }

  void build_with(std::vector<std::string> arguments) const {
    Process program("organ_build", std::move(arguments));
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  // The box, one of whose tetrahedra has a copy of `node`, 80, in its place.
  std::filesystem::path write_cracked(std::int32_t node) const {
    geometry::RawMesh raw = test::make_raw_box(4, 3, 3, {0.08, 0.06, 0.06});
    const auto user = std::ranges::find_if(
        raw.tetrahedra, [&](const auto& t) { return std::ranges::find(t, node) != t.end(); });
    std::ranges::replace(*user, node, static_cast<std::int32_t>(raw.positions.size()));
    raw.positions.push_back(raw.positions[node]);
    geometry::TetraMesh cracked;
    cracked.positions = raw.positions;
    for (const auto& t : raw.tetrahedra)
      cracked.tetrahedra.push_back(
          {geometry::NodeId(t[0]), geometry::NodeId(t[1]), geometry::NodeId(t[2]), geometry::NodeId(t[3])});
    geometry::write_mesh(cracked, folder / "cracked.msh");
    return folder / "cracked.msh";
  }

  std::vector<std::string> merging(const std::filesystem::path& file) const {
    auto arguments = build_arguments(file);
    arguments.insert(arguments.end(), {"--merge", "1e-6"});
    return arguments;
  }

  static std::vector<double> without_node(const std::vector<double>& row) {
    return {row.begin() + 1, row.end()};
  }

  // What a warning says of the largest force and displacement; zeros without one.
  static std::pair<double, double> said(const std::string& messages) {
    std::smatch found;
    const std::regex figures("by ([-+.e0-9]+) of the largest force and ([-+.e0-9]+) of");
    if (!std::regex_search(messages, found, figures)) return {0, 0};
    return {std::stod(found[1]), std::stod(found[2])};
  }
};

// A thin plate, whose nodes follow each other: the condition of C_AA says little of the error there.
TEST_F(OrganSolveTest, TheErrorOfFloatTensorsIsNeverMissed) {
  constexpr double kForce = 1e-5, kDisplacement = 2e-5;  // decision 26
  constexpr double kKnownTo = 0.1;                       // of what the warning says
  const auto plate = folder / "plate.msh";
  const geometry::TetraMesh checked = test::make_box_mesh(10, 10, 2, {0.1, 0.1, 0.01});
  geometry::write_mesh(checked, plate);
  build_with(build_arguments(plate));
  std::vector<std::string> cases = {
      "359,-0.00372974,0.000615278,0.000850541\n238,0.000213373,-0.00242716,0.00177706\n"
      "358,-0.00292938,-0.000928526,-0.00157626\n"};
  std::mt19937 random(1);
  std::normal_distribution<double> millimetres(0, 1e-3);
  for (int i = 0; i < 20; ++i) {
    // neighbours of a corner of the plate's free edge, each its own way
    std::vector<int> nodes = {10, 21, 131, 142, 252, 263, 9, 130, 251, 20};
    std::shuffle(nodes.begin(), nodes.end(), random);
    nodes.resize(2 + i % 8);
    cases.emplace_back();
    for (const int n : nodes) {
      cases.back() += std::to_string(n);
      for (int axis = 0; axis < 3; ++axis) cases.back() += "," + std::to_string(millimetres(random));
      cases.back() += "\n";
    }
  }
  int warned = 0;
  for (const std::string& csv : cases) {
    SCOPED_TRACE(csv);
    const Solved tensors = solve(csv, "tensors"), direct = solve(csv, "direct");
    const double force = largest_difference(tensors.f, direct.f) / largest_entry(direct.f);
    const double displacement = largest_difference(tensors.u, direct.u) / largest_entry(direct.u);
    const auto [said_force, said_displacement] = said(tensors.messages);
    EXPECT_EQ(said(direct.messages).first, 0);
    if (said_force == 0) {
      EXPECT_LE(force, kForce);
      EXPECT_LE(displacement, kDisplacement);
      continue;
    }
    ++warned;
    EXPECT_NEAR(said_force, force, kKnownTo * force);
    EXPECT_NEAR(said_displacement, displacement, kKnownTo * displacement + 1e-8);
  }
  EXPECT_GT(warned, 0);
}

// A support and a hand that hold the same component of the same node do the same.
TEST_F(OrganSolveTest, WhatASupportHoldsOfAnImposedNodeIsInItsForce) {
  const std::string one = write("one.csv", "79\n") + ":z";
  const std::string csv = "79,0.001,-0.0005,0\n59,0,0.001,0.0003\n";
  for (const char* precision : {"double", "float"}) {
    const double tolerance = precision[0] == 'd' ? 1e-9 : 1e-5;
    auto by_hand = build_arguments(mesh);
    by_hand.insert(by_hand.end(), {"--store", precision});
    auto by_support = by_hand;
    by_support.insert(by_support.end(), {"--fixed", one});
    for (const char* model : {"tensors", "direct"}) {
      SCOPED_TRACE(std::string(precision) + " " + model);
      build_with(by_hand);
      const Solved hand = solve(csv, model);
      build_with(by_support);
      const Solved support = solve(csv, model);
      EXPECT_GT(std::abs(hand.f[0][3]), 0.01 * largest_entry(hand.f));
      EXPECT_LE(largest_difference(hand.f, support.f), tolerance * largest_entry(hand.f));
    }
  }
}

// A ball five times as stiff and a heavy slab: both ways of solving see the same organ, under loads too.
TEST_F(OrganSolveTest, TensorsAgreeWithADirectSolveOnAMeshOfSeveralMaterials) {
  auto arguments = build_arguments(mesh);
  arguments.insert(arguments.end(),
                   {"--store", "double", "--region", "ball=0.05,0.03,0.03,0.025; young=15000; poisson=0.3",
                    "--region", "box=0.06,0,0,0.08,0.06,0.06;density=4000"});
  const std::string csv = "79,0.001,-0.0005,0\n59,0,0.001,0.0003\n";
  const std::vector<std::string> gravity = {organ.string(), "--gravity", "1,0,-9.81", "-o",
                                            (folder / "s").string()};
  const auto sag = [&](const char* model) {
    auto with_model = gravity;
    with_model.insert(with_model.end(), {"--model", model});
    Process program("organ_solve", with_model);
    EXPECT_EQ(program.wait(), 0) << program.messages();
    return numbers("s.u.csv");
  };
  build();
  const Solved plain = solve(csv, "direct");
  const Rows plain_sag = sag("direct");
  build_with(arguments);
  const Solved tensors = solve(csv, "tensors"), direct = solve(csv, "direct");
  EXPECT_LE(largest_difference(tensors.f, direct.f), 1e-9 * largest_entry(direct.f));
  EXPECT_LE(largest_difference(tensors.u, direct.u), 1e-9 * largest_entry(direct.u));
  EXPECT_GT(largest_difference(plain.f, direct.f), 0.05 * largest_entry(plain.f)) << "stiffer";
  const Rows tensor_sag = sag("tensors"), direct_sag = sag("direct");
  EXPECT_LE(largest_difference(tensor_sag, direct_sag), 1e-9 * largest_entry(direct_sag));
  EXPECT_GT(largest_entry(direct_sag), 1.2 * largest_entry(plain_sag)) << "heavier";
}

TEST_F(OrganSolveTest, AnswersBeyondAllMeaningAreRefusedAndNothingIsWritten) {
  build();
  for (const char* model : {"tensors", "direct"}) {
    auto arguments = solve_arguments(write("i.csv", "59,0,0.001,0\n79,1e308,-1e308,1e308\n"));
    arguments.insert(arguments.end(), {"--model", model});
    expect_refused("organ_solve", arguments, "i.csv:2: node 79");
    for (const char* gravity : {"0,0,1e308", "1e200,0,0", "0,1e9,0"}) {
      expect_refused("organ_solve",
                     {organ.string(), "--gravity", gravity, "--model", model, "-o", (folder / "s").string()},
                     "displacement is not finite or more than");
    }
  }
  // a metre, ten times the organ's size, is what a user divides by
  EXPECT_EQ(solve("79,1,0,0\n", "direct").f.size(), 1u);
}

TEST_F(OrganSolveTest, DamagedTensorsAreRefused) {
  build();
  std::string content = test::read_text(organ);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 8);
  std::ofstream(organ, std::ios::binary) << content;
  expect_refused("organ_solve", solve_arguments(write("i.csv", "79,0,0,0.001\n")), "tensors are damaged");
}

TEST_F(OrganSolveTest, APartGluedByCopyingIsOneOrganAfterMerging) {
  constexpr std::int32_t kInner = 1 + 5 * (1 + 4 * 1);
  const auto file = write_cracked(kInner);
  expect_refused("organ_build", build_arguments(file), "1 pair of nodes at the same place");
  build_with(merging(file));
  const Solved merged = solve("79,0.001,0,0\n", "direct");
  build();
  const Solved whole = solve("79,0.001,0,0\n", "direct");
  EXPECT_EQ(merged.u.size(), whole.u.size() + 1) << "the file's nodes keep their numbers";
  EXPECT_LE(largest_difference(merged.f, whole.f), 1e-12 * largest_entry(whole.f));
  EXPECT_EQ(without_node(merged.u[80]), without_node(merged.u[kInner])) << "both are one node";
}

TEST_F(OrganSolveTest, AMergedNodeIsAnotherNameOfTheOneThatTookItsPlace) {
  build_with(merging(write_cracked(59)));
  for (const char* model : {"tensors", "direct"}) {
    const Solved kept = solve("59,0,0.001,0\n", model);
    for (const char* named : {"80,0,0.001,0\n", "80,0,0.001,0\n59,0,1e-3,0\n"}) {
      SCOPED_TRACE(std::string(model) + " " + named);
      const Solved dropped = solve(named, model);
      EXPECT_EQ(dropped.u, kept.u);
      EXPECT_EQ(dropped.f, kept.f) << "the force is that of node 59, once";
      EXPECT_EQ(without_node(dropped.u[80]), without_node(dropped.u[59]));
    }
  }
}

TEST_F(OrganSolveTest, AMergedNodeIsMovedOneWay) {
  build_with(merging(write_cracked(59)));
  expect_refused("organ_solve", solve_arguments(write("i.csv", "80,0,0.001,0\n59,0,0.002,0\n")),
                 "i.csv:2: node 59 is listed twice, first at ");
  expect_refused("organ_solve", solve_arguments(write("i.csv", "79,0,0,0\n59,0,0.001,0\n80,0,0.002,0\n")),
                 "i.csv:3: node 80 (merged into node 59) is listed twice, first at ");
}

}  // namespace
}  // namespace omentum::organ
