#include "organ/organ_writer.h"
#include "organ/stored_tensors.h"
#include "organ_file_fixture.h"
#include "physics/direct_solve.h"

namespace omentum::organ {
namespace {

TEST_F(OrganFileTest, RoundTripKeepsEverything) {
  const Organ made = small_organ();
  const Organ found = build(made);

  EXPECT_EQ(found.name, "box");
  EXPECT_EQ(found.hash, made.hash);
  EXPECT_EQ(found.mesh.positions, made.mesh.positions);
  EXPECT_EQ(found.mesh.tetrahedra, made.mesh.tetrahedra);
  EXPECT_EQ(found.mesh.file_node, made.mesh.file_node);
  EXPECT_EQ(found.mesh.file_node_count, made.mesh.file_node_count);
  EXPECT_EQ(found.mesh.node_numbers, made.mesh.node_numbers);
  EXPECT_EQ(found.mesh.tetrahedron_numbers, made.mesh.tetrahedron_numbers);
  EXPECT_EQ(found.surface.node, made.surface.node);
  EXPECT_EQ(found.surface.of_node, made.surface.of_node);
  EXPECT_EQ(found.surface.triangles, made.surface.triangles);
  EXPECT_EQ(found.surface.tetrahedron, made.surface.tetrahedron);
  EXPECT_EQ(found.surface.fan_start, made.surface.fan_start);
  EXPECT_EQ(found.surface.fan, made.surface.fan);
  EXPECT_EQ(found.surface.mobile_count, made.surface.mobile_count);
  EXPECT_EQ(found.material.common.young_pa, made.material.common.young_pa);
  EXPECT_EQ(found.material.common.poisson, made.material.common.poisson);
  EXPECT_EQ(found.material.common.density_kg_m3, made.material.common.density_kg_m3);
  EXPECT_EQ(found.fixed, made.fixed);
}

TEST_F(OrganFileTest, RegionsComeBackAndBelongToTheHash) {
  const Organ made = two_materials();
  const Organ found = build(made);
  EXPECT_EQ(found.mesh.regions, made.mesh.regions);
  ASSERT_EQ(found.material.regions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found.material.regions[i].label, made.material.regions[i].label);
    EXPECT_EQ(found.material.regions[i].material.young_pa, made.material.regions[i].material.young_pa);
    EXPECT_EQ(found.material.regions[i].material.poisson, made.material.regions[i].material.poisson);
    EXPECT_EQ(found.material.regions[i].material.density_kg_m3,
              made.material.regions[i].material.density_kg_m3);
  }
  Organ other = made;
  other.mesh.regions.back() = 2;
  EXPECT_NE(organ_hash(other), made.hash);
  other = made;
  other.material.regions[0].material.density_kg_m3 = 2001;
  EXPECT_NE(organ_hash(other), made.hash);
  other = made;
  other.material.regions[1].label = 8;
  EXPECT_NE(organ_hash(other), made.hash);
}

// Files from before there were regions, and those of meshes whose labels nobody uses, stay what they were.
TEST_F(OrganFileTest, LabelsWithoutMaterialsChangeNothing) {
  const Organ plain = small_organ();
  EXPECT_EQ(plain.hash, "386f942a5f865d856838609b977ba7a383db74ff45fd52ac3aca05cdf51a5548");
  geometry::TetraMesh labelled = plain.mesh;
  labelled.regions.assign(labelled.tetrahedra.size(), 3);
  const Organ made = make_organ("box", std::move(labelled), kTissue, plain.fixed, Storage::kFloat);
  EXPECT_EQ(made.hash, plain.hash);
  build(made);
  damage([](hid_t hdf5) {
    EXPECT_EQ(H5Lexists(hdf5, layout::kRegions, H5P_DEFAULT), 0);
    EXPECT_EQ(H5Lexists(hdf5, "material", H5P_DEFAULT), 0);
  });
}

TEST_F(OrganFileTest, MappedTensorsAreTheComplianceOfAllItsMaterials) {
  const Organ organ = build(two_materials());
  const auto K = physics::assemble_stiffness(organ.mesh, organ.material);
  std::vector<geometry::Vec3> push(organ.mesh.positions.size(), geometry::Vec3::Zero());
  push[organ.surface.node[5]] = {0, 1, 0};
  const auto u = physics::direct_solve(K, organ.fixed, {}, push).displacements;
  for (int n = 0; n < organ.surface.mobile_count; ++n) {
    const geometry::Vec3 column = organ.compliance->block(SurfaceId(n), SurfaceId(5)).col(1);
    EXPECT_LE((column - u[organ.surface.node[n]]).norm(), 1e-6 * u[organ.surface.node[5]].norm());
  }
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(organ.compliance->tile(SurfaceId(0), 0)) % 64, 0u);
}

TEST_F(OrganFileTest, TensorsOutliveTheirReader) {
  std::optional<physics::SurfaceCompliance> kept;
  {
    const Organ organ = build(small_organ());
    kept = organ.compliance;
  }
  std::filesystem::remove(file);
  EXPECT_GT(kept->block(SurfaceId(3), SurfaceId(3)).trace(), 0);
}

TEST_F(OrganFileTest, DoubleStorageLoadsAsFloatForTheNodes) {
  const Organ single = build(small_organ());
  const Organ twofold = build(small_organ(kTissue, Storage::kDouble));
  EXPECT_EQ(twofold.storage, Storage::kDouble);
  EXPECT_EQ(map_tensors(file, twofold).twofold.mobile_count, twofold.surface.mobile_count);
  for (int n = 0; n < single.surface.mobile_count; ++n) {
    const Eigen::Matrix3d a = single.compliance->block(SurfaceId(n), SurfaceId(4));
    const Eigen::Matrix3d b = twofold.compliance->block(SurfaceId(n), SurfaceId(4));
    EXPECT_LE((a - b).norm(), 1e-6 * a.norm());
  }
}

TEST_F(OrganFileTest, MeshOnlyLeavesTensorsOut) {
  build(small_organ());
  EXPECT_FALSE(load_organ(file, Load::kMeshOnly).compliance.has_value());
}

TEST_F(OrganFileTest, SurfaceOfFileNodeInvertsNumbers) {
  const Organ organ = build(small_organ());
  const std::vector<SurfaceId> of_file = organ.surface_of_file_node();
  ASSERT_EQ(of_file.size(), static_cast<std::size_t>(organ.mesh.file_node_count));
  int found = 0;
  for (std::size_t f = 0; f < of_file.size(); ++f) {
    if (!of_file[f].valid()) continue;
    ++found;
    EXPECT_EQ(organ.mesh.file_node[organ.surface.node[of_file[f]]], static_cast<int>(f));
  }
  EXPECT_EQ(found, organ.surface.node_count());
}

TEST_F(OrganFileTest, MergedNodesAreKeptWithThoseThatTookTheirPlaces) {
  Organ made = small_organ();
  const std::int32_t twin = made.mesh.file_node_count++;
  made.mesh.node_numbers.push_back(1000);
  const std::int32_t kept = made.mesh.file_node[made.surface.node[4]];
  made.mesh.merged = {{twin, kept}};
  EXPECT_NE(organ_hash(made), made.hash);
  made.hash = organ_hash(made);
  const Organ found = build(made);
  ASSERT_EQ(found.mesh.merged.size(), 1U);
  EXPECT_EQ(found.mesh.merged[0].dropped, twin);
  EXPECT_EQ(found.mesh.merged[0].kept, kept);
  EXPECT_EQ(found.mesh.nodes_of_file()[twin], found.surface.node[4]);
  EXPECT_EQ(found.surface_of_file_node()[twin], SurfaceId(4));
}

TEST_F(OrganFileTest, HashChangesWithEverythingTheTensorsDependOn) {
  const std::string hash = small_organ().hash;
  EXPECT_EQ(small_organ().hash, hash);
  EXPECT_NE(small_organ({3001, 0.45, 1050}).hash, hash);
  EXPECT_NE(small_organ({3000, 0.451, 1050}).hash, hash);
  EXPECT_NE(small_organ({3000, 0.45, 1051}).hash, hash);
  EXPECT_NE(small_organ(kTissue, Storage::kDouble).hash, hash);
  EXPECT_NE(small_organ(kTissue, Storage::kFloat, {0.06, 0.04, 0.0400001}).hash, hash);
  Organ other = small_organ();
  other.fixed[20] = 1;
  EXPECT_NE(organ_hash(other), hash);
  other = small_organ();
  std::swap(other.mesh.file_node[0], other.mesh.file_node[1]);
  EXPECT_NE(organ_hash(other), hash);
  for (const bool nodes : {false, true}) {
    other = small_organ();
    (nodes ? other.mesh.node_numbers : other.mesh.tetrahedron_numbers)[3] += 100;
    EXPECT_NE(organ_hash(other), hash) << "programs print them";
  }
}

TEST_F(OrganFileTest, UpToDateFileIsLeftAndAChangedOrganIsNot) {
  build(small_organ());
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_TRUE(build_organ(small_organ(), file, {}).up_to_date);
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_FALSE(build_organ(small_organ({2000, 0.4, 1000}), file, {}).up_to_date);
  EXPECT_EQ(load_organ(file, Load::kMeshOnly).material.common.young_pa, 2000);
  BuildOptions force;
  force.force = true;
  EXPECT_FALSE(build_organ(small_organ({2000, 0.4, 1000}), file, force).up_to_date);
}

TEST_F(OrganFileTest, AbandonedWriterLeavesNothing) {
  { const OrganWriter writer(file, small_organ()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(OrganFileTest, SecondWriterOfTheSameFileIsRefused) {
  const OrganWriter first(file, small_organ());
  EXPECT_THROW(OrganWriter(file, small_organ()), geometry::InputError);
}

TEST_F(OrganFileTest, StoppedBuildKeepsTheOldFile) {
  const Organ old = build(small_organ());
  BuildOptions stopped;
  stopped.stopped = [] { return true; };
  EXPECT_THROW(build_organ(small_organ({2000, 0.4, 1000}), file, stopped), Interrupted);
  EXPECT_EQ(load_organ(file, Load::kWithTensors).hash, old.hash);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "the old file alone";
}

TEST_F(OrganFileTest, MaterialsOutOfRangeAreRefused) {
  for (const physics::Material wrong :
       {physics::Material{0, 0.4, 1000}, physics::Material{3000, 0.5, 1000},
        physics::Material{3000, -1, 1000}, physics::Material{3000, 0.4, 0}, physics::Material{NAN, 0.4, 1000},
        physics::Material{3000, NAN, 1000}}) {
    EXPECT_THROW(small_organ(wrong), geometry::InputError);
    Organ organ = two_materials();
    const physics::MaterialMap material{kTissue, {{7, wrong}}};
    EXPECT_THROW(make_organ("box", std::move(organ.mesh), material, organ.fixed, Storage::kFloat),
                 geometry::InputError);
  }
}

TEST_F(OrganFileTest, SupportsThatHoldEverythingAreRefused) {
  geometry::TetraMesh mesh = test::make_box_mesh(1, 1, 1, {1, 1, 1});
  FixedComponents all(mesh.positions.size(), physics::kPinned);
  EXPECT_THROW(make_organ("rock", std::move(mesh), kTissue, all, Storage::kFloat), geometry::InputError);
}

}  // namespace
}  // namespace omentum::organ
