// organ_build and organ_solve as a user runs them: real processes, real files.
#pragma once

#include "organ/csv.h"
#include "organ/organ.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace omentum::organ {

using test::Process;
using testing::HasSubstr;

inline constexpr int kBadInput = 2;
inline constexpr int kInterrupted = 130;

class OrganProgramsTest : public testing::Test {
 protected:
  OrganProgramsTest() {
    geometry::write_mesh(test::make_box_mesh(4, 3, 3, {0.08, 0.06, 0.06}), mesh);
    // large enough that its tensors take a while
    geometry::write_mesh(test::make_box_mesh(18, 18, 18, {0.1, 0.1, 0.1}), large_mesh);
  }

  // By position: what programs use, as these tests do.
  std::vector<std::string> build_arguments(const std::filesystem::path& from) const {
    return {from.string(), "-o",      organ.string(),  "--young",     "3000",
            "--poisson",   "0.45",    "--density",     "1050",        "--scale",
            "1",           "--fixed", "plane:x<0.001", "--numbering", "position"};
  }

  // One option's value replaced, or an option added.
  std::vector<std::string> with(const std::string& option, const std::string& value) const {
    std::vector<std::string> arguments = build_arguments(mesh);
    const auto found = std::ranges::find(arguments, option);
    if (found == arguments.end()) {
      arguments.insert(arguments.end(), {option, value});
    } else {
      *(found + 1) = value;
    }
    return arguments;
  }

  void build() {
    Process program("organ_build", build_arguments(mesh));
    ASSERT_EQ(program.wait(), 0) << program.messages();
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }

  // Exit code 2, one line that names what is wrong, and nothing left behind.
  void expect_refused(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& named) {
    SCOPED_TRACE(named);
    const bool had_organ = std::filesystem::exists(organ);
    Process process(program, arguments);
    EXPECT_EQ(process.wait(), kBadInput);
    const std::string message = process.messages();
    EXPECT_EQ(std::ranges::count(message, '\n'), 1) << message;
    EXPECT_THAT(message, HasSubstr(named));
    EXPECT_EQ(std::filesystem::exists(organ), had_organ);
    EXPECT_FALSE(std::filesystem::exists(partial));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.u.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.f.csv"));
  }
  // A solve of `organ` under a weight.
  void expect_solve_refused(const std::string& model, const std::vector<std::string>& more,
                            const std::string& named) {
    std::vector<std::string> arguments{
        organ.string(), "--numbering", "position",  "-o",    (folder / "s").string(),
        "--model",      model,         "--gravity", "0,-1,0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused("organ_solve", arguments, named);
  }

  std::vector<std::string> solve_arguments(const std::string& imposed) const {
    return {organ.string(), "--numbering", "position", "--imposed", imposed, "-o", (folder / "s").string()};
  }

  std::vector<std::vector<double>> numbers(const std::string& name) const {
    std::vector<std::vector<double>> rows;
    for (const CsvLine& line : read_csv(folder / name).lines) {
      rows.emplace_back();
      for (const std::string& field : line.fields) rows.back().push_back(parse_number(field).value());
    }
    return rows;
  }

  using Rows = std::vector<std::vector<double>>;

  // What organ_solve writes, the forces where something is imposed.
  struct Solved {
    Rows u, f;
  };

  Solved solve(const std::string& model, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{organ.string(),          "--numbering", "position", "-o",
                                       (folder / "s").string(), "--model",     model};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Process program("organ_solve", arguments);
    EXPECT_EQ(program.wait(), 0) << program.messages();
    const bool holds = std::ranges::find(more, "--imposed") != more.end();
    return {numbers("s.u.csv"), holds ? numbers("s.f.csv") : Rows{}};
  }

  // Over all rows "node, x, y, z", without the node numbers.
  static double largest_entry(const Rows& rows) {
    double largest = 0;
    for (const auto& row : rows)
      largest = std::max({largest, std::abs(row[1]), std::abs(row[2]), std::abs(row[3])});
    return largest;
  }
  static double largest_difference(const Rows& a, const Rows& b) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
      EXPECT_EQ(a[n][0], b[n][0]);
      for (int c = 1; c < 4; ++c) largest = std::max(largest, std::abs(a[n][c] - b[n][c]));
    }
    return largest;
  }

  test::ScratchFolder folder;
  const std::filesystem::path mesh = folder / "box.msh", large_mesh = folder / "large.msh";
  const std::filesystem::path organ = folder / "box.h5", partial = folder / "box.h5.omentum-partial";
};

}  // namespace omentum::organ
