#include "organ/partial_file.h"
#include "geometry/tetra_mesh.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <csignal>
#include <memory>

#include <sys/wait.h>
#include <unistd.h>

namespace omentum::organ {
namespace {

class PartialFileTest : public testing::Test {
 protected:
  // What a process that is killed while it writes FILE leaves behind.
  void leave(const std::filesystem::path& file) const {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const PartialFile partial(file);
      std::ofstream(partial.path()) << "half";
      kill(getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
  }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
  }

  test::ScratchFolder folder;
};

TEST_F(PartialFileTest, MovesWholeFilesOnly) {
  {
    PartialFile partial(folder / "a.csv");
    std::ofstream(partial.path()) << "whole";
    EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
    partial.move_to_its_place();
  }
  { const PartialFile abandoned(folder / "b.csv"); }
  EXPECT_EQ(test::read_text(folder / "a.csv"), "whole");
  EXPECT_EQ(files(), 1u);
}

TEST_F(PartialFileTest, WhatADeadProcessLeftIsRemovedByTheNextOneInTheFolder) {
  leave(folder / "dead.h5");
  ASSERT_EQ(files(), 1u);
  { const PartialFile another(folder / "another.h5"); }
  EXPECT_EQ(files(), 0u);
}

TEST_F(PartialFileTest, WhatALivingProcessHoldsStays) {
  const PartialFile living(folder / "living.h5");
  leave(folder / "dead.h5");
  EXPECT_EQ(remove_abandoned(folder.path()), 1);
  EXPECT_TRUE(std::filesystem::exists(living.path()));
  EXPECT_THROW(PartialFile(folder / "living.h5"), geometry::InputError);
}

TEST_F(PartialFileTest, FilesOfOthersStay) {
  for (const char* name : {"download.partial", "a.h5", "omentum-partial", "b.h5.part"})
    std::ofstream(folder / name) << "theirs";
  std::filesystem::create_directory(folder / "folder.omentum-partial");
  std::filesystem::create_symlink(folder / "a.h5", folder / "link.omentum-partial");
  EXPECT_EQ(remove_abandoned(folder.path()), 0);
  EXPECT_EQ(remove_abandoned(folder / "absent"), 0);
  EXPECT_EQ(files(), 6u);
}

TEST_F(PartialFileTest, RefusesPlacesWhereNothingCanBeWritten) {
  EXPECT_THROW(PartialFile(folder / "absent" / "a.csv"), geometry::InputError);
  std::filesystem::create_directory(folder / "a.csv");
  EXPECT_THROW(PartialFile(folder / "a.csv"), geometry::InputError);
}

}  // namespace
}  // namespace omentum::organ
