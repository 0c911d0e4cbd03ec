#!/usr/bin/env python3
"""ctest, without the unit tests that passed before and of which nothing has changed since.

Usage: changed_tests.py [--again] BUILD ctest ARGUMENT ... --output-junit FILE ...
  --again  all of them
  BUILD    the build folder; BUILD/passed remembers whose tests all passed, and as what
A test is left out where it is labelled unit (its outcome hangs on no clock, thread or other process), and where its
program, the programs that this starts (BUILD/tests/started), the libraries of all of these, the data in the repository
and beside it, the processor and the environment are as they were when all tests of the program passed. Exit code: ctest's.
"""
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

from launcher.telling import tell

LIBRARY = re.compile(r"(?:=> )?(/\S+) \(0x")  # in a line of ldd
UNREAD = (".cpp", ".h", ".md")  # by test programs: what they are made of, and what people read
DATA = pathlib.Path("..") / "shared" / "data"
ENVIRONMENT = re.compile(r"(OMENTUM|ASAN|UBSAN|LSAN|OMP|OPENBLAS)_")


def digest(*parts):
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()


def content(file):
    try:
        return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()
    except OSError:
        return "absent"


def stamp(file):
    """For what is large and comes with packages or as data."""
    status = os.stat(file)
    return f"{file} {status.st_size} {status.st_mtime_ns}"


def surroundings():
    """A digest of what any test may read, and of the machine."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], stdout=subprocess.PIPE,
                            text=True, check=True).stdout.split("\0")
    read = [f"{name} {content(name)}" for name in sorted(filter(None, listed)) if not name.endswith(UNREAD)]
    data = [stamp(file) for file in sorted(DATA.rglob("*")) if file.is_file()]
    processor = [line for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("flags")][:1]
    environment = sorted(f"{name}={value}" for name, value in os.environ.items() if ENVIRONMENT.match(name))
    return digest(*read, *data, *processor, os.cpu_count(), *environment)


def key_of(program, build, around):
    """A digest of all that the outcome of the program's tests depends on."""
    started = build / "tests" / "started" / program.name
    programs = [program, *(program.parent / name for name in started.read_text().split(";") if name.strip())]
    told = subprocess.run(["ldd", *programs], capture_output=True, text=True, check=False).stdout
    libraries = sorted({os.path.realpath(path) for path in LIBRARY.findall(told)})
    return digest(around, *map(content, programs), *map(stamp, libraries))


def labels_of(test):
    return next((entry["value"] for entry in test["properties"] if entry["name"] == "LABELS"), [])


def repeatable(tests, build):
    """Program -> its tests' names, of the test programs that are all unit tests."""
    programs = {}
    for test in tests:
        programs.setdefault(pathlib.Path(test.get("command", ["none"])[0]), []).append(test)
    return {program: [test["name"] for test in own] for program, own in programs.items()
            if (build / "tests" / "started" / program.name).is_file() and all(labels_of(test) == ["unit"] for test in own)}


def passed_in(results):
    if not results.is_file():
        return set()
    return {case.get("name") for case in xml.parse(results).getroot().iter("testcase") if case.get("status") == "run"}


def load(record):
    try:
        known = json.loads(record.read_text())
    except (OSError, ValueError):
        return {}
    return known if isinstance(known, dict) else {}


def main():
    words = sys.argv[1:]
    again = words[0] == "--again"
    build, *ctest = words[again:]
    build, record = pathlib.Path(build), pathlib.Path(build) / "passed"
    results = pathlib.Path(ctest[ctest.index("--output-junit") + 1])
    listed = subprocess.run([*ctest, "--show-only=json-v1"], stdout=subprocess.PIPE, text=True, check=False)
    if listed.returncode != 0:
        return listed.returncode
    tests = json.loads(listed.stdout)["tests"]
    around, known = surroundings(), {} if again else load(record)
    programs = repeatable(tests, build)
    keys = {program: digest(key_of(program, build, around), *names) for program, names in programs.items()}
    settled = {name for program, names in programs.items() if known.get(program.name) == keys[program] for name in names}
    chosen = [str(number) for number, test in enumerate(tests, 1) if test["name"] not in settled]
    if settled:
        tell(f"test: {len(settled)} unit tests passed as they are now: not run again (--again runs them)")
    code = subprocess.run([*ctest, "-I", ",".join(["0", "0", "0", *chosen])], check=False).returncode if chosen else 0

    passed = passed_in(results) | settled
    record.write_text(json.dumps({program.name: keys[program] for program, names in programs.items()
                                  if passed.issuperset(names)}))
    return code


if __name__ == "__main__":
    sys.exit(main())
