// organ_solve of organs that were cut, and by the models that move.
#include "geometry/mesh_editor.h"
#include "physics/element_tensors.h"
#include "tests/organ/organ_programs.h"

#include <numeric>
#include <random>

namespace omentum::organ {
namespace {

// Printed with 13 digits; a moving model rests where forces balance to 1e-10 of the largest.
constexpr double kEqual = 1e-6;

struct RealMesh {
  const char *file, *scale, *plane;
};
constexpr std::array kRealMeshes{RealMesh{"tet/openhelp_liver_7k.msh", "0.001", "plane:x<-0.12"},
                                 RealMesh{"tet/sofa_liver2.msh", "0.02", "plane:x<-0.015"},
                                 RealMesh{"tet/sofa_liver.msh", "0.02", "plane:x<-0.06"}};

class OrganSolveCutTest : public OrganProgramsTest {
 protected:
  // Of the largest value.
  static double difference(const Rows& a, const Rows& b) {
    return largest_difference(a, b) / largest_entry(b);
  }

  void build_from(const std::string& data, const std::string& scale, const std::string& plane) const {
    Process program("organ_build", {test::data_file(data).string(), "-o", organ.string(), "--young", "5000",
                                    "--poisson", "0.45", "--density", "1050", "--scale", scale, "--fixed",
                                    plane, "--numbering", "position"});
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  static geometry::Vec3 middle(const Organ& organ, std::size_t t) {
    geometry::Vec3 sum = geometry::Vec3::Zero();
    for (const geometry::NodeId n : organ.mesh.tetrahedra[t]) sum += organ.mesh.positions[n] / 4;
    return sum;
  }

  // All tetrahedra, the farthest from the supports' plane first: what is left of them is in one piece.
  static std::vector<std::size_t> from_the_free_end(const Organ& organ) {
    std::vector<std::size_t> order(organ.mesh.tetrahedra.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, std::greater(), [&](std::size_t t) { return middle(organ, t).x(); });
    return order;
  }

  // One set in five orders: as it is given, backwards, from its middle outwards and inwards, and at random.
  static std::vector<std::vector<std::size_t>> orders_of(const std::vector<std::size_t>& away,
                                                         const Organ& organ) {
    geometry::Vec3 centre = geometry::Vec3::Zero();
    for (const std::size_t t : away) centre += middle(organ, t) / static_cast<double>(away.size());
    std::vector<std::vector<std::size_t>> orders(5, away);
    std::ranges::reverse(orders[1]);
    std::ranges::sort(orders[2], {}, [&](std::size_t t) { return (middle(organ, t) - centre).norm(); });
    orders[3].assign(orders[2].rbegin(), orders[2].rend());
    std::ranges::shuffle(orders[4], std::mt19937(1998));
    return orders;
  }

  static std::string listed(const std::vector<std::size_t>& tetrahedra) {
    std::string list;
    for (const std::size_t t : tetrahedra) list += std::to_string(t) + "\n";
    return list;
  }

  // At a node of this tetrahedron that is free.
  std::string pull_at(std::size_t t) const {
    const Organ loaded = load_organ(organ, Load::kMeshOnly);
    const auto& nodes = loaded.mesh.tetrahedra[t];
    const auto n = std::ranges::find(nodes, 0, [&](geometry::NodeId node) { return loaded.fixed[node]; });
    EXPECT_NE(n, nodes.end());
    return write("i.csv", std::to_string(std::int32_t(*n)) + ",0.002,0.001,-0.001\n");
  }

  // Every fiftieth tetrahedron.
  std::string some_tetrahedra() const {
    std::string list = "tetrahedron\n";
    const Organ loaded = load_organ(organ, Load::kMeshOnly);
    for (std::size_t t = 0; t < loaded.mesh.tetrahedra.size(); t += 50) list += std::to_string(t) + "\n";
    return write("tets.csv", list);
  }
};

TEST_F(OrganSolveCutTest, TensorMassRestsWhereTheDirectSolveIs) {
  build();
  const std::string imposed = write("i.csv", "79,0,0.002,0.001\n");
  const std::vector<std::string> whole{"--gravity", "0,-9.81,1", "--imposed", imposed};
  std::vector<std::string> cut = whole;
  cut.insert(cut.end(), {"--remove", write("t.csv", "tet\n3\n70\n71\n140\n")});
  const Solved direct = solve("direct", whole), direct_cut = solve("direct", cut);
  const Solved moved = solve("tensor-mass", whole), moved_cut = solve("tensor-mass", cut);
  EXPECT_LE(difference(moved.u, direct.u), kEqual);
  EXPECT_LE(difference(moved.f, direct.f), kEqual);
  EXPECT_LE(difference(moved_cut.u, direct_cut.u), kEqual);
  EXPECT_LE(difference(moved_cut.f, direct_cut.f), kEqual);
  EXPECT_GT(difference(direct_cut.u, direct.u), 1e-3);
}

TEST_F(OrganSolveCutTest, TensorMassRestsWhereTheDirectSolveIsOnRealMeshes) {
  for (const RealMesh& mesh : kRealMeshes) {
    if (!std::filesystem::exists(test::data_file(mesh.file))) GTEST_SKIP() << mesh.file << " is absent";
    SCOPED_TRACE(mesh.file);
    build_from(mesh.file, mesh.scale, mesh.plane);
    const std::vector<std::string> whole{"--gravity", "0,-9.81,0"};
    const std::vector<std::string> cut{"--gravity", "0,-9.81,0", "--remove", some_tetrahedra()};
    EXPECT_LE(difference(solve("tensor-mass", whole).u, solve("direct", whole).u), kEqual);
    EXPECT_LE(difference(solve("tensor-mass", cut).u, solve("direct", cut).u), kEqual);
  }
}

// The free end is eaten away; the direct solve is of the mesh that is left.
TEST_F(OrganSolveCutTest, TheDowndatedFactorAnswersAsADirectSolveInEveryOrder) {
  constexpr double kPromised = 1e-5;  // of a cut organ
  for (const RealMesh& mesh : kRealMeshes) {
    if (!std::filesystem::exists(test::data_file(mesh.file))) GTEST_SKIP() << mesh.file << " is absent";
    build_from(mesh.file, mesh.scale, mesh.plane);
    const Organ uncut = load_organ(organ, Load::kMeshOnly);
    const std::vector<std::size_t> far_first = from_the_free_end(uncut);
    for (const std::size_t count : {1, 30, 300}) {
      SCOPED_TRACE(mesh.file + (" " + std::to_string(count)));
      const std::vector<std::size_t> away(far_first.begin(),
                                          far_first.begin() + static_cast<std::ptrdiff_t>(count));
      const auto arguments = [&](const std::vector<std::size_t>& removed) {
        return std::vector<std::string>{"--gravity", "0,-9.81,0",
                                        "--imposed", pull_at(far_first[(count + far_first.size()) / 2]),
                                        "--remove",  write("t.csv", listed(removed))};
      };
      const Solved direct = solve("direct", arguments(away));
      const auto orders = orders_of(away, uncut);
      for (std::size_t order = 0; order < (count == 1 ? 1 : orders.size()); ++order) {
        const Solved cut = solve("cut", arguments(orders[order]));
        EXPECT_LE(difference(cut.u, direct.u), kPromised) << "order " << order;
        EXPECT_LE(difference(cut.f, direct.f), kPromised) << "order " << order;
      }
    }
  }
}

TEST_F(OrganSolveCutTest, APieceThatOnlyImposedNodesHoldIsSolvedToo) {
  build();
  std::string cut, pulled;
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  for (std::size_t t = 0; t < loaded.mesh.tetrahedra.size(); ++t)
    if (middle(loaded, t).x() > 0.04 && middle(loaded, t).x() < 0.06) cut += std::to_string(t) + "\n";
  for (std::size_t n = 0; n < loaded.mesh.positions.size(); ++n)
    if (loaded.mesh.positions[n].x() > 0.079) pulled += std::to_string(n) + ",0.001,0,0.002\n";
  const std::vector<std::string> arguments{
      "--gravity", "0,-9.81,0", "--imposed", write("i.csv", pulled), "--remove", write("t.csv", cut)};
  const Solved direct = solve("direct", arguments), solved = solve("cut", arguments);
  EXPECT_LE(difference(solved.u, direct.u), kEqual);
  EXPECT_LE(difference(solved.f, direct.f), kEqual);
}

TEST_F(OrganSolveCutTest, TheFactorOfAnUncutOrganAnswersAsADirectSolve) {
  build();
  const std::vector<std::string> arguments{"--imposed", write("i.csv", "79,0,0.002,0.001\n74,0.001,0,0\n")};
  EXPECT_LE(difference(solve("cut", arguments).f, solve("direct", arguments).f), kEqual);
}

// Where every node is held, each is held against the weight it carries.
TEST_F(OrganSolveCutTest, WhatIsTakenOutWeighsNothing) {
  build();
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  const std::vector<geometry::TetId> asked{geometry::TetId(3), geometry::TetId(70), geometry::TetId(71),
                                           geometry::TetId(140)};
  geometry::MeshEditor left(loaded.mesh);
  left.remove(asked);
  std::vector<double> carried_n(loaded.mesh.positions.size());
  for (std::size_t t = 0; t < loaded.mesh.tetrahedra.size(); ++t) {
    if (left.is_removed(geometry::TetId(t))) continue;
    const auto x = physics::corners_of(loaded.mesh, geometry::TetId(t));
    const double weight_n = 10 * 1050 * geometry::signed_volume(x[0], x[1], x[2], x[3]);
    for (const geometry::NodeId n : loaded.mesh.tetrahedra[t]) carried_n[n] += weight_n / 4;
  }
  std::string all;
  for (std::size_t n = 0; n < carried_n.size(); ++n)
    if (loaded.fixed[n] == 0 && left.uses(geometry::NodeId(n)) > 0) all += std::to_string(n) + ",0,0,0\n";
  for (const char* model : {"direct", "tensor-mass", "corotational", "spring-mass"}) {
    SCOPED_TRACE(model);
    const Solved solved = solve(model, {"--gravity", "0,-10,0", "--imposed", write("i.csv", all), "--remove",
                                        write("t.csv", "3\n70\n71\n140\n")});
    ASSERT_FALSE(solved.f.empty());
    for (const auto& row : solved.f) {
      const double carried = carried_n[static_cast<std::size_t>(row[0])];
      EXPECT_NEAR(row[2], carried, kEqual * carried) << row[0];
    }
  }
}

TEST_F(OrganSolveCutTest, CorotationalTissueIsTheLinearOneWhereLittleMoves) {
  build();
  // a thousandth of the organ's size: the laws differ by terms that are smaller by as much
  const std::vector<std::string> little{"--gravity", "0,-1e-2,0", "--remove", write("t.csv", "3\n70\n")};
  EXPECT_LE(difference(solve("corotational", little).u, solve("direct", little).u), 1e-3);
}

TEST_F(OrganSolveCutTest, SpringsHoldWhatTheyAreGiven) {
  build();
  const std::string imposed = write("i.csv", "79,0,0,0\n74,0,0,0\n");
  const Solved springs = solve("spring-mass", {"--gravity", "0,-2,0", "--imposed", imposed});
  EXPECT_EQ(largest_entry({springs.u[79], springs.u[74]}), 0);
  EXPECT_GT(springs.f[0][2], 0);
}

TEST_F(OrganSolveCutTest, ANodeWithoutTetrahedraStaysWhereItIs) {
  build();
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  const geometry::NodeId corner(79);
  std::string around;
  for (std::size_t t = 0; t < loaded.mesh.tetrahedra.size(); ++t) {
    if (std::ranges::find(loaded.mesh.tetrahedra[t], corner) != loaded.mesh.tetrahedra[t].end())
      around += std::to_string(t) + "\n";
  }
  for (const char* model : {"direct", "tensor-mass"}) {
    const Solved solved = solve(model, {"--gravity", "0,-9.81,0", "--remove", write("t.csv", around)});
    EXPECT_EQ(largest_entry({solved.u[79]}), 0) << model;
    EXPECT_GT(largest_entry(solved.u), 0) << model;
  }
}

TEST_F(OrganSolveCutTest, BadCutsAreRefused) {
  build();
  const auto refused = [&](const std::string& tets, const std::string& named) {
    expect_refused("organ_solve",
                   {organ.string(), "--numbering", "position", "--gravity", "0,-9.81,0", "--model", "direct",
                    "--remove", write("t.csv", tets), "-o", (folder / "s").string()},
                   named);
  };
  refused("0\n100000\n", "t.csv:2: found '100000'");
  refused("node,x\n1,2\n", "tetrahedron");
  refused("1.5\n", "t.csv:1: found '1.5'");
  refused("# numbering: file\n1\n", "another numbering");

  // the middle layer: what is beyond it is cut loose
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  std::string layer;
  for (std::size_t t = 0; t < loaded.mesh.tetrahedra.size(); ++t) {
    if (middle(loaded, t).x() > 0.04 && middle(loaded, t).x() < 0.06) layer += std::to_string(t) + "\n";
  }
  refused(layer, "loose");
}

TEST_F(OrganSolveCutTest, StoredTensorsAreOfTheUncutOrgan) {
  build();
  expect_refused("organ_solve",
                 {organ.string(), "--numbering", "position", "--gravity", "0,-1,0", "--remove",
                  write("t.csv", "1\n"), "-o", (folder / "s").string()},
                 "--remove");
}

}  // namespace
}  // namespace omentum::organ
