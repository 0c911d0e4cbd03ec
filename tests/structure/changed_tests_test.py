"""launch_scripts/changed_tests.py: what is run again, with a ctest that notes which tests it was told to run."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "launch_scripts" / "changed_tests.py"
LABELS = {"pure_test": "unit", "clock_test": "realtime", "tool_test": "unit"}
CTEST = """#!/usr/bin/env python3
import json, os, pathlib, sys
tests = json.loads(pathlib.Path("tests.json").read_text())
if "--show-only=json-v1" in sys.argv:
    print(json.dumps({"tests": tests}))
    sys.exit()
told = [int(number) for number in sys.argv[sys.argv.index("-I") + 1].split(",")[3:]]
ran = [tests[number - 1]["name"] for number in told]
pathlib.Path("ran").write_text(" ".join(ran))
failing = os.environ.get("FAILING", "")
cases = [f'<testcase name="{name}" status="{"fail" if name == failing else "run"}"/>' for name in ran]
pathlib.Path(sys.argv[sys.argv.index("--output-junit") + 1]).write_text("<testsuite>" + "".join(cases) + "</testsuite>")
sys.exit(failing in ran)
"""


class ChangedTestsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve() / "clone"
        for name in ("build/bin", "build/tests/started", "scenes"):
            (self.root / name).mkdir(parents=True)
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write(".gitignore", "/build/\n/ran\n/results.xml\n/ctest\n")
        self.write("ctest", CTEST)
        (self.root / "ctest").chmod(0o755)
        for program in (*LABELS, "tool"):
            shutil.copy("/bin/true", self.root / "build/bin" / program)
            self.write(f"build/tests/started/{program}", "tool" if program == "tool_test" else "")
        self.write("tests.json", json.dumps([
            {"name": f"{program}.{case}", "command": [str(self.root / "build/bin" / program)],
             "properties": [{"name": "LABELS", "value": [label]}]}
            for program, label in LABELS.items() for case in "ab"]))

    def write(self, name, text):
        (self.root / name).write_text(text)

    def rebuild(self, program):
        with open(self.root / "build/bin" / program, "ab") as file:
            file.write(b"newer")

    def run_it(self, *options, failing=""):
        """The exit code, and the programs whose tests were run, in order."""
        for name in ("ran", "results.xml"):
            (self.root / name).unlink(missing_ok=True)
        done = subprocess.run([sys.executable, "-B", SCRIPT, *options, "build", "./ctest", "--output-junit", "results.xml"],
                              cwd=self.root, env={**os.environ, "FAILING": failing}, capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        ran = (self.root / "ran").read_text().split() if (self.root / "ran").exists() else []
        return done.returncode, list(dict.fromkeys(name.split(".")[0] for name in ran))

    def test_what_hangs_on_a_clock_is_run_again_and_the_rest_once(self):
        self.assertEqual(self.run_it(), (0, list(LABELS)))
        self.assertEqual(self.run_it(), (0, ["clock_test"]))
        self.assertEqual(self.run_it("--again"), (0, list(LABELS)))

    def test_a_program_with_a_failure_is_run_until_it_has_none(self):
        self.assertEqual(self.run_it(failing="pure_test.b"), (1, list(LABELS)))
        self.assertEqual(self.run_it(failing="pure_test.b"), (1, ["pure_test", "clock_test"]))
        self.assertEqual(self.run_it(), (0, ["pure_test", "clock_test"]))
        self.assertEqual(self.run_it(), (0, ["clock_test"]))

    def test_a_program_and_what_it_starts_make_its_tests_others(self):
        self.run_it()
        self.rebuild("pure_test")
        self.assertEqual(self.run_it(), (0, ["pure_test", "clock_test"]))
        self.rebuild("tool")
        self.assertEqual(self.run_it(), (0, ["clock_test", "tool_test"]))

    def test_data_makes_all_tests_others_and_prose_none(self):
        self.run_it()
        self.write("scenes/new.toml", "")
        self.assertEqual(self.run_it(), (0, list(LABELS)))
        data = self.root.parent / "shared" / "data"
        data.mkdir(parents=True)
        (data / "a.msh").write_text("")
        self.assertEqual(self.run_it(), (0, list(LABELS)))
        self.write("README.md", "")
        self.assertEqual(self.run_it(), (0, ["clock_test"]))

    def test_a_broken_memory_is_none(self):
        self.run_it()
        self.write("build/passed", "{")
        self.assertEqual(self.run_it(), (0, list(LABELS)))


if __name__ == "__main__":
    unittest.main()
