// organ_build and organ_solve on the files of other programs.
#pragma once

#include "tests/organ/cell_meshes.h"
#include "tests/organ/organ_programs.h"

namespace omentum::organ {

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

}  // namespace omentum::organ
