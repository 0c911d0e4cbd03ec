#include "organ/csv.h"

#include "geometry/tetra_mesh.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace omentum::organ {
namespace {

using testing::ElementsAre;

class CsvTest : public testing::Test {
 protected:
  CsvTable table(const std::string& text) {
    std::ofstream(folder / "t.csv", std::ios::binary) << text;
    return read_csv(folder / "t.csv");
  }
  std::vector<CsvLine> read(const std::string& text) { return table(text).lines; }
  test::ScratchFolder folder;
};

TEST_F(CsvTest, HeaderCommentsAndEmptyLinesAreLeftOut) {
  const auto lines = read("node,ux\n# a comment\n\n 3 , 1e-3\r\n4,2\n");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0].fields, ElementsAre("3", "1e-3"));
  EXPECT_THAT(lines[1].fields, ElementsAre("4", "2"));
  EXPECT_THAT(lines[0].where, testing::EndsWith("t.csv:4"));
}

TEST_F(CsvTest, AFirstLineWithNumbersIsNoHeader) {
  EXPECT_EQ(read("nan,1,2,3\n").size(), 1u);
}

// A table that begins with a slip of the pen must not lose that line in silence.
TEST_F(CsvTest, AMalformedFirstLineIsNoHeader) {
  for (const char* slip : {"1O\n2\n", "nan,nan\n1,2\n", "-,-\n1,2\n"}) {
    EXPECT_EQ(read(slip).size(), 2u) << slip;
  }
}

TEST_F(CsvTest, AnotherSeparatorIsNamed) {
  const auto refusal = [this](const std::string& text) -> std::string {
    try {
      read(text);
    } catch (const geometry::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  constexpr const char* kTables[][2] = {
      {"12;0;0;0.001\n", "t.csv:1: found fields separated by ';'; expected ','"},
      {"12;0,001;0,5;0,25\n", "t.csv:1: found fields separated by ';'"},
      {"node;ux;uy;uz\n12;0;0;0\n", "t.csv:1: found fields separated by ';'"},
      {"node\tux\tuy\n12\t0\t0\n", "t.csv:1: found fields separated by tabs"},
      {"12\t0\t0\n", "t.csv:1: found fields separated by tabs"},
      {"# by hand\n12 0 0 0.1\n", "t.csv:2: found fields separated by blanks"},
      {"3\n4|5\n", "t.csv:2: found fields separated by '|'"},
      {"node,ux\n12;0\n", "t.csv:2: found fields separated by ';'"}};
  for (const auto& [text, said] : kTables) EXPECT_THAT(refusal(text), testing::HasSubstr(said)) << text;
  EXPECT_EQ(refusal("Node ID\n3\n"), "accepted");
  EXPECT_EQ(refusal("node, what it is\n3, a; b\n"), "accepted");
}

TEST_F(CsvTest, NumbersMayBeInQuotes) {
  const CsvTable t = table("\"node\",\"ux\",\"what\"\r\n\"12\", \"-1e-3\",\"a, b\"\r\n");
  ASSERT_TRUE(t.header);
  EXPECT_THAT(t.lines.at(0).fields, ElementsAre("12", "-1e-3", "a, b"));
  EXPECT_THAT(read("\"12\"\n\"13\"\n").at(1).fields, ElementsAre("13"));
}

TEST_F(CsvTest, AByteOrderMarkIsNotPartOfTheFirstField) {
  EXPECT_THAT(read("\xEF\xBB\xBF"
                   "12\n2\n")[0]
                  .fields,
              ElementsAre("12"));
  EXPECT_EQ(read("\xEF\xBB\xBFnode\n2\n").size(), 1u);
}

TEST_F(CsvTest, AHeaderIsKeptAndItsColumnsAreFound) {
  const CsvTable t = table("# numbering: position\n\"Node ID\",x\n3,0\n");
  ASSERT_TRUE(t.header);
  EXPECT_EQ(t.numbering, geometry::Numbering::kPosition);
  constexpr const char* kWanted[] = {"nodeid", "x"};
  EXPECT_EQ(find_column(*t.header, std::span(kWanted).first(1), "named node"), 0u);
  EXPECT_THROW(find_column(*t.header, kWanted, "named node"), geometry::InputError) << "two of them";
  EXPECT_THROW(find_column(*table("u,v\n1,2\n").header, kWanted, "named node"), geometry::InputError);
}

TEST_F(CsvTest, ALineIsAsWideAsTheHeader) {
  EXPECT_THROW(read("node,x\n1\n"), geometry::InputError);
}

TEST_F(CsvTest, AFileWithoutNumbersIsRefused) {
  EXPECT_THROW(read("node,ux\n"), geometry::InputError);
  EXPECT_THROW(read(""), geometry::InputError);
}

TEST_F(CsvTest, AMissingFileAndAFolderAreRefused) {
  EXPECT_THROW(read_csv(folder / "absent.csv"), geometry::InputError);
  EXPECT_THROW(read_csv(folder.path()), geometry::InputError);
}

TEST(ParseNumberTest, TakesWholeFiniteNumbersOnly) {
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number("+2"), 2);
  for (const char* wrong : {"", "+", "1.5x", "nan", "inf", "1 2", "0x10", "1e999"}) {
    EXPECT_FALSE(parse_number(wrong)) << wrong;
  }
  EXPECT_EQ(parse_integer("42"), 42);
  EXPECT_FALSE(parse_integer("4.0"));
  EXPECT_EQ(parse_integer("99999999999"), 99999999999);
  EXPECT_FALSE(parse_integer("99999999999999999999"));
}

}  // namespace
}  // namespace omentum::organ
