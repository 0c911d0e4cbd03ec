#!/usr/bin/env python3
"""clang-tidy on one source, unless it was clean before and nothing that it is made of has changed since.

Usage: lint_file.py BUILD CHECKS FILE
  BUILD   the folder of compile_commands.json; BUILD/clean remembers what was clean
  CHECKS  what clang-tidy's --checks gets beside .clang-tidy; may be empty
Prints FILE and the findings. Exit code: clang-tidy's.
"""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

INCLUDED = re.compile(r"^\.+ (.+)$")  # a line of -H: a dot for each level, and the header


def command_of(build, source):
    """How the source is compiled; None where the build does not know it."""
    entries = json.loads((build / "compile_commands.json").read_text())
    return next((entry["command"] for entry in entries if pathlib.Path(entry["file"]) == source), None)


def state_of(part, root):
    """What tells that a file is another: its content within the repository; elsewhere, where packages put it, its size and
    time."""
    try:
        if pathlib.Path(part).is_relative_to(root):
            return hashlib.sha256(pathlib.Path(part).read_bytes()).hexdigest()
        status = os.stat(part)
        return f"{status.st_size} {status.st_mtime_ns}"
    except OSError:
        return "absent"


def key_of(parts, command, checks, root):
    """A digest of all that a verdict depends on. `parts`: the source and every header of it."""
    tool = os.path.realpath(shutil.which("clang-tidy"))
    states = [f"{part} {state_of(part, root)}" for part in (*parts, str(root / ".clang-tidy"), tool)]
    return hashlib.sha256("\n".join([*states, str(command), checks]).encode()).hexdigest()


def was_clean(record, command, checks, root):
    try:
        known = json.loads(record.read_text())
        return known["key"] == key_of(known["parts"], command, checks, root)
    except (OSError, ValueError, KeyError, TypeError):
        return False


def headers_in(text):
    found = (INCLUDED.match(line) for line in text.splitlines())
    return sorted({os.path.realpath(match.group(1)) for match in found if match})


def remember(record, parts, key):
    record.parent.mkdir(parents=True, exist_ok=True)
    draft = record.with_suffix(".part")
    draft.write_text(json.dumps({"key": key, "parts": parts}))
    draft.replace(record)


def main():
    build, checks, name = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    root = pathlib.Path.cwd()
    source = (root / name).resolve()
    print(name, flush=True)
    record = build / "clean" / (name.replace("/", "__") + ".json")
    command = command_of(build, source)
    if was_clean(record, command, checks, root):
        return 0
    done = subprocess.run(["clang-tidy", "-p", str(build), "--quiet", f"--checks={checks}", "--warnings-as-errors=*",
                           "--extra-arg=-H", name], stderr=subprocess.PIPE, text=True, errors="replace", check=False)
    if done.returncode == 0:
        parts = [str(source), *headers_in(done.stderr)]
        remember(record, parts, key_of(parts, command, checks, root))
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
