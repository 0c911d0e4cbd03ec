"""idl/generate.py: what it makes of good definitions, and how it refuses bad ones."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

GENERATOR = pathlib.Path(sys.argv.pop(1))

GOOD = """// About the file.

// A constant's comment.
const unsigned long MAX = 3;  // how many

// A point.
@final
struct Point {
  @key unsigned long id;
  sequence<float, MAX> values;  // numbers, m:
                                // never empty
  string<16> name;
};
"""


class Generate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def run_on(self, text, name="x.idl"):
        (self.path / name).write_text(text)
        return subprocess.run(
            [sys.executable, GENERATOR, "--out", self.path / "out", self.path / name], capture_output=True, text=True)

    def header(self, text):
        result = self.run_on(text)
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.path / "out/messages/x.h").read_text()

    def refusal(self, text):
        result = self.run_on(text)
        self.assertEqual(result.returncode, 2)
        self.assertFalse((self.path / "out").exists(), "a refused definition leaves no header")
        return result.stderr

    def expect_refused(self, text, line, reason):
        message = self.refusal(text)
        self.assertIn(f"x.idl:{line}: ", message)
        self.assertIn(reason, message)

    def test_comments_and_bounds_are_carried_over(self):
        header = self.header(GOOD)
        self.assertIn("// About the file.", header)
        self.assertIn("/// A constant's comment.\ninline constexpr std::uint32_t MAX = 3;  ///< how many", header)
        self.assertIn("/// A point.\nstruct Point {", header)
        self.assertIn("std::vector<float> values{};  ///< numbers, m:\n    ///< never empty (at most 3)", header)
        self.assertIn('visit(Field{"id", true}, message.id);', header)
        self.assertIn('visit(Field{"values", false, 3}, message.values);', header)
        self.assertIn('visit(Field{"name", false, 16}, message.name);', header)

    def test_structs_that_are_nobodys_member_are_topics(self):
        self.header("@final struct A { double x; };\n@final struct B { A a; sequence<A, 4> more; };")
        self.assertIn("TopicList<B>", (self.path / "out/messages/all.h").read_text())

    def test_a_second_run_keeps_the_headers_time(self):
        self.header(GOOD)
        before = (self.path / "out/messages/x.h").stat().st_mtime_ns
        self.header(GOOD)
        self.assertEqual((self.path / "out/messages/x.h").stat().st_mtime_ns, before)

    def test_unbounded_sequence(self):
        self.expect_refused("@final struct A {\n  sequence<float> x;\n};", 2, "expected ','")

    def test_unbounded_string(self):
        self.expect_refused("@final struct A {\n  string x;\n};", 2, "expected '<'")

    def test_missing_final(self):
        self.expect_refused("\nstruct A {\n double x;\n};", 2, "must be @final")

    def test_appendable(self):
        self.expect_refused("@appendable struct A { double x; };", 1, "found '@appendable'")

    def test_enum(self):
        self.expect_refused("enum E { A, B };", 1, "found 'enum'")

    def test_optional_member(self):
        self.expect_refused("@final struct A {\n  @optional double x;\n};", 2, "found type '@optional'")

    def test_unknown_type(self):
        self.expect_refused("@final struct A {\n  double x;\n  Vec4 y;\n};", 3, "found type 'Vec4'")

    def test_unknown_bound(self):
        self.expect_refused("@final struct A {\n  sequence<float, MOST> y;\n};", 2, "found 'MOST'")

    def test_bound_of_zero(self):
        self.expect_refused("@final struct A { string<0> y; };", 1, "at least 1")

    def test_array(self):
        self.expect_refused("@final struct A {\n  double x[3];\n};", 2, "found '[3];'")

    def test_map(self):
        self.expect_refused("@final struct A {\n  map<long, long> x;\n};", 2, "found type 'map'")

    def test_sequence_of_sequences(self):
        self.expect_refused("@final struct A {\n  sequence<sequence<long, 2>, 2> x;\n};", 2, "sequence of sequences")

    def test_key_behind_other_members(self):
        self.expect_refused("@final struct A {\n  double x;\n  @key unsigned long k;\n};", 3, "come first")

    def test_key_that_is_no_integer(self):
        self.expect_refused("@final struct A {\n  @key double k;\n};", 2, "must be an integer")

    def test_key_that_would_be_hashed(self):
        self.expect_refused(
            "@final struct A {\n  @key long long a;\n  @key long long b;\n  @key long c;\n};", 1, "at most 16 fit")

    def test_topic_as_a_member(self):
        self.expect_refused("@final struct A { @key long k; };\n@final struct B {\n  A a;\n};", 3, "cannot be a member")

    def test_member_twice(self):
        self.expect_refused("@final struct A {\n  double x;\n  float x;\n};", 3, "appears twice")

    def test_struct_twice(self):
        self.expect_refused("@final struct A { double x; };\n@final struct A { double x; };", 2, "declared twice")

    def test_word_of_cpp(self):
        self.expect_refused("@final struct A {\n  double new;\n};", 2, "a word of C++")

    def test_missing_semicolon(self):
        self.expect_refused("@final struct A {\n  double x\n};", 3, "expected ';'")

    def test_end_inside_a_module(self):
        self.expect_refused("module m {\n@final struct A { double x; };\n", 3, "ends inside a module")

    def test_missing_include(self):
        self.expect_refused('#include "none.idl"\n', 1, "does not exist")

    def test_file_that_includes_itself(self):
        self.expect_refused('#include "x.idl"\n', 1, "includes itself")


if __name__ == "__main__":
    unittest.main()
