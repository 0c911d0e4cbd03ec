"""launch_scripts/lint_files.py: what is looked at again, and what together, with a clang-tidy that notes its calls."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "launch_scripts" / "lint_files.py"
sys.path.insert(0, str(SCRIPT.parent))
import lint_files
# it finds something in sources that say "wrong", be it by themselves or included
TIDY = """#!/bin/sh
for source; do :; done
echo "${source##*/}" >>"$CALLS"
included=$(sed -n 's/^#include "\\(.*cpp\\)"/\\1/p' "$source")
echo ". $PWD/room/part.h" >&2
echo ".. /usr/include/stdio.h" >&2
if grep -q wrong "$source" $included; then echo "$source: error"; exit 1; fi
"""


class LintFilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name in ("bin", "room", "build"):
            (self.root / name).mkdir()
        self.write("bin/clang-tidy", TIDY)
        (self.root / "bin/clang-tidy").chmod(0o755)
        self.write(".clang-tidy", "Checks: one")
        self.write("room/part.h", "extern int part;")
        self.names = [f"room/{name}.cpp" for name in "abcd"]
        for name in self.names:
            self.write(name, '#include "room/part.h"\nint part;')
        self.compiled_by("c++ -O1")

    def write(self, name, text):
        (self.root / name).write_text(text)

    def compiled_by(self, command):
        entries = [{"directory": str(self.root), "file": str(self.root / name),
                    "command": f"{command} -o {name}.o -c {self.root / name}"} for name in self.names]
        self.write("build/compile_commands.json", json.dumps(entries))

    def lint(self, *names, checks="", options=()):
        """Exit code, and what clang-tidy was called for."""
        calls = self.root / "calls"
        calls.write_text("")
        environment = {**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}", "CALLS": str(calls)}
        done = subprocess.run([sys.executable, "-B", SCRIPT, "build", checks, *options, *names], cwd=self.root,
                              env=environment, capture_output=True, text=True, check=False)
        told = [line for line in done.stdout.splitlines() if not line.endswith("error")]
        self.assertEqual(sorted(told), sorted(names), done.stdout + done.stderr)
        return done.returncode, sorted(calls.read_text().split())

    def test_a_clean_file_is_looked_at_once(self):
        self.assertEqual(self.lint("room/a.cpp"), (0, ["a.cpp"]))
        self.assertEqual(self.lint("room/a.cpp"), (0, []))

    def test_a_file_with_findings_is_looked_at_until_it_has_none(self):
        self.write("room/a.cpp", "wrong")
        self.assertEqual(self.lint("room/a.cpp"), (1, ["a.cpp"]))
        self.assertEqual(self.lint("room/a.cpp"), (1, ["a.cpp"]))
        self.write("room/a.cpp", "right")
        self.assertEqual(self.lint("room/a.cpp"), (0, ["a.cpp"]))

    def test_whatever_it_is_made_of_makes_it_another(self):
        changes = (lambda: self.write("room/a.cpp", '#include "room/part.h"\nint part = 1;'),
                   lambda: self.write("room/part.h", "extern int part, other;"),
                   lambda: self.write(".clang-tidy", "Checks: two"),
                   lambda: self.compiled_by("c++ -O2"),
                   lambda: self.write("bin/clang-tidy", TIDY + "# newer\n"))
        self.lint("room/a.cpp")
        for number, change in enumerate(changes):
            change()
            self.assertEqual(self.lint("room/a.cpp"), (0, ["a.cpp"]), number)
            self.assertEqual(self.lint("room/a.cpp"), (0, []), number)
        self.assertEqual(self.lint("room/a.cpp", checks="-one"), (0, ["a.cpp"]))

    def test_a_broken_memory_is_none(self):
        self.lint("room/a.cpp")
        self.write("build/clean/room__a.cpp.json", "{")
        self.assertEqual(self.lint("room/a.cpp"), (0, ["a.cpp"]))

    def test_files_that_are_compiled_alike_are_looked_at_together(self):
        self.assertEqual(self.lint(*self.names), (0, ["all.cpp"]))
        self.assertEqual(self.lint(*self.names), (0, []))
        self.write("room/b.cpp", "int other;")
        self.assertEqual(self.lint(*self.names), (0, ["b.cpp"]))

    def test_those_that_name_something_alike_are_looked_at_apart(self):
        def unnamed(text):
            return f"namespace {{\n\n{text}\n\n}}  // namespace\n"
        alike = (("constexpr int kPart = 1;", "const double kPart = 2;"), ("struct Part {\n};", "struct Part : int {\n};"),
                 ("int part(int of) {\n  return of;\n}", "int part(int of) {\n}"), ("int kParts[2];", "int kParts[3];"))
        different = (("constexpr int kPart = 1;", "constexpr int kOther = 1;"), ("int part(int of) {\n}", "int part(float of) {\n}"),
                     ("// struct Part {", "struct Part {\n};"), ("int a() {\n  int part = 1;\n}", "int b() {\n  int part = 1;\n}"),
                     ("using geometry::Vec3;", "using geometry::Vec3;"))
        for one, other in alike:
            self.assertTrue(lint_files.own_names(unnamed(one)) & lint_files.own_names(unnamed(other)), (one, other))
        for one, other in different:
            self.assertFalse(lint_files.own_names(unnamed(one)) & lint_files.own_names(unnamed(other)), (one, other))
        for name in self.names:
            self.write(name, unnamed("int part;\nint own = 1;") if name < "room/c" else "int part;")
        self.assertEqual(self.lint(*self.names), (0, ["all.cpp", "b.cpp"]))

    def test_a_rooms_folders_are_looked_at_together_each_with_its_headers(self):
        (self.root / "room/inner").mkdir()
        self.write("room/inner/a.cpp", "int main() {}")
        self.write("room/a.cpp", "int main() {}")
        entries = [{"directory": str(self.root), "file": str(self.root / name), "command": f"c++ {where} -c {self.root / name}"}
                   for name, where in (("room/a.cpp", "-I/one"), ("room/inner/a.cpp", "-isystem /other -I/one"))]
        self.write("build/compile_commands.json", json.dumps(entries))
        self.assertEqual(self.lint("room/a.cpp", "room/inner/a.cpp"), (0, ["all.cpp"]))
        together = self.root / "build/together/room__a.cpp"
        command = json.loads((together / "compile_commands.json").read_text())[0]["command"]
        self.assertEqual(command.split()[:2] + command.split()[-2:], ["c++", "-I/one", "-isystem", "/other"])
        mains = [line for line in (together / "all.cpp").read_text().splitlines() if line.startswith("#define main ")]
        self.assertEqual(len(set(mains)), 2, "two programs")

    def test_each_by_itself_where_asked(self):
        self.assertEqual(self.lint(*self.names, options=["--apart"]), (0, ["a.cpp", "b.cpp", "c.cpp", "d.cpp"]))

    def test_what_is_wrong_together_is_looked_for_by_halves(self):
        self.write("room/b.cpp", "wrong")
        self.assertEqual(self.lint(*self.names), (1, ["a.cpp", "all.cpp", "all.cpp", "all.cpp", "b.cpp"]))
        self.write("room/b.cpp", "right")
        self.assertEqual(self.lint(*self.names), (0, ["b.cpp"]))


if __name__ == "__main__":
    unittest.main()
