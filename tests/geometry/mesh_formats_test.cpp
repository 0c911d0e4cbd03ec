#include "tests/geometry/written_meshes.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace omentum::geometry {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::filesystem::path put(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_mesh(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

class MeshFormats : public testing::TestWithParam<Format> {
 protected:
  test::ScratchFolder folder_;
};

TEST_P(MeshFormats, HoldTheSameMesh) {
  const RawMesh expected = example_mesh();
  const RawMesh read =
      read_mesh(put(folder_ / (std::string("m") + GetParam().extension), GetParam().write(expected)));
  EXPECT_EQ(read.positions, expected.positions);
  EXPECT_EQ(read.tetrahedra, expected.tetrahedra);
  EXPECT_TRUE(read.regions.empty());
  EXPECT_EQ(read.why_no_regions, "");
}

TEST_P(MeshFormats, HoldTheSameLabels) {
  const RawMesh expected = labelled_mesh();
  const RawMesh read =
      read_mesh(put(folder_ / (std::string("m") + GetParam().extension), GetParam().write(expected)));
  EXPECT_EQ(read.tetrahedra, expected.tetrahedra);
  EXPECT_EQ(read.regions, expected.regions) << read.why_no_regions;
}

// Whatever is cut off or overwritten: an InputError that names the file, or a mesh; never a crash or another
// exception.
TEST_P(MeshFormats, DamagedFilesAreRefusedInOneLine) {
  const std::string whole = GetParam().write(labelled_mesh());
  const std::filesystem::path file = folder_ / (std::string("damaged") + GetParam().extension);
  const auto expect_one_line = [&](const std::string& content) {
    const std::string reason = refusal(put(file, content));
    if (reason == "accepted") return;
    EXPECT_THAT(reason, HasSubstr("damaged"));
    EXPECT_EQ(reason.find('\n'), std::string::npos);
  };
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 60)
    expect_one_line(whole.substr(0, size));
  std::uint32_t state = 1;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) {
      state = state * 1664525u + 1013904223u;
      damaged[(state >> 8) % damaged.size()] = static_cast<char>(state >> 3);
    }
    expect_one_line(damaged);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormats, testing::ValuesIn(formats()),
                         [](const auto& info) { return std::string(info.param.name); });

class MeshFiles : public testing::Test {
 protected:
  test::ScratchFolder folder_;
};

TEST_F(MeshFiles, ACompressedArrayOfNothingIsOne) {
  const std::string nothing = "AAAAAA==";  // a header of one word, 0 blocks
  const std::string piece =
      "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><Points><DataArray type=\"Float32\" "
      "format=\"binary\">" +
      nothing + "</DataArray></Points><Cells>";
  std::string arrays;
  for (const char* name : {"connectivity", "offsets", "types"})
    arrays += "<DataArray type=\"Int64\" Name=\"" + std::string(name) + "\" format=\"binary\">" + nothing +
              "</DataArray>";
  EXPECT_THAT(
      refusal(
          put(folder_ / "n.vtu",
              "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>" +
                  piece + arrays + "</Cells></Piece></UnstructuredGrid></VTKFile>")),
      HasSubstr("found no tetrahedra"));
}

TEST_F(MeshFiles, TetgenCountsFromZeroOrOneAndIsFoundByEitherName) {
  const RawMesh expected = example_mesh();
  for (const int first : {0, 1}) {
    Bytes nodes, elements;
    nodes.text("# a comment\n", expected.positions.size(), "3 1 1\n");
    for (std::size_t i = 0; i < expected.positions.size(); ++i) {
      const Vec3& p = expected.positions[i];
      nodes.text(i + static_cast<std::size_t>(first), p.x(), p.y(), p.z(), "0.5 1 # attribute, marker\n");
    }
    elements.text(expected.tetrahedra.size(), "4 1\n\n");
    for (std::size_t t = 0; t < expected.tetrahedra.size(); ++t) {
      const auto& v = expected.tetrahedra[t];
      elements.text(t + static_cast<std::size_t>(first), v[0] + first, v[1] + first, v[2] + first,
                    v[3] + first, "7\n");
    }
    const auto node_file = put(folder_ / "m.node", nodes.content),
               element_file = put(folder_ / "m.ele", elements.content);
    for (const auto& file : {node_file, element_file}) {
      const RawMesh read = read_mesh(file);
      EXPECT_EQ(read.positions, expected.positions);
      EXPECT_EQ(read.tetrahedra, expected.tetrahedra);
      EXPECT_EQ(read.regions, std::vector<std::int32_t>(expected.tetrahedra.size(), 7));
    }
  }
}

TEST_F(MeshFiles, WrittenMeshesComeBackBitForBit) {
  TetraMesh mesh = test::make_box_mesh(3, 2, 2, {1, 1, 1});
  for (Vec3& p : mesh.positions) p = p / 3 + Vec3(1e-17, 0.1, -1e8);
  write_mesh(mesh, folder_ / "m.msh");
  const RawMesh read = read_mesh(folder_ / "m.msh");
  EXPECT_EQ(read.positions, mesh.positions);
  ASSERT_EQ(read.tetrahedra.size(), mesh.tetrahedra.size());
  for (std::size_t t = 0; t < read.tetrahedra.size(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(read.tetrahedra[t][i], mesh.tetrahedra[t][i]);
  }
}

TEST_F(MeshFiles, WritingWhereNothingCanBeWrittenIsAnError) {
  const auto reason = [](const std::filesystem::path& file) -> std::string {
    try {
      write_mesh(test::make_box_mesh(1, 1, 1, {1, 1, 1}), file);
      return "written";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(reason(folder_ / "nowhere/m.msh"),
              HasSubstr("m.msh: cannot be written: No such file or directory"));
  EXPECT_THAT(reason("/dev/full"), HasSubstr("cannot be written: No space left on device"));
}

// Results and messages go by it.
TEST_F(MeshFiles, ATetrahedronsNumberIsItsOwn) {
  constexpr const char* kPoints = "5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
  const std::string nodes = std::string("$Nodes\n") + kPoints + "$EndNodes\n";
  const std::string said = "found tetrahedron number 7 twice, expected each once";
  EXPECT_THAT(refusal(put(folder_ / "one.msh",
                          std::string("$NOD\n") + kPoints +
                              "$ENDNOD\n$ELM\n2\n7 4 1 1 4 1 2 3 4\n7 4 1 1 4 2 3 4 5\n$ENDELM\n")),
              HasSubstr("one.msh:12: " + said));
  const std::string two = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes + "$Elements\n2\n";
  EXPECT_THAT(refusal(put(folder_ / "two.msh", two + "7 4 2 1 1 1 2 3 4\n7 4 2 1 1 2 3 4 5\n$EndElements\n")),
              HasSubstr("two.msh:15: " + said));
  const std::string four =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n"
      "0 0 1\n1 1 1\n$EndNodes\n$Elements\n2 2 7 7\n";
  EXPECT_THAT(
      refusal(put(folder_ / "four.msh", four + "3 1 4 1\n7 1 2 3 4\n3 2 4 1\n7 2 3 4 5\n$EndElements\n")),
      HasSubstr("four.msh:23: " + said));
  put(folder_ / "t.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n");
  EXPECT_THAT(refusal(put(folder_ / "t.ele", "2 4 0\n7 1 2 3 4\n7 2 3 4 5\n")),
              HasSubstr("t.ele:3: " + said));
  // some writers count each kind of element from 1
  EXPECT_EQ(read_mesh(put(folder_ / "kinds.msh", two + "7 2 2 1 1 1 2 3\n7 4 2 1 1 2 3 4 5\n$EndElements\n"))
                .tetrahedra.size(),
            1u);
}

TEST_F(MeshFiles, MessagesNameFileLineAndExpectation) {
  EXPECT_THAT(refusal(folder_ / "absent.msh"), AllOf(HasSubstr("absent.msh"), HasSubstr("no such file")));
  EXPECT_THAT(refusal(put(folder_ / "mesh.stl", "facets\n")),
              HasSubstr("expected .msh, .vtk, .vtu, .node or .ele"));
  EXPECT_THAT(refusal(put(folder_ / "x.msh", "$NOD\n2\n1 0 0 0\n2 0 zero 0\n$ENDNOD\n")),
              HasSubstr("x.msh:4: found 'zero', expected y of a node"));
  EXPECT_THAT(
      refusal(put(folder_ / "e.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 4 1 1 4 1 1 1 99\n$ENDELM\n")),
      AllOf(HasSubstr("e.msh:7"), HasSubstr("node number 99 in tetrahedron 1")));
  EXPECT_THAT(refusal(put(folder_ / "t.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n")),
              HasSubstr("found no tetrahedra"));
  EXPECT_THAT(refusal(put(folder_ / "v.msh", "$MeshFormat\n3 0 8\n")),
              HasSubstr("expected version 2.x or 4.x"));
  EXPECT_THAT(refusal(put(folder_ / "twice.msh", "$NOD\n2\n1 0 0 0\n1 0 0 0\n$ENDNOD\n")),
              HasSubstr("node number 1 twice"));
  EXPECT_THAT(refusal(put(folder_ / "p.vtk", "# vtk DataFile Version 2.0\nx\nASCII\nDATASET POLYDATA\n")),
              HasSubstr("p.vtk:4: found POLYDATA (a surface), expected UNSTRUCTURED_GRID"));
  EXPECT_THAT(refusal(put(folder_ / "x.vtu", "<VTKFile type=\"UnstructuredGrid\"")),
              HasSubstr("well-formed XML"));
  put(folder_ / "half.node", "1 3 0 0\n1 0 0 0\n");
  EXPECT_THAT(refusal(folder_ / "half.node"), AllOf(HasSubstr("half.ele"), HasSubstr("no such file")));
}

}  // namespace
}  // namespace omentum::geometry
