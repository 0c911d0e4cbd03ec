// Nodes and tetrahedra go by the numbers that their file gives them.
#include "tests/organ/foreign_files.h"

namespace omentum::organ {
namespace {

using testing::StartsWith;

// The manifest's mesh with tags that are not in a row, which nobody here made.
TEST_F(ForeignFilesTest, TagsOfARealMeshAreItsOwn) {
  const std::filesystem::path real = test::data_file("tet/sofa_liver2.msh");
  if (!std::filesystem::exists(real)) GTEST_SKIP() << real << " is not there";
  std::ifstream in(real);
  std::string word;
  std::size_t count = 0;
  while (in >> word && word != "$NOD" && word != "$Nodes") continue;
  in >> count;
  std::vector<std::pair<double, long>> by_x;
  for (std::size_t n = 0; n < count; ++n) {
    long tag = 0;
    double x = 0, y = 0, z = 0;
    in >> tag >> x >> y >> z;
    by_x.emplace_back(x, tag);
  }
  std::ranges::sort(by_x);
  const double limit = (by_x[60].first + by_x[61].first) / 2;
  ASSERT_LT(by_x[60].first, by_x[61].first);
  std::string held;
  for (int n = 0; n <= 60; ++n) held += std::to_string(by_x[n].second) + "\n";
  const auto in_decimetres = [&](const std::string& fixed) {
    std::vector<std::string> arguments = plain(real, fixed);
    *(std::ranges::find(arguments, "--scale") + 1) = "0.1";
    return arguments;
  };
  char plane[60];
  std::snprintf(plane, sizeof plane, "plane:x<%.17g", 0.1 * limit);
  EXPECT_EQ(hash_after(in_decimetres(write("held.csv", held))), hash_after(in_decimetres(plane)));
  expect_refused("organ_build", in_decimetres(write("held.csv", "0\n")), "held.csv:1: found '0'");
}

// Each kind of file, with its own way to count.
class OwnNumbersTest : public ForeignFilesTest, public testing::WithParamInterface<const char*> {
 protected:
  OwnNumbersTest() {
    const std::string kind = GetParam();
    if (kind.starts_with("Gmsh")) cells.first_node = 1000, cells.node_step = -7, cells.first_cell = 500;
    if (kind == "Gmsh1") file = write("own.msh", test::gmsh_1(cells));
    if (kind == "Gmsh2") file = write("own.msh", test::gmsh_2(cells));
    if (kind == "Gmsh4") file = write("own.msh", test::gmsh_4(cells));
    if (kind == "TetGen") {
      file = write("own.node", test::tetgen_nodes(cells));
      write("own.ele", test::tetgen_elements(cells));
    }
    if (kind == "Vtk" || kind == "Vtu") cells.first_node = cells.first_cell = 0;
    if (kind == "Vtk") file = write("own.vtk", test::vtk_legacy(cells));
    if (kind == "Vtu") file = write("own.vtu", test::vtu({cells}));
  }

  test::CellMesh cells = box;
  std::string file;
};

TEST_P(OwnNumbersTest, SupportsAreTheNodesThatTheFileCallsSo) {
  const std::string by_plane = hash_after(plain(file));
  EXPECT_EQ(hash_after(plain(file, left_face(cells))), by_plane);
}

TEST_P(OwnNumbersTest, DisplacementsAndForcesGoByThemToo) {
  run("organ_build", plain(file));
  constexpr std::size_t kCorner = 26;
  const std::string number = std::to_string(cells.node_number(kCorner)),
                    csv = write("i.csv", "node,ux,uy,uz\n" + number + ",0.001,0,-0.002\n"), s = folder / "s";
  run("organ_solve", {organ, "--imposed", csv, "-o", s});
  const Rows u = numbers("s.u.csv"), f = numbers("s.f.csv");
  for (const char* name : {"s.u.csv", "s.f.csv"})
    EXPECT_THAT(test::read_text(folder / name), StartsWith("# numbering: file"));
  ASSERT_EQ(u.size(), cells.positions.size());
  for (std::size_t n = 0; n < u.size(); ++n) EXPECT_EQ(u[n][0], cells.node_number(n));
  EXPECT_NEAR(u[kCorner][3], -0.002, 1e-9);
  EXPECT_EQ(f.at(0)[0], cells.node_number(kCorner));

  const std::string by_position = write("p.csv", "26,0.001,0,-0.002\n"), t = folder / "t";
  run("organ_solve", {organ, "--imposed", by_position, "--numbering", "position", "-o", t});
  const Rows same = numbers("t.u.csv");
  EXPECT_THAT(test::read_text(folder / "t.u.csv"), StartsWith("# numbering: position"));
  for (std::size_t n = 0; n < u.size(); ++n) {
    EXPECT_EQ(same[n][0], n);
    for (const int axis : {1, 2, 3}) EXPECT_EQ(same[n][axis], u[n][axis]);
  }
}

TEST_P(OwnNumbersTest, ANumberThatTheFileDoesNotHaveIsRefused) {
  const std::string absent = std::to_string(cells.node_number(0) + 1 + 1000 * (cells.node_step == 1));
  expect_refused("organ_build", plain(file, write("n.csv", "node\n" + absent + "\n")),
                 "n.csv:2: found '" + absent + "'; expected a node number ");
  run("organ_build", plain(file));
  const std::string s = folder / "s";
  expect_refused("organ_solve", {organ, "--imposed", write("i.csv", absent + ",0.001,0,0\n"), "-o", s},
                 "i.csv:1: found '" + absent + "'; expected a node number ");
}

TEST_P(OwnNumbersTest, MessagesNameElementsAndNodesByThem) {
  cells.cells[5].nodes = cells.cells[4].nodes;
  cells.positions[26].x() = std::numeric_limits<double>::quiet_NaN();
  const std::string kind = GetParam();
  const auto written = [&] {
    if (kind == "TetGen") write("own.ele", test::tetgen_elements(cells));
    return kind == "Gmsh1"   ? write("own.msh", test::gmsh_1(cells))
           : kind == "Gmsh2" ? write("own.msh", test::gmsh_2(cells))
           : kind == "Gmsh4" ? write("own.msh", test::gmsh_4(cells))
           : kind == "Vtk"   ? write("own.vtk", test::vtk_legacy(cells))
           : kind == "Vtu"   ? write("own.vtu", test::vtu({cells}))
                             : write("own.node", test::tetgen_nodes(cells));
  };
  expect_refused("organ_build", plain(written()),
                 "position of node " + std::to_string(cells.node_number(26)) + " is not finite");
  expect_refused("organ_build", with_more(plain(file), {"--numbering", "position"}),
                 "position of node 26 is not finite");
  cells.positions[26] = box.positions[26];
  expect_refused("organ_build", plain(written()),
                 "tetrahedra " + std::to_string(cells.first_cell + 5) + ": repeating");
  expect_refused("organ_build", with_more(plain(file), {"--numbering", "position"}),
                 "tetrahedra 5: repeating");
}

INSTANTIATE_TEST_SUITE_P(Kinds, OwnNumbersTest,
                         testing::Values("Gmsh1", "Gmsh2", "Gmsh4", "TetGen", "Vtk", "Vtu"),
                         [](const auto& info) { return std::string(info.param); });

TEST_F(ForeignFilesTest, AVtkTetrahedronIsNumberedAmongAllCells) {
  test::CellMesh cells = box;
  cells.cells.insert(cells.cells.begin() + 2, 3, {test::kTriangleCell, {0, 1, 3}});
  cells.cells.push_back(cells.cells.back());
  const std::string last = std::to_string(cells.cells.size() - 1);
  expect_refused("organ_build", plain(write("c.vtk", test::vtk_legacy(cells))), "tetrahedra " + last + ":");
  expect_refused("organ_build", with_more(plain(folder / "c.vtk"), {"--numbering", "position"}),
                 "tetrahedra 48:");
  // a partitioned file: the cells of a piece go on from those of the piece before
  expect_refused("organ_build", plain(write("p.vtu", test::vtu({box, cells}))),
                 "tetrahedra " + std::to_string(box.cells.size() + cells.cells.size() - 1) + ":");
}

TEST_F(ForeignFilesTest, AfterMergingTheKeptNodesNumberStands) {
  test::CellMesh cells = box;
  cells.first_node = 300, cells.node_step = -3;
  cells.positions.push_back(cells.positions[13]);
  for (int& node : cells.cells[0].nodes) node = node == 13 ? 27 : node;
  ASSERT_NE(cells.cells[0].nodes, box.cells[0].nodes);
  const std::string file = write("glued.msh", test::gmsh_2(cells)), s = folder / "s";
  const std::string kept = std::to_string(cells.node_number(13)),
                    dropped = std::to_string(cells.node_number(27));
  expect_refused("organ_build", plain(file), "nodes " + kept + " and " + dropped);
  run("organ_build", with_more(plain(file), {"--merge", "1e-6"}));
  const std::string csv = write("i.csv", kept + ",0.001,0,0\n");
  run("organ_solve", {organ, "--imposed", csv, "--model", "direct", "-o", s});
  EXPECT_EQ(numbers("s.f.csv").at(0)[0], cells.node_number(13));
}

TEST_F(ForeignFilesTest, WhatHangsOnANodeIsDroppedOnDemandAndTold) {
  test::CellMesh cells = box;
  const int corner = 26, first = static_cast<int>(cells.positions.size());
  for (const geometry::Vec3& away : {geometry::Vec3(0.002, 0, 0), {0, 0.002, 0}, {0, 0, 0.002}})
    cells.positions.push_back(cells.positions[corner] + away);
  cells.cells.push_back({test::kTetCell, {corner, first, first + 1, first + 2}});
  const std::string file = write("hanging.msh", test::gmsh_2(cells));
  expect_refused("organ_build", plain(file), "touch there in a point");
  EXPECT_FALSE(std::filesystem::exists(organ));
  const std::string told = run("organ_build", with_more(plain(file), {"--repair"}));
  EXPECT_THAT(told, AllOf(HasSubstr("repaired: dropped 1 tetrahedron"), HasSubstr("1.33333 mm^3")));
}

// What one run wrote with one numbering must not be read with the other.
TEST_F(ForeignFilesTest, ATableThatSaysAnotherNumberingIsRefused) {
  run("organ_build", plain(mesh));
  const std::string s = folder / "s";
  expect_refused("organ_solve",
                 {organ, "--imposed", write("i.csv", "# numbering: position\n79,0,0,0.001\n"), "-o", s},
                 "i.csv:2: a comment above says that nodes are numbered by position");
}

}  // namespace
}  // namespace omentum::organ
