#!/usr/bin/env python3
"""Adds up ctest's JUnit files: prints `N passed, N failed, N skipped`; exit code 1 when anything failed.

A step that failed without a failing test (a build, the lint) counts as one failure.
"""
import argparse
import sys
import xml.etree.ElementTree as xml


def count(files):
    passed = failed = skipped = 0
    for file in files:
        suite = xml.parse(file).getroot()
        for case in suite.iter("testcase"):
            if case.find("failure") is not None or case.get("status") == "fail":
                failed += 1
                print(f"failed: {case.get('name')}")
            elif case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
                skipped += 1
            else:
                passed += 1
    return passed, failed, skipped


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
