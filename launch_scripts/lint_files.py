"""clang-tidy on sources, but for those that were clean before and of which nothing has changed since.

Usage: lint_files.py BUILD CHECKS [--apart] FILE ...
  BUILD    the folder of compile_commands.json; BUILD/clean remembers what was clean
  CHECKS   what clang-tidy's --checks gets beside .clang-tidy; may be empty
  --apart  each source by itself, so that one that forgets an include is found too
Sources of one room that are compiled alike are looked at together, two dozen at once: most of the time goes to the headers
that they share. Those that name things of their own alike are not. Where something is found, they are looked at by halves,
down to each by itself.
Prints each FILE and its findings. Exit code: 1 where there are any.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from launcher.telling import tell

TOGETHER = 24
INCLUDED = re.compile(r"^\.+ (.+)$")  # a line of -H: a dot for each level, and the header
QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
OUTPUT = re.compile(r" -o \S+")
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"^(?:struct|class|enum(?: class)?) (\w+)|^(?!template)[^\s/#}][^(={\[;\n]*?\b(\w+\(.*|\w+ *[={\[])",
                   re.MULTILINE)
INCLUDES = re.compile(r" (?:-I|-isystem) ?\S+")


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


def headers_in(text):
    found = (INCLUDED.match(line) for line in text.splitlines())
    return sorted({os.path.realpath(match.group(1)) for match in found if match})


def parts_of(source, headers, root):
    """The source, what it includes of the repository (of all `headers`, others may be a neighbour's), and packages' headers."""
    own = {header for header in headers if pathlib.Path(header).is_relative_to(root)}
    reached, waiting = set(), [str(source)]
    while waiting:
        part = waiting.pop()
        if part not in reached:
            reached.add(part)
            names = QUOTED.findall(pathlib.Path(part).read_text(encoding="utf-8", errors="replace"))
            waiting += [header for header in own if any(header.endswith("/" + name.lstrip("./")) for name in names)]
    return sorted(reached | (set(headers) - own))


class Lint:
    """clang-tidy in one build folder, with one choice of checks."""

    def __init__(self, build, checks, root):
        self.build, self.checks, self.root = build, checks, root
        entries = json.loads((build / "compile_commands.json").read_text())
        self.commands = {os.path.realpath(entry["file"]): entry["command"] for entry in entries}

    def command_of(self, name):
        """How the source is compiled; None where the build does not know it."""
        return self.commands.get(str(self.root / name))

    def record_of(self, name):
        return self.build / "clean" / (name.replace("/", "__") + ".json")

    def was_clean(self, name):
        try:
            known = json.loads(self.record_of(name).read_text())
            return known["key"] == key_of(known["parts"], self.command_of(name), self.checks, self.root)
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def remember(self, name, headers):
        parts = parts_of(self.root / name, headers, self.root)
        record = self.record_of(name)
        record.parent.mkdir(parents=True, exist_ok=True)
        draft = record.with_suffix(".part")
        draft.write_text(json.dumps({"key": key_of(parts, self.command_of(name), self.checks, self.root), "parts": parts}))
        draft.replace(record)

    def tidy(self, source, folder, checks):
        return subprocess.run(["clang-tidy", "-p", str(folder), "--quiet", f"--checks={checks}", "--warnings-as-errors=*",
                               "--extra-arg=-H", str(source)], capture_output=True, text=True, errors="replace",
                              check=False)

    def alone(self, name):
        """True if clean. Its findings are printed."""
        done = self.tidy(name, self.build, self.checks)
        if done.returncode == 0:
            self.remember(name, headers_in(done.stderr))
        tell(f"{name}\n{done.stdout}".removesuffix("\n"))
        return done.returncode == 0

    def together(self, names):
        """True if all are clean: sources of one folder, as one that includes them all. Nothing is printed where not."""
        folder = self.build / "together" / names[0].replace("/", "__")
        folder.mkdir(parents=True, exist_ok=True)
        source = folder / "all.cpp"
        # each program's main by a name of its own
        source.write_text("".join(f'#define main main_{number}\n#include "{self.root / name}"\n#undef main\n'
                                  for number, name in enumerate(names)))
        command = self.command_of(names[0]).replace(str(self.root / names[0]), str(source))
        known = INCLUDES.findall(command)
        for name in names[1:]:
            more = [folder for folder in INCLUDES.findall(self.command_of(name)) if folder not in known]
            command, known = command + "".join(more), known + more
        (folder / "compile_commands.json").write_text(
            json.dumps([{"directory": str(self.build.resolve()), "file": str(source), "command": command}]))
        checks = ",".join(part for part in (self.checks, "-bugprone-suspicious-include") if part)
        done = self.tidy(source, folder, checks)
        if done.returncode != 0:
            return False
        headers = [header for header in headers_in(done.stderr) if header not in {str(self.root / name) for name in names}]
        for name in names:
            self.remember(name, headers)
        tell("\n".join(names))
        return True

    def batch(self, names):
        """True if all are clean; by halves where together they are not (two that name things alike are no finding)."""
        if len(names) == 1:
            return self.alone(names[0])
        middle = len(names) // 2
        return self.together(names) or all([self.batch(names[:middle]), self.batch(names[middle:])])


def own_names(text):
    """What a source names for itself, functions with what they take: two that name things alike cannot be compiled as one."""
    inner = "".join(UNNAMED.findall(text))
    return {name for names in NAMED.findall(inner) for name in names if name}


def batches_of(names, lint):
    """Lists of names of one room that are compiled alike (but for where their headers are) and name nothing alike, the
    long ones first."""
    alike = {}
    for name in names:
        command = lint.command_of(name)
        how = name if command is None else INCLUDES.sub("", OUTPUT.sub("", command)).replace(str(lint.root / name), "")
        alike.setdefault((name.split("/")[0], how), []).append(name)
    found = []
    for group in alike.values():
        most = -(-len(group) // -(-len(group) // TOGETHER))  # in each, of as few as can be
        batches = []
        for name in group:
            own = own_names((lint.root / name).read_text(encoding="utf-8", errors="replace"))
            for members, taken in batches:
                if len(members) < most and own.isdisjoint(taken):
                    break
            else:
                members, taken = [], set()
                batches.append((members, taken))
            members.append(name)
            taken |= own
        found += [members for members, _ in batches]
    return sorted(found, key=len, reverse=True)


def main():
    arguments = sys.argv[1:]
    apart = "--apart" in arguments
    build, checks, *names = [argument for argument in arguments if argument != "--apart"]
    lint = Lint(pathlib.Path(build).resolve(), checks, pathlib.Path.cwd().resolve())
    clean = {name for name in names if lint.was_clean(name)}
    if clean:
        tell("\n".join(sorted(clean)))
    left = [name for name in names if name not in clean]
    batches = [[name] for name in left] if apart else batches_of(left, lint)
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        return 0 if all(list(pool.map(lint.batch, batches))) else 1


if __name__ == "__main__":
    sys.exit(main())
