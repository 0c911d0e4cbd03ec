// How the organ's programs end when they are killed, told to, or given no room: nothing lost, nothing half
// written.
#include "tests/organ/organ_programs.h"

#include <sys/stat.h>

namespace omentum::organ {
namespace {

TEST_F(OrganProgramsTest, KilledBuildLeavesNothingThatLooksFinished) {
  Process program("organ_build", build_arguments(large_mesh));
  ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(partial); }));
  EXPECT_EQ(program.end(SIGKILL), -SIGKILL);

  EXPECT_FALSE(std::filesystem::exists(organ));
  EXPECT_THROW(load_organ(partial, Load::kMeshOnly), geometry::InputError);
  build();  // takes the remains over
  EXPECT_FALSE(std::filesystem::exists(partial));
  EXPECT_NO_THROW(load_organ(organ, Load::kWithTensors));
}

TEST_F(OrganProgramsTest, TheNextStartRemovesWhatKilledOnesLeftAndOnlyThat) {
  const auto partial_of = [&](const std::string& name) { return folder / (name + ".h5.omentum-partial"); };
  const auto build_into = [&](const std::string& name) {
    auto arguments = build_arguments(large_mesh);
    arguments[2] = (folder / (name + ".h5")).string();
    return arguments;
  };
  Process killed("organ_build", build_into("killed")), living("organ_build", build_into("living"));
  ASSERT_TRUE(test::comes_true([&] {
    return std::filesystem::exists(partial_of("killed")) && std::filesystem::exists(partial_of("living"));
  }));
  EXPECT_EQ(killed.end(SIGKILL), -SIGKILL);
  EXPECT_TRUE(std::filesystem::exists(partial_of("killed")));
  const std::string foreign = write("download.partial", "somebody else's");

  build();
  EXPECT_FALSE(std::filesystem::exists(partial_of("killed")));
  EXPECT_TRUE(std::filesystem::exists(foreign));
  // on a fast machine it may have finished by now
  EXPECT_TRUE(std::filesystem::exists(partial_of("living")) || std::filesystem::exists(folder / "living.h5"));
  living.end(SIGTERM);
}

TEST_F(OrganProgramsTest, TerminatedBuildRemovesItsTracesAndKeepsTheOldOrgan) {
  build();
  const std::string hash = load_organ(organ, Load::kMeshOnly).hash;
  for (const int signal : {SIGTERM, SIGINT}) {
    Process program("organ_build", build_arguments(large_mesh));
    ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(partial); }));
    EXPECT_EQ(program.end(signal), kInterrupted);
    EXPECT_THAT(program.messages(), HasSubstr("interrupted"));
    EXPECT_FALSE(std::filesystem::exists(partial));
    EXPECT_EQ(load_organ(organ, Load::kWithTensors).hash, hash);
  }
}

TEST_F(OrganProgramsTest, WhatIsNoRegularFileIsNeverReplaced) {
  expect_refused("organ_build", with("-o", "/dev/null"), "a device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_refused("organ_build", with("-o", (folder / "pipe").string()), "a pipe");
}

TEST_F(OrganProgramsTest, ALinkedOrganIsBuiltWhereTheLinkLeads) {
  std::filesystem::create_directory(folder / "far");
  std::filesystem::create_symlink(folder / "far" / "organ.h5", organ);
  build();
  EXPECT_TRUE(std::filesystem::is_symlink(organ));
  EXPECT_NO_THROW(load_organ(folder / "far" / "organ.h5", Load::kWithTensors));
}

// OpenBLAS asks for its buffers again without end where the system gives none.
TEST_F(OrganProgramsTest, AnAddressSpaceLimitEndsInALineOrAnOrgan) {
  constexpr int kKilled = 137;  // by timeout: it hung
  for (const int megabytes : {100, 200, 300, 400, 500, 600, 610, 620, 635, 650, 700, 800, 1000, 2000, 3000}) {
    SCOPED_TRACE(megabytes);
    std::string command = "ulimit -v " + std::to_string(1024 * megabytes) + "; exec timeout -s KILL 30 " +
                          OMENTUM_BIN_DIR "/organ_build";
    for (const std::string& argument : build_arguments(mesh)) command += " '" + argument + "'";
    Process limited("/bin/sh", {"-c", command + " --force"});
    const int code = limited.wait();
    EXPECT_NE(code, kKilled);
    EXPECT_FALSE(std::filesystem::exists(partial));
    if (code != 0) {
      EXPECT_EQ(code, kBadInput);
      EXPECT_THAT(limited.messages(), HasSubstr("emory"));
    }
  }
}

// A limit of a file's size is a full disk; HDF5 is left with a file that it cannot close.
TEST_F(OrganProgramsTest, AFullDiskEndsInALine) {
  std::string command = "trap '' XFSZ; ulimit -f 64; exec " OMENTUM_BIN_DIR "/organ_build";
  for (const std::string& argument : build_arguments(mesh)) command += " '" + argument + "'";
  Process limited("/bin/sh", {"-c", command});
  EXPECT_EQ(limited.wait(), kBadInput);
  EXPECT_THAT(limited.messages(), HasSubstr("cannot be written: File too large"));
  EXPECT_FALSE(std::filesystem::exists(partial));
  EXPECT_FALSE(std::filesystem::exists(organ));
}

TEST_F(OrganProgramsTest, ASecondSignalAlwaysEndsIt) {
  Process program("organ_build", build_arguments(large_mesh));
  ASSERT_TRUE(test::comes_true([&] { return std::filesystem::exists(partial); }));
  program.send(SIGSTOP);  // both wait for it before it can look at either
  program.send(SIGINT);
  program.send(SIGTERM);
  program.send(SIGCONT);
  const int code = program.wait();
  EXPECT_TRUE(code == -SIGINT || code == -SIGTERM) << code;
  EXPECT_FALSE(std::filesystem::exists(organ));
}

}  // namespace
}  // namespace omentum::organ
