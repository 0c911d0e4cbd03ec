// What every node refuses at its start.
#pragma once

#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace omentum::test {

/// Starts `program` with each of them: it says one line, which begins with its name, and ends with code 2.
inline void expect_bad_starts_refused(const std::string& program) {
  const ScratchFolder folder;
  std::ofstream(folder / "broken.toml") << "name = \n";
  std::ofstream(folder / "no_file.toml")
      << "name = \"n\"\n[[organs]]\nname = \"o\"\nmesh = \"m.msh\"\nyoung_pa = 1\n"
         "poisson = 0.3\ndensity_kg_m3 = 1\nfixed = \"plane:z<0\"\n"
         "[[tools]]\nid = 0\nname = \"p\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
  std::ofstream(folder / "broken.h5") << "not an organ";
  const std::string good = folder / "no_file.toml";
  const std::vector<std::vector<std::string>> table = {
      {"--scene", folder / "missing.toml"},
      {"--scene", folder / "broken.toml"},
      {"--scene", good},
      {"--scene", good, "--organ", folder / "missing.h5"},
      {"--scene", good, "--organ", folder / "broken.h5"},
      {"--scene", good, "--dds", "telepathy"},
      {"--scene", good, "--domain", "231"},
      {"--scene", good, "--rate-hz", "-1"},
      {},
  };
  for (const auto& arguments : table) {
    Process node(program, arguments);
    EXPECT_EQ(node.wait(), 2) << (arguments.empty() ? "no arguments" : arguments.back());
    const std::string messages = node.messages();
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_TRUE(messages.starts_with(program + ": ")) << messages;
  }
}

}  // namespace omentum::test
