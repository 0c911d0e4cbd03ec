#include "deform_node/cut_journal.h"

#include "tests/support/process.h"

#include "files/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint64_t kVersion = 300;

class CutJournalTest : public testing::Test {
 protected:
  CutJournalTest() { scene_.organs = {{"plate", "ab12", 20}, {"bone", "cd34", 0}}; }

  static std::vector<OrganCuts> cuts() {
    return {{.version = kVersion, .removed_bits = {0xff, 0x10, 0x08}, .burnt_bits = {0x0f, 0x00, 0x08}}, {}};
  }
  std::string good_text() const { return journal_text(scene_, cuts()); }
  JournalContents read(const std::string& text) const {
    files::write_whole(file_, text);
    return read_journal(file_, scene_);
  }
  /// Of a good journal with other words in it.
  JournalContents read_with(const std::string& part, const std::string& instead) const {
    std::string text = good_text();
    const std::size_t place = text.find(part);
    EXPECT_NE(place, std::string::npos) << part;
    return read(text.replace(place, part.size(), instead));
  }
  void expect_whole(const JournalContents& contents) const {
    ASSERT_EQ(contents.organs.size(), scene_.organs.size());
    EXPECT_THAT(contents.organs, Each(Field(&OrganCuts::removed_bits, IsEmpty())));
    EXPECT_THAT(contents.organs, Each(Field(&OrganCuts::burnt_bits, IsEmpty())));
    EXPECT_EQ(contents.flaw.find('\n'), std::string::npos);
    EXPECT_THAT(contents.flaw, HasSubstr(file_.string()));
  }
  std::vector<OrganSnapshot> snapshots() const {
    std::vector<OrganSnapshot> snapshots(2);
    snapshots[0].topology_version = kVersion;
    snapshots[0].removed_bits = cuts()[0].removed_bits;
    snapshots[0].burnt_bits = cuts()[0].burnt_bits;
    return snapshots;
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "cuts.json";
  JournalScene scene_{.hash = "5ce9e", .organs = {}};
  runtime::FaultList faults_;
};

TEST_F(CutJournalTest, WhatWasKeptIsReadAgain) {
  CutJournal(file_, scene_, faults_).keep(snapshots());
  const std::vector<OrganCuts> found = CutJournal(file_, scene_, faults_).read();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].version, kVersion);
  EXPECT_EQ(found[0].removed_bits, cuts()[0].removed_bits);
  EXPECT_EQ(found[0].burnt_bits, cuts()[0].burnt_bits);
  EXPECT_EQ(found[1].version, 0u);
  EXPECT_FALSE(faults_.any());
}

TEST_F(CutJournalTest, WithoutAFileNothingIsSaid) {
  const JournalContents contents = read_journal(file_, scene_);
  EXPECT_EQ(contents.flaw, "");
  EXPECT_THAT(contents.organs, Each(Field(&OrganCuts::version, 0u)));
}

TEST_F(CutJournalTest, APartOfAJournalIsNone) {
  const std::string text = good_text();
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {  // the last one is a line feed
    const JournalContents contents = read(text.substr(0, size));
    expect_whole(contents);
    for (const OrganCuts& organ : contents.organs) EXPECT_GT(organ.version, kVersion) << size;
  }
}

TEST_F(CutJournalTest, AnotherScenesOrOrgansJournalLeavesWholeOrgansAboveItsVersions) {
  const std::vector<std::pair<std::string, std::string>> others = {
      {"5ce9e", "5ce9f"},
      {"omentum cuts 1", "omentum cuts 2"},
      {"ab12", "ab13"},
      {"\"tetrahedra\": 20", "\"tetrahedra\": 21"},
      {"ff1008", "ff10"},
      {"ff1008", "ff1018"},                          // beyond the last tetrahedron
      {"ff1008", "ff1g08"},                          // no digit
      {"0f0008", "0f0108"},                          // burnt, but there
      {"\"removed\": \"\"", "\"removed\": \"00\""},  // of an organ that cannot be cut
      {"\"burnt\"", "\"charred\""},
  };
  for (const auto& [part, instead] : others) {
    SCOPED_TRACE(instead);
    const JournalContents contents = read_with(part, instead);
    expect_whole(contents);
    EXPECT_THAT(contents.flaw, HasSubstr("expected"));
    EXPECT_THAT(contents.organs, Each(Field(&OrganCuts::version, kVersion + 1)));
  }
}

TEST_F(CutJournalTest, VersionsThatCannotBeAreRefused) {
  for (const char* version : {"-1", "0", "1.5", "\"7\"", "null", "18446744073709551615", "1e300", "[[]]"}) {
    SCOPED_TRACE(version);
    expect_whole(read_with(std::to_string(kVersion), version));
  }
}

TEST_F(CutJournalTest, WhatIsNoJournalAtAllIsRefused) {
  for (const char* text :
       {"", "7", "[]", "{}", "null", "{\"organs\": 3}", "\xff\xfe", "{\"organs\": [1, {}]}"}) {
    SCOPED_TRACE(text);
    const JournalContents contents = read(text);
    expect_whole(contents);
    for (const OrganCuts& organ : contents.organs) EXPECT_GT(organ.version, 0u);
  }
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  expect_whole(read_journal(file_, scene_));
}

TEST_F(CutJournalTest, WhatStrangersWroteIsQuotedInPart) {
  std::string hash(100'000, 'x');
  hash += "\\n";
  const JournalContents contents = read_with("5ce9e", hash);
  expect_whole(contents);
  EXPECT_LT(contents.flaw.size(), 400u);
}

TEST_F(CutJournalTest, AFlawIsAFault) {
  files::write_whole(file_, "{");
  testing::internal::CaptureStderr();
  CutJournal(file_, scene_, faults_).read();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(said, '\n'), 1);
  EXPECT_THAT(said, HasSubstr(file_.string()));
  EXPECT_TRUE(faults_.any());
}

TEST_F(CutJournalTest, ItIsWrittenWhenAVersionChangedAndOnlyThen) {
  CutJournal journal(file_, scene_, faults_);
  std::vector<OrganSnapshot> now = snapshots();
  journal.keep(now);
  std::filesystem::remove(file_);
  journal.keep(now);
  EXPECT_FALSE(std::filesystem::exists(file_));
  ++now[0].topology_version;
  journal.keep(now);
  EXPECT_EQ(read_journal(file_, scene_).organs[0].version, kVersion + 1);
}

TEST_F(CutJournalTest, WhatCouldNotBeWrittenIsTriedAgainAndAFault) {
  std::filesystem::create_directory(file_);
  CutJournal journal(file_, scene_, faults_);
  journal.keep(snapshots());
  EXPECT_TRUE(faults_.any());
  std::filesystem::remove(file_);
  journal.keep(snapshots());
  EXPECT_EQ(read_journal(file_, scene_).organs[0].version, kVersion);
}

}  // namespace
}  // namespace omentum::deform
