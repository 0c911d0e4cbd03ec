// organ_solve of an organ whose parts share no nodes (Cotin 1998, fig. 4b), against the same two meshes as
// one model.
#include "physics/direct_solve.h"
#include "tests/organ/organ_programs.h"

#include <Eigen/Dense>

namespace omentum::organ {
namespace {

using geometry::NodeId;
using geometry::Vec3;

// Of the largest displacement; the tensors are stored in float.
constexpr double kTiedEqual = 1e-5;

/// A bar held at its fine end, its other half coarse.
class OrganSolveTiedTest : public OrganProgramsTest {
 protected:
  OrganSolveTiedTest() {
    write_part("fine.msh", 0, 4, 3);
    write_part("coarse.msh", 0.04, 3, 2);
  }
  void write_part(const std::string& name, double x_m, int along, int across) const {
    geometry::TetraMesh part = test::make_box_mesh(along, across, across, {0.04, 0.03, 0.03});
    for (Vec3& p : part.positions) p.x() += x_m;
    geometry::write_mesh(part, folder / name);
  }
  std::vector<std::string> tied_arguments() const {
    return {(folder / "fine.msh").string(),
            "--dynamic-mesh",
            (folder / "coarse.msh").string(),
            "-o",
            organ.string(),
            "--young",
            "5000",
            "--poisson",
            "0.4",
            "--density",
            "1050",
            "--scale",
            "1",
            "--fixed",
            "plane:x<0.001"};
  }
  void build_tied() const {
    Process program("organ_build", tied_arguments());
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  // By Lagrange multipliers, all nodes and constraints in one matrix.
  static std::vector<Vec3> one_model(const Organ& organ, const Vec3& gravity,
                                     std::span<const physics::ImposedDisplacement> imposed) {
    const OrganSplit& split = *organ.split;
    const auto nodes = static_cast<Eigen::Index>(3 * organ.mesh.positions.size());
    std::vector<std::pair<Eigen::VectorXd, Vec3>> ties;  // of nodes, and what their sum is
    const auto tie = [&](NodeId n, const Vec3& u) -> Eigen::VectorXd& {
      ties.emplace_back(Eigen::VectorXd::Zero(nodes / 3), u);
      ties.back().first[static_cast<Eigen::Index>(n)] = 1;
      return ties.back().first;
    };
    for (std::size_t n = 0; n < organ.fixed.size(); ++n)
      if (organ.fixed[n] != 0) tie(NodeId(n), Vec3::Zero());
    for (const auto& i : imposed) tie(i.node, i.displacement);
    for (std::size_t s = 0; s < split.tie->slaves.size(); ++s) {
      Eigen::VectorXd& row =
          tie(split.parts.precomputed.node[split.surface.node[split.tie->slaves[s]]], Vec3::Zero());
      for (std::size_t m = 0; m < split.tie->map.masters.size(); ++m)
        row[static_cast<Eigen::Index>(split.parts.dynamic.node[split.tie->map.masters[m]])] -=
            split.tie->map.P(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(m));
    }
    const auto all = nodes + static_cast<Eigen::Index>(3 * ties.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(all, all);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(all);
    const physics::Stiffness K = physics::assemble_stiffness(organ.mesh, organ.material);
    for (std::int32_t n = 0; n < K.node_count(); ++n)
      for (std::int32_t j = K.start[n]; j < K.start[n + 1]; ++j)
        A.block<3, 3>(3 * n, 3 * static_cast<Eigen::Index>(K.neighbour[j])) += K.block[j];
    const std::vector<Vec3> weights = physics::body_forces(organ.mesh, organ.material, gravity);
    for (std::size_t n = 0; n < weights.size(); ++n)
      b.segment<3>(static_cast<Eigen::Index>(3 * n)) = weights[n];
    for (std::size_t k = 0; k < ties.size(); ++k) {
      const Eigen::Index row = nodes + static_cast<Eigen::Index>(3 * k);
      b.segment<3>(row) = ties[k].second;
      for (Eigen::Index n = 0; n < nodes / 3; ++n)
        for (Eigen::Index i = 0; i < 3; ++i) A(row + i, 3 * n + i) = A(3 * n + i, row + i) = ties[k].first[n];
    }
    const Eigen::VectorXd x = A.partialPivLu().solve(b);
    std::vector<Vec3> u;
    for (Eigen::Index n = 0; n < nodes; n += 3) u.emplace_back(x.segment<3>(n));
    return u;
  }
};

TEST_F(OrganSolveTiedTest, ItRestsWhereTheTwoMeshesDoAsOneModelPressedOnEitherPart) {
  build_tied();
  const Organ loaded = load_organ(organ, Load::kMeshOnly);
  ASSERT_TRUE(loaded.split && loaded.split->tie);
  const auto nearest = [&](const Vec3& place) {
    std::size_t best = 0;
    for (std::size_t n = 0; n < loaded.mesh.positions.size(); ++n)
      if ((loaded.mesh.positions[n] - place).norm() < (loaded.mesh.positions[best] - place).norm()) best = n;
    return NodeId(best);
  };
  const NodeId on_fine = nearest({0.02, 0.01, 0.03}), on_coarse = nearest({0.0667, 0.015, 0.03});
  const Vec3 press(0.0005, 0.001, -0.003);
  for (const std::vector<NodeId>& pressed :
       {std::vector<NodeId>{}, std::vector<NodeId>{on_fine}, std::vector<NodeId>{on_coarse},
        std::vector<NodeId>{on_fine, on_coarse}}) {
    std::string csv;
    std::vector<physics::ImposedDisplacement> imposed;
    for (const NodeId n : pressed) {
      csv += std::to_string(loaded.mesh.file_node[n]) + ",0.0005,0.001,-0.003\n";
      imposed.push_back({n, press});
    }
    std::vector<std::string> task{"--gravity", "0,0,-9.81"};
    if (!pressed.empty()) task.insert(task.end(), {"--imposed", write("i.csv", csv)});
    const Solved hybrid = solve("hybrid", task);
    const std::vector<Vec3> exact = one_model(loaded, {0, 0, -9.81}, imposed);
    ASSERT_EQ(hybrid.u.size(), exact.size());
    double off = 0, size = 0;
    for (std::size_t n = 0; n < exact.size(); ++n) {
      off = std::max(off, (Vec3(hybrid.u[n].data() + 1) - exact[n]).norm());
      size = std::max(size, exact[n].norm());
    }
    RecordProperty("off", std::to_string(off / size));
    EXPECT_LE(off, kTiedEqual * size) << pressed.size() << " presses";
  }
}

TEST_F(OrganSolveTiedTest, WhatATiedOrganCannotAnswerIsRefused) {
  build_tied();
  expect_solve_refused("direct", {}, "expected --model hybrid");
  expect_solve_refused("tensor-mass", {}, "expected --model hybrid");
  expect_solve_refused("hybrid", {"--imposed", write("i.csv", "4,0,0,0.001\n")},
                       "node 4 follows the dynamic part");
  expect_solve_refused("hybrid", {"--remove", write("t.csv", "0\n")},
                       "which shares no nodes with the dynamic one");
}

TEST_F(OrganSolveTiedTest, OptionsThatContradictEachOtherAreRefused) {
  std::vector<std::string> arguments = tied_arguments();
  arguments.insert(arguments.end(), {"--dynamic", "plane:x>0"});
  expect_refused("organ_build", arguments, "expected no --dynamic beside it");
  arguments = build_arguments(mesh);
  arguments.insert(arguments.end(), {"--dynamic-gap", "0.001"});
  expect_refused("organ_build", arguments, "expected --dynamic-mesh");
}

}  // namespace
}  // namespace omentum::organ
