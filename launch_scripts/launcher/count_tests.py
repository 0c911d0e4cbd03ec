#!/usr/bin/env python3
"""Adds up ctest's JUnit files: prints `N passed, N failed, N skipped`; exit code 1 when anything failed.

A test that could not run (its program is missing, what prepares it failed) has failed; only a test that said so itself
was skipped. A step that failed without a failing test (a build, the lint) counts as one failure.
"""
import argparse
import sys
import xml.etree.ElementTree as xml


def outcome(case):
    if case.get("status") == "run":
        return "passed"
    skip = case.find("skipped")
    said_so = skip is not None and skip.get("message", "").startswith("SKIP_")
    return "skipped" if said_so or case.get("status") == "disabled" else "failed"


def count(files):
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for file in files:
        for case in xml.parse(file).getroot().iter("testcase"):
            what = outcome(case)
            counts[what] += 1
            if what != "passed":
                print(f"{what}: {case.get('name')}")
    return counts.values()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--failed-steps", type=int, default=0)
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    files = [file for file in arguments.files if not file.endswith("*.xml")]
    passed, failed, skipped = count(files)
    if failed == 0:
        failed = arguments.failed_steps
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
