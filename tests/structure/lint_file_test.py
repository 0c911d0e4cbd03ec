"""launch_scripts/lint_file.py: what is looked at again, with a clang-tidy that notes its calls."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "launch_scripts" / "lint_file.py"
TIDY = """#!/bin/sh
echo called >>"$CALLS"
echo ". $PWD/room/part.h" >&2
echo ".. /usr/include/stdio.h" >&2
exit "${VERDICT:-0}"
"""


class LintFileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name in ("bin", "room", "build"):
            (self.root / name).mkdir()
        self.write("bin/clang-tidy", TIDY)
        (self.root / "bin/clang-tidy").chmod(0o755)
        self.write(".clang-tidy", "Checks: one")
        self.write("room/part.cpp", "int part;")
        self.write("room/part.h", "extern int part;")
        self.compiled_by("c++ -O1")

    def write(self, name, text):
        (self.root / name).write_text(text)

    def compiled_by(self, command):
        entry = {"directory": str(self.root), "file": str(self.root / "room/part.cpp"), "command": command}
        self.write("build/compile_commands.json", json.dumps([entry]))

    def lint(self, checks="", verdict=0):
        """Exit code, and whether clang-tidy was called."""
        calls = self.root / "calls"
        calls.unlink(missing_ok=True)
        environment = {**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}", "CALLS": str(calls),
                       "VERDICT": str(verdict)}
        done = subprocess.run([sys.executable, "-B", SCRIPT, "build", checks, "room/part.cpp"], cwd=self.root,
                              env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.stdout, "room/part.cpp\n", done.stderr)
        return done.returncode, calls.exists()

    def test_a_clean_file_is_looked_at_once(self):
        self.assertEqual(self.lint(), (0, True))
        self.assertEqual(self.lint(), (0, False))

    def test_a_file_with_findings_is_looked_at_until_it_has_none(self):
        self.assertEqual(self.lint(verdict=1), (1, True))
        self.assertEqual(self.lint(verdict=1), (1, True))
        self.assertEqual(self.lint(), (0, True))

    def test_whatever_it_is_made_of_makes_it_another(self):
        changes = (lambda: self.write("room/part.cpp", "int part = 1;"),
                   lambda: self.write("room/part.h", "extern int part, other;"),
                   lambda: (self.root / "room/part.h").unlink(),
                   lambda: self.write(".clang-tidy", "Checks: two"),
                   lambda: self.compiled_by("c++ -O2"),
                   lambda: self.write("bin/clang-tidy", TIDY + "# newer\n"))
        self.lint()
        for number, change in enumerate(changes):
            change()
            self.assertEqual(self.lint(), (0, True), number)
            self.assertEqual(self.lint(), (0, False), number)
        self.assertEqual(self.lint(checks="-one"), (0, True))

    def test_a_broken_memory_is_none(self):
        self.lint()
        self.write("build/clean/room__part.cpp.json", "{")
        self.assertEqual(self.lint(), (0, True))


if __name__ == "__main__":
    unittest.main()
