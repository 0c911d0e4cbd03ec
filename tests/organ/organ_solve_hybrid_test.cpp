// organ_solve of organs with a dynamic part: they rest where the single model does (Cotin 1998, fig. 6).
#include "tests/organ/organ_programs.h"

namespace omentum::organ {
namespace {

// Of the largest value: the tensors are stored in float.
constexpr double kHybridEqual = 1e-6;

class OrganSolveHybridTest : public OrganProgramsTest {
 protected:
  void build_hybrid(const std::vector<std::string>& arguments, const std::string& dynamic) const {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--dynamic", dynamic});
    Process program("organ_build", all);
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  // Presses on both parts and on a connection node, and every thirtieth dynamic tetrahedron gone.
  std::vector<std::string> everything() const {
    const Organ loaded = load_organ(organ, Load::kMeshOnly);
    const physics::MeshSplit& parts = loaded.split->parts;
    std::string imposed, removed;
    const auto press = [&](geometry::NodeId n, const std::string& u) {
      imposed += std::to_string(loaded.mesh.file_node[n]) + "," + u + "\n";
    };
    press(parts.precomputed.node[loaded.split->surface.node[0]], "0.001,0.002,-0.001");
    press(parts.connection[parts.connection.size() / 2], "0.002,0,-0.001");
    for (std::size_t t = 30; t < parts.dynamic.tetrahedron.size(); t += 30)
      removed += std::to_string(parts.dynamic.tetrahedron[t]) + "\n";
    const auto is_free = [&](geometry::NodeId n) { return !std::ranges::binary_search(parts.connection, n); };
    press(*std::ranges::find_if(parts.dynamic.node, is_free), "0.001,0.002,0");
    return {
        "--gravity", "0,-9.81,0", "--imposed", write("i.csv", imposed), "--remove", write("t.csv", removed)};
  }

  void expect_equal(const std::vector<std::string>& task) const {
    const Solved direct = solve("direct", task), hybrid = solve("hybrid", task);
    EXPECT_LE(largest_difference(hybrid.u, direct.u), kHybridEqual * largest_entry(direct.u));
    EXPECT_LE(largest_difference(hybrid.f, direct.f), 10 * kHybridEqual * largest_entry(direct.f));
  }
};

TEST_F(OrganSolveHybridTest, ItRestsWhereTheSingleModelDoesOnRealMeshes) {
  struct Mesh {
    const char *file, *scale, *plane, *dynamic;
  };
  for (const Mesh& mesh : {Mesh{"tet/openhelp_liver_7k.msh", "0.001", "plane:x<-0.12", "plane:x>0"},
                           Mesh{"tet/sofa_liver2.msh", "0.02", "plane:x<-0.015", "plane:x>0"},
                           Mesh{"tet/sofa_liver.msh", "0.02", "plane:x<-0.06", "plane:x>-0.02"}}) {
    if (!std::filesystem::exists(test::data_file(mesh.file))) GTEST_SKIP() << mesh.file << " is absent";
    SCOPED_TRACE(mesh.file);
    build_hybrid(
        {test::data_file(mesh.file).string(), "-o", organ.string(), "--young", "5000", "--poisson", "0.45",
         "--density", "1050", "--scale", mesh.scale, "--fixed", mesh.plane, "--numbering", "position"},
        mesh.dynamic);
    expect_equal(everything());
  }
}

// Tetrahedra of both parts, some of them at the border; what they leave loose of a mesh is left out.
TEST_F(OrganSolveHybridTest, ItRestsWhereADirectSolveDoesWhicheverPartIsCut) {
  build_hybrid(build_arguments(mesh), "plane:x>0.05");
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  const std::size_t count = loaded.mesh.tetrahedra.size();
  for (const std::size_t every : {count - 1, std::size_t{31}, std::size_t{11}}) {
    std::string removed;
    std::size_t precomputed = 0;
    for (std::size_t t = every; t < count; t += every) {
      removed += std::to_string(t) + "\n";
      precomputed += loaded.split->dynamic[t] == 0;
    }
    if (precomputed == 0) removed += "1\n";
    const std::vector<std::string> task{"--gravity", "0,-9.81,3",
                                        "--remove",  write("t.csv", removed),
                                        "--imposed", write("i.csv", "79,0.001,0,-0.002\n")};
    const Solved direct = solve("direct", task), hybrid = solve("hybrid", task);
    EXPECT_LE(largest_difference(hybrid.u, direct.u), kHybridEqual * largest_entry(direct.u)) << every;
    EXPECT_LE(largest_difference(hybrid.f, direct.f), 10 * kHybridEqual * largest_entry(direct.f)) << every;
  }
}

TEST_F(OrganSolveHybridTest, ItDoesWithSeveralDynamicParts) {
  build_hybrid(build_arguments(mesh), "box:0.05,0,0,1,1,0.02+box:0.05,0,0.04,1,1,1");
  expect_equal({"--gravity", "0,-9.81,3", "--imposed", write("i.csv", "79,0.001,0,-0.002\n")});
}

// Near rest one law is the other; far from it, what hangs is where the single co-rotational model has it, but
// for the border's turning, which the precomputed part takes for a strain.
TEST_F(OrganSolveHybridTest, ItsDynamicPartTurnsByTheLawThatIsAskedFor) {
  build_hybrid(build_arguments(mesh), "plane:x>0.02");
  const auto rest = [&](const std::string& model, const std::string& y, const std::string& law = {}) {
    std::vector<std::string> task{"--gravity", "0," + y + ",0", "--imposed",
                                  write("i.csv", "79,0,0,0.001\n")};
    if (!law.empty()) task.insert(task.end(), {"--law", law});
    return solve(model, task);
  };
  const Solved few = rest("hybrid", "-1e-4", "linear"), turned = rest("hybrid", "-1e-4", "corotational");
  EXPECT_LE(largest_difference(few.u, turned.u), 0.01 * largest_entry(few.u));
  const Solved one = rest("corotational", "-20"), linear = rest("hybrid", "-20"),
               hybrid = rest("hybrid", "-20", "corotational");
  EXPECT_LT(largest_difference(hybrid.u, one.u), 0.5 * largest_difference(linear.u, one.u));
}

TEST_F(OrganSolveHybridTest, WhatItCannotAnswerIsRefused) {
  build_hybrid(build_arguments(mesh), "plane:x>0.05");
  expect_solve_refused("hybrid", {"--law", "corotational", "--remove", write("t.csv", "1\n")},
                       "--remove names tetrahedra of the precomputed part");
  expect_solve_refused("hybrid", {"--imposed", write("i.csv", "26,0,0,0.001\n")},
                       "node 26 is inside the precomputed part");
  expect_solve_refused("tensors", {}, "--model hybrid");
  expect_solve_refused("hybrid", {"--law", "springs"}, "--law springs: expected linear or corotational");
  expect_solve_refused("direct", {"--law", "linear"}, "--law linear: --model direct has no law to choose");
  build();
  expect_solve_refused("hybrid", {}, "has no dynamic part");
}

}  // namespace
}  // namespace omentum::organ
