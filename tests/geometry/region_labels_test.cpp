// Which labels of a mesh file count, what happens where it has several answers, and that they stay with their
// tetrahedra.
#include "geometry/region_labels.h"
#include "tests/geometry/written_meshes.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace omentum::geometry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RegionLabels : public testing::Test {
 protected:
  RawMesh read(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return read_mesh(folder_ / name);
  }
  // A tetrahedron pair in legacy VTK with `data` behind it.
  RawMesh read_vtk(const std::string& data) {
    return read(
        "m.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0 "
        "0 1 0 0 0 1 1 1 1\nCELLS 3 13\n4 0 1 2 3\n2 0 1\n4 1 2 3 4\nCELL_TYPES 3\n10\n3\n10\n" +
            data);
  }
  RawMesh read_vtu(const std::string& arrays) {
    return read(
        "m.vtu",
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"5\" "
        "NumberOfCells=\"2\"><CellData>" +
            arrays +
            "</CellData><Points><DataArray type=\"Float32\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1 1 "
            "1 1</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" "
            "format=\"ascii\">0 1 2 3 1 2 3 4</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
            "format=\"ascii\">4 8</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
            "format=\"ascii\">10 10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
  }
  RawMesh read_tetgen(const std::string& elements) {
    std::ofstream(folder_ / "m.node") << "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
    return read("m.ele", elements);
  }

  test::ScratchFolder folder_;
};

TEST_F(RegionLabels, NamesOfArraysThatCount) {
  for (const char* name : {"label", "Labels", "REGION", "region_id", "Region Ids", "material", "MaterialIds",
                           "gmsh:physical", "medit:ref", "CellEntityIds"})
    EXPECT_TRUE(is_label_name(name)) << name;
  for (const char* name :
       {"", "labelled", "gmsh:geometrical", "id", "part", "young_pa", "materials_of_youth"})
    EXPECT_FALSE(is_label_name(name)) << name;
}

TEST_F(RegionLabels, OfCellsThatAreNoTetrahedraAreLeftOut) {
  EXPECT_THAT(read_vtk("CELL_DATA 3\nSCALARS region int 1\nLOOKUP_TABLE default\n3 4 -5\n").regions,
              ElementsAre(3, -5));
}

TEST_F(RegionLabels, ArraysOfPointsOfOtherNamesAndOfSeveralComponentsDoNotCount) {
  const RawMesh mesh = read_vtk(
      "POINT_DATA 5\nSCALARS region int\nLOOKUP_TABLE default\n1 2 3 4 5\nCELL_DATA 3\nFIELD f 2\nlabel 2 3 "
      "int\n"
      "1 2 3 4 5 6\nquality 1 3 int\n1 2 3\n");
  EXPECT_TRUE(mesh.regions.empty());
  EXPECT_EQ(mesh.why_no_regions, "");
}

TEST_F(RegionLabels, TwoArraysOfLabelsGiveNoneAndSaySo) {
  const RawMesh legacy = read_vtk("CELL_DATA 3\nFIELD f 2\nlabel 1 3 int\n1 2 3\nmaterial 1 3 int\n1 1 2\n");
  EXPECT_TRUE(legacy.regions.empty());
  EXPECT_EQ(legacy.why_no_regions, "the arrays 'label' and 'material' both give labels, expected one");
  const std::string array = "type=\"Int32\" format=\"ascii\">1 2</DataArray>";
  EXPECT_THAT(
      read_vtu("<DataArray Name=\"region\" " + array + "<DataArray Name=\"Label\" " + array).why_no_regions,
      HasSubstr("'region' and 'Label' both give labels"));
}

TEST_F(RegionLabels, WhatIsNoWholeNumberGivesNoneAndSaysSo) {
  const RawMesh mesh = read_vtk("CELL_DATA 3\nSCALARS region float\nLOOKUP_TABLE default\n1 2 2.5\n");
  EXPECT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_TRUE(mesh.regions.empty());
  EXPECT_THAT(mesh.why_no_regions, HasSubstr("'region', expected whole numbers"));
  EXPECT_THAT(read_vtu("<DataArray Name=\"region\" type=\"Int64\" format=\"ascii\">1 9999999999</DataArray>")
                  .why_no_regions,
              HasSubstr("more than 32 bits"));
  EXPECT_THAT(
      read_vtu("<DataArray Name=\"region\" type=\"Int32\" format=\"ascii\">1</DataArray>").why_no_regions,
      HasSubstr("found 1 values of array 'region', expected one for each cell"));
}

// Until now nobody looked there.
TEST_F(RegionLabels, WhateverStandsBehindAMeshTheMeshIsRead) {
  for (const char* data :
       {"CELL_DATA 3\nSCALARS x", "TEXTURE 3\n", "CELL_DATA -3\n", "CELL_DATA 3\nFIELD a 9999999\n"}) {
    const RawMesh mesh = read_vtk(data);
    EXPECT_EQ(mesh.tetrahedra.size(), 2u) << data;
    EXPECT_NE(mesh.why_no_regions, "") << data;
  }
  EXPECT_EQ(
      read_vtk("CELL_DATA 3\nSCALARS region int\nLOOKUP_TABLE default\n1 2 3\nTEXTURE\n").regions.size(), 2u);
}

TEST_F(RegionLabels, TetgensRegionIsTheLastAttribute) {
  EXPECT_THAT(read_tetgen("2 4 2\n1 1 2 3 4 0.5 2 # a comment\n2 2 3 4 5 0.25 -1.0\n").regions,
              ElementsAre(2, -1));
  EXPECT_TRUE(read_tetgen("2 4 0\n1 1 2 3 4\n2 2 3 4 5\n").regions.empty());
  EXPECT_EQ(read_tetgen("2 4 1\n1 1 2 3 4 1\n2 2 3 4 5 0.5\n").why_no_regions,
            "the last attribute of tetrahedron 2 is no whole number");
}

TEST_F(RegionLabels, AVolumeInTwoPhysicalGroupsHasNone) {
  const std::string file =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 2 3 8 "
      "0\n$EndEntities\n$Nodes\n1 4 1 "
      "4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 "
      "4\n$EndElements\n";
  EXPECT_EQ(read("g.msh", file).why_no_regions,
            "volume 1 is in physical groups 3 and 8, expected one for each tetrahedron");
}

// Tetrahedra are reordered, and nodes dropped and merged: each label stays with its tetrahedron.
TEST_F(RegionLabels, StayWithTheirTetrahedraThroughTheCheck) {
  RawMesh raw = test::make_raw_box(2, 1, 1, {0.02, 0.01, 0.01});
  raw.positions.insert(raw.positions.begin(), Vec3(9, 9, 9));  // used by none
  for (auto& t : raw.tetrahedra) {
    for (std::int32_t& node : t) ++node;
  }
  std::swap(raw.tetrahedra[3][0], raw.tetrahedra[3][1]);
  // a copy of one of its nodes takes that one's place in the last
  raw.positions.push_back(raw.positions[static_cast<std::size_t>(raw.tetrahedra.back()[0])]);
  raw.tetrahedra.back()[0] = static_cast<std::int32_t>(raw.positions.size()) - 1;
  for (std::size_t t = 0; t < raw.tetrahedra.size(); ++t)
    raw.regions.push_back(static_cast<std::int32_t>(t) - 2);
  CheckOptions options;
  options.merge_m = 1e-6;
  const TetraMesh mesh = check_mesh(raw, 1, options).mesh;
  ASSERT_EQ(mesh.tetrahedra.size(), raw.tetrahedra.size());
  EXPECT_EQ(mesh.regions, raw.regions);
  const auto centroid = [](const auto& positions, const auto& t) {
    return Vec3(positions[t[0]] + positions[t[1]] + positions[t[2]] + positions[t[3]]);
  };
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    EXPECT_LE(
        (centroid(mesh.positions, mesh.tetrahedra[t]) - centroid(raw.positions, raw.tetrahedra[t])).norm(),
        1e-15);
}

TEST_F(RegionLabels, ComeBackFromAWrittenMesh) {
  TetraMesh mesh = test::make_box_mesh(1, 1, 1, {1, 1, 1});
  mesh.regions = {0, 1, 2, 2, 5, -3};
  write_mesh(mesh, folder_ / "m.msh");
  EXPECT_EQ(read_mesh(folder_ / "m.msh").regions, mesh.regions);
}

}  // namespace
}  // namespace omentum::geometry
