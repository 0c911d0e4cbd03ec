// Other people's files: their own numbers, their cells, their tables, their names and compressions.
#include "tests/organ/cell_meshes.h"
#include "tests/organ/organ_programs.h"

#include <sys/stat.h>

namespace omentum::organ {
namespace {

using testing::AllOf;
using testing::Not;
using testing::StartsWith;

class ForeignFilesTest : public OrganProgramsTest {
 protected:
  // As a user calls it, with the file's own numbers.
  std::vector<std::string> plain(const std::string& from, const std::string& fixed = "plane:x<0.001") const {
    return {from,        "-o",   organ.string(), "--young", "3000",    "--poisson", "0.45",
            "--density", "1050", "--scale",      "1",       "--fixed", fixed};
  }
  std::vector<std::string> with_more(std::vector<std::string> arguments,
                                     const std::vector<std::string>& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  std::string run(const std::string& program, const std::vector<std::string>& arguments) const {
    Process process(program, arguments);
    EXPECT_EQ(process.wait(), 0) << process.messages();
    return process.messages();
  }

  std::string hash_after(const std::vector<std::string>& arguments) const {
    run("organ_build", arguments);
    return load_organ(organ, Load::kMeshOnly).hash;
  }

  // A table of the nodes of a mesh with x = 0, by the numbers that its file gives them.
  std::string left_face(const test::CellMesh& cells) const {
    std::string text;
    for (std::size_t n = 0; n < cells.positions.size(); ++n)
      if (cells.positions[n].x() == 0) text += std::to_string(cells.node_number(n)) + "\n";
    return write("left.csv", text);
  }

  const test::CellMesh box = test::cells_of(test::make_raw_box(2, 2, 2, {0.04, 0.04, 0.04}));
};

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

// What a shell hands over as a file: <(seq 1 20).
TEST_F(ForeignFilesTest, ATableMayComeFromAPipe) {
  const std::string pipe = folder / "pipe.csv";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string held;
  for (int n = 1; n <= 76; n += 5) held += std::to_string(n) + "\n";
  const std::string expected = hash_after(plain(mesh, write("left.csv", held)));
  std::filesystem::remove(organ);
  Process process("organ_build", plain(mesh, pipe));
  std::ofstream(pipe) << held;
  EXPECT_EQ(process.wait(), 0) << process.messages();
  EXPECT_EQ(load_organ(organ, Load::kMeshOnly).hash, expected);
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

// A capsule that vanishes makes another organ.
TEST_F(ForeignFilesTest, CellsThatFillSpaceAreRefusedByKindAndCount) {
  const test::CellMesh cells = test::box_under_capsule();
  const std::string files[] = {write("one.msh", test::gmsh_1(cells)),
                               write("two.msh", test::gmsh_2(cells)),
                               write("partitioned.msh", test::gmsh_2(cells, true)),
                               write("four.msh", test::gmsh_4(cells)),
                               write("c.vtk", test::vtk_legacy(cells)),
                               write("c.vtu", test::vtu({cells}))};
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    std::filesystem::remove(organ);
    expect_refused("organ_build", plain(file), "found 8 prisms besides the tetrahedra");
    const std::string told = run("organ_build", with_more(plain(file), {"--ignore-other-cells"}));
    EXPECT_THAT(told, AllOf(HasSubstr("8 prisms"), Not(HasSubstr("triangle")), Not(HasSubstr("line"))));
  }
}

TEST_F(ForeignFilesTest, EveryKindThatFillsSpaceIsNamed) {
  test::CellMesh cells = box;
  const int top = static_cast<int>(cells.positions.size());
  cells.positions.emplace_back(0.01, 0.01, 0.06);
  cells.cells.push_back({test::kPyramidCell, {18, 19, 22, 21, top}});
  expect_refused("organ_build", plain(write("a.msh", test::gmsh_2(cells))), "found 1 pyramid besides");
  cells.cells.push_back({test::kHexCell, {0, 1, 4, 3, 9, 10, 13, 12}});
  expect_refused("organ_build", plain(write("b.vtk", test::vtk_legacy(cells))), "1 hexahedron and 1 pyramid");
  // a second-order hexahedron, a polyhedron, and a type that nobody here knows
  for (const auto& [vtk, named] :
       {std::pair{25, "1 hexahedron"}, {42, "1 polyhedron"}, {99, "an unknown type"}}) {
    test::CellMesh other = box;
    other.cells.push_back({{0, vtk}, {0, 1, 4, 3, 9, 10, 13, 12}});
    expect_refused("organ_build", plain(write("o.vtk", test::vtk_legacy(other))), named);
  }
  test::CellMesh third_order = box;
  third_order.cells.push_back({{92, 0}, std::vector<int>(64, 0)});
  expect_refused("organ_build", plain(write("t.msh", test::gmsh_2(third_order))),
                 "found 1 hexahedron besides");
  // one piece of a partitioned file is enough
  test::CellMesh second = cells;
  for (auto& p : second.positions) p.x() += 0.04;
  expect_refused("organ_build", plain(write("p.vtu", test::vtu({box, second}))),
                 "1 hexahedron and 1 pyramid");
}

TEST_F(ForeignFilesTest, SurfaceLineAndPointCellsAreLeftOutWithoutAWord) {
  test::CellMesh cells = test::box_under_capsule();
  std::erase_if(cells.cells, [](const test::Cell& c) { return c.type.vtk == test::kPrismCell.vtk; });
  cells.positions.resize(27);
  EXPECT_EQ(run("organ_build", plain(write("skin.msh", test::gmsh_2(cells)))).find("warning"),
            std::string::npos);
}

TEST_F(ForeignFilesTest, OfSeveralColumnsTheNamedOneHoldsTheNodes) {
  const std::string by_plane = hash_after(plain(mesh));
  std::string id_first, id_last, quoted;
  for (std::size_t n = 0; n < 5u * 4 * 4; n += 5) {
    const std::string number = std::to_string(n + 1);
    id_first += number + ",0,0,0.5\n";
    id_last += "0,0,0.5," + number + "\n";
    quoted += number + ",1\n";
  }
  EXPECT_EQ(hash_after(plain(mesh, write("a.csv", "id,x,y,z\n" + id_first))), by_plane);
  EXPECT_EQ(hash_after(plain(mesh, write("b.csv", "x,y,z,Node\n" + id_last))), by_plane);
  EXPECT_EQ(hash_after(plain(mesh, write("c.csv", "\"Point ID\",\"Points:0\"\n" + quoted))), by_plane);
  const auto refused = [&](const std::string& text, const std::string& named) {
    expect_refused("organ_build", plain(mesh, write("s.csv", text)), named);
  };
  refused(id_first, "s.csv:1: found 4 columns without a header");
  refused("x,y,z\n1,2,3\n", "s.csv:1: found the header 'x,y,z'; expected one column named node or id");
  refused("id,node\n1,2\n", "s.csv:1: found several in 'id,node'");
  refused("id,x\n1,0\n2\n", "s.csv:3: found 1 fields; expected 2");
  refused("id,x\n1;0,0\n", "s.csv:2: found '1;0'");
}

TEST_F(ForeignFilesTest, AFirstLineThatIsNoKnownHeaderIsAnError) {
  const auto refused = [&](const std::string& text, const std::string& named) {
    expect_refused("organ_build", plain(mesh, write("s.csv", text)), named);
  };
  refused("N10\n11\n", "s.csv:1: found the header 'N10'");
  refused("node\nN10\n", "s.csv:2: found 'N10'");
  refused("supports\n1\n", "'supports'");
  run("organ_build", plain(mesh));
  const std::string s = folder / "s";
  for (const auto& [text, named] : {std::pair{"N80,a,b,c\n80,0,0,0.001\n", "'N80,a,b,c'"},
                                    {"node,dx,dy,dz\n80,0,0,0.001\n", "expected one column named ux (m)"}}) {
    expect_refused("organ_solve", {organ, "--imposed", write("i.csv", text), "-o", s}, named);
  }
}

TEST_F(ForeignFilesTest, DisplacementsAreTakenFromTheNamedColumns) {
  run("organ_build", plain(mesh));
  const std::string s = folder / "s", csv = write("i.csv", "uz,note,ux,id,uy\n-0.002,7,0.001,80,0\n");
  run("organ_solve", {organ, "--imposed", csv, "-o", s});
  const Rows u = numbers("s.u.csv");
  EXPECT_NEAR(u[79][1], 0.001, 1e-9);
  EXPECT_NEAR(u[79][3], -0.002, 1e-9);
}

TEST_F(ForeignFilesTest, CapitalsInNamesMeanTheSame) {
  const std::string expected = hash_after(plain(write("own.msh", test::gmsh_2(box))));
  EXPECT_EQ(hash_after(plain(write("A.MSH", test::gmsh_2(box)))), expected);
  test::CellMesh from_zero = box;
  from_zero.first_node = from_zero.first_cell = 0;
  const std::string vtk = hash_after(plain(write("a.vtk", test::vtk_legacy(from_zero))));
  EXPECT_EQ(hash_after(plain(write("A.VTK", test::vtk_legacy(from_zero)))), vtk);
  EXPECT_EQ(hash_after(plain(write("A.Vtu", test::vtu({from_zero})))), vtk);
  const std::string nodes = write("A.NODE", test::tetgen_nodes(box)),
                    elements = write("A.ELE", test::tetgen_elements(box));
  EXPECT_EQ(hash_after(plain(nodes)), expected);
  EXPECT_EQ(hash_after(plain(elements)), expected);
  write("b.ele", test::tetgen_elements(box));
  EXPECT_EQ(hash_after(plain(write("b.NODE", test::tetgen_nodes(box)))), expected) << "copied one by one";
}

TEST_F(ForeignFilesTest, AMeshBehindAnothersNameIsRead) {
  const std::string gmsh = hash_after(plain(write("own.msh", test::gmsh_2(box))));
  EXPECT_EQ(hash_after(plain(write("wrong.vtk", test::gmsh_2(box)))), gmsh);
  test::CellMesh from_zero = box;
  from_zero.first_node = from_zero.first_cell = 0;
  const std::string vtk = hash_after(plain(write("own.vtk", test::vtk_legacy(from_zero))));
  EXPECT_EQ(hash_after(plain(write("legacy.vtu", test::vtk_legacy(from_zero)))), vtk);
  EXPECT_EQ(hash_after(plain(write("xml.vtk", test::vtu({from_zero})))), vtk);
  EXPECT_EQ(hash_after(plain(write("xml.msh", test::vtu({from_zero})))), vtk);
}

// One line that says what the file is; whatever its name and whoever reads it.
TEST_F(ForeignFilesTest, OtherFormatsAreNamed) {
  using namespace std::string_literals;
  std::string stl(84, ' ');
  stl[80] = 2, stl[81] = stl[82] = stl[83] = '\0';
  stl += std::string(100, '\0');
  const std::pair<std::string, std::string> others[] = {
      {"\x1f\x8b\x08\0\0\0\0\0"s, "gzip"},
      {"PK\x03\x04 zip"s, "zip archive"},
      {"\x89HDF\r\n\x1a\n"s, "HDF5"},
      {"CDF\x01\0\0\0\0"s, "netCDF"},
      {"solid liver\nfacet normal 0 0 1\n", "STL"},
      {stl, "STL"},
      {"# made by hand\nv 0 0 0\nv 1 0 0\n", "OBJ"},
      {"ply\nformat ascii 1.0\n", "PLY"},
      {"<?xml version=\"1.0\"?>\n<dolfin/>\n", "<dolfin>"},
      {"<!DOCTYPE html>\n<html><body>404</body></html>", "web page"},
      {"*Heading\n*Node\n1, 0, 0, 0\n", "Abaqus"},
      {" MeshVersionFormatted 2\n", "MEDIT mesh (gmsh FILE -save -o NAME.msh converts it)"},
      {"(0 \"GAMBIT to Fluent File\")\n(2 3)\n", "Fluent"},
      {"version https://git-lfs.github.com/spec/v1\n", "git lfs"},
      {"\xff\xfe"s + "1\0"s, "UTF-16"}};
  run("organ_build", plain(mesh));
  for (const auto& [content, named] : others) {
    for (const char* name : {"x.msh", "x.vtk", "x.vtu", "x.node"})
      expect_refused("organ_build", plain(write(name, content)), named);
    expect_refused("organ_build", plain(mesh, write("x.csv", content)), named);
    const std::string s = folder / "s", csv = folder / "x.csv";
    expect_refused("organ_solve", {organ, "--imposed", csv, "-o", s}, named);
    if (named != "HDF5")
      expect_refused("organ_solve", {write("x.h5", content), "--imposed", csv, "-o", s}, named);
  }
  expect_refused("organ_solve", {mesh, "--gravity", "0,0,1", "-o", folder / "s"}, "a mesh (organ_build");
}

std::vector<std::string> replaced(std::vector<std::string> arguments, const std::string& option,
                                  const std::string& value) {
  *(std::ranges::find(arguments, option) + 1) = value;
  return arguments;
}

TEST_F(ForeignFilesTest, SizesAndMaterialsThatCanHardlyBeMeantAreSaid) {
  const std::string file = write("own.msh", test::gmsh_2(box));
  const auto said = [&](const std::string& option, const std::string& value) {
    std::filesystem::remove(organ);
    return run("organ_build", replaced(plain(file, "plane:x<1e-6"), option, value));
  };
  EXPECT_THAT(said("--scale", "1"), Not(HasSubstr("warning")));
  EXPECT_THAT(said("--scale", "0.1625"),
              HasSubstr("warning: the organ is 6.5 mm long; organs are 10 mm to 1 m"));
  EXPECT_THAT(said("--scale", "2500"), HasSubstr("warning: the organ is 100 m long"));
  EXPECT_THAT(said("--young", "6"), HasSubstr("warning: Young's modulus is 6 Pa; soft tissue has 100 Pa"));
  EXPECT_THAT(said("--density", "1.06"), HasSubstr("warning: the density is 1.06 kg/m^3; tissue has 100"));
  EXPECT_THAT(said("--poisson", "0.4999"), HasSubstr("warning: Poisson's ratio is 0.4999;"));
}

// The organ may come from a cache, or from somebody else: then only who fits the scene can say it.
TEST_F(ForeignFilesTest, AFittedSceneSaysWhatCanHardlyBeMeant) {
  const std::string file = write("own.msh", test::gmsh_2(box)), fitted = folder / "scene.toml";
  const auto said = [&](const std::string& scale, const std::string& young) {
    std::filesystem::remove(organ);
    run("organ_build", replaced(replaced(plain(file, "plane:x<1e-6"), "--scale", scale), "--young", young));
    return run("scene_prepare",
               {OMENTUM_SOURCE_DIR "/scenes/liver.toml", "--organ", organ.string(), "-o", fitted});
  };
  EXPECT_THAT(said("1", "3000"), Not(HasSubstr("warning")));
  EXPECT_THAT(said("0.1625", "6"),
              AllOf(HasSubstr("warning: the organ is 6.5 mm long; organs are"),
                    HasSubstr("warning: the organ is 6.5 mm long, smaller than the tip of tool 0 (8 mm)"),
                    HasSubstr("warning: Young's modulus is 6 Pa")));
}

}  // namespace
}  // namespace omentum::organ
