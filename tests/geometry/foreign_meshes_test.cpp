// Meshes as other people's programs write them: elements that are no tetrahedra of four nodes, marks and
// numbers that nobody here would write.
#include "geometry/tetra_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <map>

namespace omentum::geometry {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ForeignMeshes : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  static std::string refusal(const std::filesystem::path& file) {
    try {
      read_mesh(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  // A mesh, its checks passed, and nothing read that is not in the file.
  static void expect_box_of_corners(const std::filesystem::path& file, const RawMesh& box) {
    SCOPED_TRACE(file);
    const RawMesh raw = read_mesh(file);
    EXPECT_EQ(raw.tetrahedra, box.tetrahedra);
    EXPECT_EQ(raw.curved, box.tetrahedra.size());
    const CheckedMesh checked = check_mesh(raw, 1);
    EXPECT_EQ(checked.mesh.positions, box.positions);
    ASSERT_EQ(checked.warnings.size(), 2u);
    EXPECT_THAT(checked.warnings[0],
                HasSubstr(std::to_string(box.tetrahedra.size()) + " tetrahedra have more than four nodes"));
    EXPECT_THAT(checked.warnings[1], HasSubstr("belong to no tetrahedron"));
  }

  test::ScratchFolder folder_;
};

// A box whose tetrahedra have a node in the middle of each edge, behind the corners, as both formats list
// them.
struct CurvedBox {
  RawMesh corners = test::make_raw_box(2, 1, 1, {0.5, 0.25, 0.25});
  std::vector<Vec3> positions = corners.positions;
  std::vector<std::array<std::int32_t, 10>> tetrahedra;

  CurvedBox() {
    constexpr std::array<std::array<int, 2>, 6> kEdges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    for (const auto& t : corners.tetrahedra) {
      std::array<std::int32_t, 10> nodes{t[0], t[1], t[2], t[3]};
      for (std::size_t e = 0; e < kEdges.size(); ++e) {
        const auto key = std::minmax(t[kEdges[e][0]], t[kEdges[e][1]]);
        const auto [found, made] =
            middle.try_emplace({key.first, key.second}, static_cast<std::int32_t>(positions.size()));
        if (made) positions.push_back((positions[key.first] + positions[key.second]) / 2);
        nodes[4 + e] = found->second;
      }
      tetrahedra.push_back(nodes);
    }
  }
};

std::string lines_of(const std::vector<Vec3>& positions, bool numbered) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (numbered) out << i + 1 << ' ';
    out << positions[i].transpose() << '\n';
  }
  return std::move(out).str();
}

TEST_F(ForeignMeshes, OfTenNodeTetrahedraTheCornersAreReadAndCounted) {
  const CurvedBox box;
  const std::size_t cells = box.tetrahedra.size();
  std::ostringstream gmsh, vtk, elements;
  gmsh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
       << box.positions.size() << '\n'
       << lines_of(box.positions, true) << "$EndNodes\n$Elements\n"
       << cells << '\n';
  vtk << "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << box.positions.size()
      << " double\n"
      << lines_of(box.positions, false) << "CELLS " << cells << ' ' << 11 * cells << '\n';
  elements << cells << " 10 0\n";
  for (std::size_t t = 0; t < cells; ++t) {
    gmsh << t + 1 << " 11 2 1 1";
    vtk << "10";
    elements << t + 1;
    for (const std::int32_t v : box.tetrahedra[t]) {
      gmsh << ' ' << v + 1;
      vtk << ' ' << v;
      elements << ' ' << v + 1;
    }
    gmsh << '\n', vtk << '\n', elements << '\n';
  }
  gmsh << "$EndElements\n";
  vtk << "CELL_TYPES " << cells << '\n';
  for (std::size_t t = 0; t < cells; ++t) vtk << "24\n";
  put("m.node", std::to_string(box.positions.size()) + " 3 0 0\n" + lines_of(box.positions, true));
  expect_box_of_corners(put("m.msh", gmsh.str()), box.corners);
  expect_box_of_corners(put("m.vtk", vtk.str()), box.corners);
  expect_box_of_corners(put("m.ele", elements.str()), box.corners);
}

TEST_F(ForeignMeshes, AByteOrderMarkIsPassedOver) {
  const std::string mark = "\xEF\xBB\xBF";
  const RawMesh box = test::make_raw_box(1, 1, 1, {1, 1, 1});
  const auto plain = folder_ / "m.msh";
  write_mesh(check_mesh(box, 1).mesh, plain);
  EXPECT_EQ(read_mesh(put("marked.msh", mark + test::read_text(plain))).positions, box.positions);
  const std::string points = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  put("m.node", mark + points);
  EXPECT_EQ(read_mesh(put("m.ele", mark + "1 4 0\n1 1 2 3 4\n")).tetrahedra.size(), 1u);
  EXPECT_EQ(read_mesh(put("m.vtk", mark + "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                          "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\n"
                                          "CELL_TYPES 1\n10\n"))
                .tetrahedra.size(),
            1u);
}

TEST_F(ForeignMeshes, ContentsSpeakWhateverTheNameIs) {
  const RawMesh box = test::make_raw_box(1, 1, 1, {1, 1, 1});
  write_mesh(check_mesh(box, 1).mesh, folder_ / "m.msh");
  const std::string gmsh = test::read_text(folder_ / "m.msh");
  for (const char* name : {"liver.mesh", "liver", "liver.2", "liver.txt"})
    EXPECT_EQ(read_mesh(put(name, gmsh)).positions, box.positions) << name;
  for (const char* medit :
       {" MeshVersionFormatted 2\n Dimension\n 3\n", "# made by hand\nMeshVersionFormatted 1\n"}) {
    for (const char* name : {"liver.mesh", "liver", "liver.msh"})
      EXPECT_THAT(refusal(put(name, medit)),
                  AllOf(HasSubstr(std::string(name) + ": found a MEDIT mesh (gmsh"),
                        HasSubstr("expected a mesh of")));
  }
  EXPECT_THAT(refusal(put("liver", "4\n0 0 0\n")),
              HasSubstr("found no extension and contents of no known kind, expected .msh, .vtk"));
  EXPECT_THAT(refusal(put("liver.mesh", "4\n0 0 0\n")), HasSubstr("found the extension '.mesh' and"));
}

const std::string kEightNodes =
    "$NOD\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$ENDNOD\n";

TEST_F(ForeignMeshes, WithoutTetrahedraTheMessageSaysWhatThereIs) {
  EXPECT_THAT(refusal(put("hex.msh", kEightNodes + "$ELM\n3\n1 5 1 1 8 1 2 3 4 5 6 7 8\n2 3 1 1 4 1 2 3 4\n"
                                                   "3 3 1 1 4 5 6 7 8\n$ENDELM\n")),
              HasSubstr("found no tetrahedra, but 1 hexahedron and 2 quadrangles"));
  EXPECT_THAT(refusal(put("surface.vtk",
                          "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                          "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 8\n3 0 1 2\n3 0 1 3\n"
                          "CELL_TYPES 2\n5\n5\n")),
              HasSubstr("found no tetrahedra, but 2 triangles"));
  EXPECT_THAT(refusal(put("poly.vtk", "# vtk DataFile Version 2.0\nx\nASCII\nDATASET POLYDATA\n")),
              HasSubstr("a surface"));
  // what Gmsh leaves where it cannot write the version that was asked for
  EXPECT_THAT(refusal(put("empty.msh", "")), HasSubstr("empty.msh: is empty"));
  EXPECT_THAT(refusal(put("empty.vtu", "")), HasSubstr("empty.vtu: is empty"));
}

TEST_F(ForeignMeshes, SolidElementsBesideTheTetrahedraAreRefusedUnlessTheyAreToBeIgnored) {
  const RawMesh raw =
      read_mesh(put("mixed.msh", kEightNodes + "$ELM\n3\n1 4 1 1 4 1 2 3 6\n2 6 1 1 6 1 3 4 5 7 8\n"
                                               "3 2 1 1 3 1 2 3\n$ENDELM\n"));
  try {
    check_mesh(raw, 1);
    FAIL() << "a prism must not vanish";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("found 1 prism besides the tetrahedra"));
  }
  EXPECT_THAT(check_mesh(raw, 1, {.ignore_other_cells = true}).warnings,
              ElementsAre(AllOf(HasSubstr("not read"), HasSubstr("1 prism")),
                          HasSubstr("4 nodes belong to no tetrahedron")));
}

// Numbers that a reader's arithmetic would overflow on, or that are none.
TEST_F(ForeignMeshes, NumbersBeyondAllIndicesAreRefused) {
  constexpr const char* kSmallest = "-9223372036854775808";
  constexpr const char* kLargest = "9223372036854775807";
  const std::string points = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  put("m.node", points);
  for (const char* number : {kSmallest, kLargest, "0", "5"}) {
    EXPECT_THAT(refusal(put("m.ele", "1 4 0\n1 1 2 3 " + std::string(number) + "\n")),
                HasSubstr(std::string("node number ") + number));
  }
  for (const char* first : {kSmallest, kLargest, "-1"}) {
    put("f.node", "2 3 0 0\n" + std::string(first) + " 0 0 0\n2 0 0 0\n");
    EXPECT_THAT(refusal(put("f.ele", "1 4 0\n1 1 2 3 4\n")), HasSubstr("expected 0 or 1"));
  }
  // 2^32 + 4, which is a tetrahedron's type in its lower half
  EXPECT_THAT(refusal(put("t.msh", kEightNodes + "$ELM\n1\n1 4294967300 1 1 4 1 2 3 4\n$ENDELM\n")),
              HasSubstr("element type 4294967300"));
  EXPECT_THAT(refusal(put("v.msh", "$MeshFormat\nnan 0 8\n$EndMeshFormat\n")), HasSubstr("expected version"));
}

std::string vtu_of(const std::string& connectivity, const std::string& offsets) {
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
         "format=\"ascii\">"
         "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>" +
         connectivity + offsets +
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells></Piece>"
         "</UnstructuredGrid></VTKFile>";
}

std::string array_of(const std::string& name, const std::string& type, const std::string& format,
                     const std::string& content) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" + format + "\">" + content +
         "</DataArray>";
}

TEST_F(ForeignMeshes, AVtuWhoseIndicesAreNoIndicesIsRefused) {
  const std::string nodes = array_of("connectivity", "Int64", "ascii", "0 1 2 3"),
                    ends = array_of("offsets", "Int64", "ascii", "4");
  EXPECT_EQ(refusal(put("good.vtu", vtu_of(nodes, ends))), "accepted");
  // base64 of four floats behind a count of 16 bytes: 0, 1, 2 and then a NaN, 1e30, 2.5
  for (const char* floats :
       {"EAAAAAAAAAAAAIA/AAAAQAAAwH8=", "EAAAAAAAAAAAAIA/AAAAQMrySXE=", "EAAAAAAAAAAAAIA/AAAAQAAAIEA="}) {
    EXPECT_THAT(refusal(put("real.vtu", vtu_of(array_of("connectivity", "Float32", "binary", floats), ends))),
                HasSubstr("expected whole numbers"))
        << floats;
  }
  for (const char* end : {"-9223372036854775808", "9223372036854775807", "3", "5", "-1"}) {
    EXPECT_THAT(refusal(put("end.vtu", vtu_of(nodes, array_of("offsets", "Int64", "ascii", end)))),
                HasSubstr("has not the nodes"));
  }
}

}  // namespace
}  // namespace omentum::geometry
