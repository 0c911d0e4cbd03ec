// Other people's files: their cells, their tables, their names and compressions.
#include "tests/organ/foreign_files.h"

#include <sys/stat.h>

namespace omentum::organ {
namespace {

using testing::AllOf;
using testing::Not;

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
