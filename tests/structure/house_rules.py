#!/usr/bin/env python3
"""Who may include what (docs/architecture.md, "The floors"), that documents which are cited are there, that clang-tidy looks
at every room, and that nothing lies about which is no source: prints FILE:LINE for every breach.

Usage: house_rules.py ROOT      exit code 0: none; 1: breaches, one a line
"""
import pathlib
import re
import sys

# what each room may use beside itself
FLOORS = {
    "files": set(),
    "geometry": set(),
    "physics": {"geometry"},
    "organ": {"files", "geometry", "physics"},
    "idl": set(),
    "transport": {"files", "idl"},
    "runtime": {"files", "idl"},
    "scene": {"files", "geometry", "idl"},
    "node_common": {"files", "geometry", "organ", "idl", "transport", "runtime", "scene"},
}
STANDING_ON = set(FLOORS)
PROGRAMS = {"haptic_node", "deform_node", "render_node", "device_bridge", "ros_bridge", "session_tools", "organ_tools"}
FREE = {"tests", "benchmarks"}  # may look into every room
ROOMS = set(FLOORS) | PROGRAMS | FREE
NO_ROOMS = ("build", "install", "cmake", ".")  # how the folders are called that may hold sources without being a room
GENERATED = {"messages": "idl"}  # folders of generated headers, and the room that makes them

# (pattern of a header, the folders that may include it, what it is)
VENDORS = [
    (re.compile(r"(fastdds|fastrtps|fastcdr|dds|ddsc|idlc|ddscxx)/"), ("transport/", "device_bridge/examples/", "ros_bridge/wire/"), "a DDS header"),
    (re.compile(r"(epoxy|GL|GLES\d?|EGL|GLFW|KHR)/|(.*/)?imgui_impl_"), ("render_node/gl/",), "an OpenGL or window header"),
    (re.compile(r"(linux/(input|hidraw|uinput|joystick)|libevdev|hidapi|libusb|HD|HDU|libudev|dhdc|drdc)\b"),
     ("device_bridge/",), "a device's header"),
    (re.compile(r"CGAL/"), ("organ_tools/phantom/",), "a GPL header of CGAL (docs/decisions.md 8)"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".hpp", ".cpp", ".cc", ".c", ".cxx", ".in"}
CITING = SOURCES | {".idl", ".py", ".toml", ".md"}  # what may cite a document, in rooms and in:
TELLING = {"docs", "launch_scripts", "scenes"}
DOCUMENT = re.compile(r'([\w./-]+\.md)\b(?:, "([^"]+)")?')  # with a section's name, where one is given
NODES = ("haptic_node", "deform_node", "render_node", "device_bridge")
# (file that lists the rooms which clang-tidy looks at, its line, the sources that it takes)
LINT_LISTS = [
    ("launch_scripts/lint", re.compile(r"rooms='([\w|]*)'"), ".cpp"),
    (".clang-tidy", re.compile(r"HeaderFilterRegex:.*?/\(([\w|]*)\)/"), ".h"),
]
LEFT_ABOUT = {".deb", ".rpm", ".tar", ".gz", ".xz", ".zip", ".whl", ".o", ".a", ".so"}
MAIN_LINES = 60  # a node's main parses, builds, runs and gives the exit code; no more


def allowed_rooms(room):
    if room in FREE:
        return ROOMS
    if room in PROGRAMS:
        return STANDING_ON | {room}
    return FLOORS[room] | {room}


def breach_of(path, target, quoted):
    """Why the file `path` (relative, with slashes) must not include `target`; None when it may."""
    for pattern, folders, what in VENDORS:
        if pattern.match(target) and not path.startswith(folders):
            return f"includes {what} ({target}); only {' and '.join(folders)} may"
    if ".." in target.split("/"):
        return f"includes {target}; say it from the root of the repository"
    room, used = path.split("/")[0], target.split("/")[0]
    used = GENERATED.get(used, used)
    if used in ROOMS and "/" in target and used not in allowed_rooms(room):
        return f"{room} includes {target}; it may use {', '.join(sorted(allowed_rooms(room) - {room})) or 'no other room'}"
    if quoted and "/" in target and used not in ROOMS and not any(pattern.match(target) for pattern, _, _ in VENDORS):
        return f"includes {target}; {used} is no room (another's header belongs in <>)"
    return None


def sources(root, suffixes=frozenset(SOURCES)):
    """Every source below `root` but those of NO_ROOMS."""
    for top in sorted(root.iterdir()):
        if not top.name.startswith(NO_ROOMS):
            for file in sorted(top.rglob("*")) if top.is_dir() else [top]:
                if file.suffix in suffixes and file.is_file():
                    yield file


def wrong_citations(root):
    """Documents, and sections of them, that are cited and not there."""
    found = []
    for file in sources(root, CITING):
        if file.parent != root and file.relative_to(root).parts[0] not in ROOMS | TELLING:
            continue
        for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
            for name, section in DOCUMENT.findall(line):
                document = next((d for d in (root / name, root / "docs" / name) if d.is_file()), None)
                headings = document.read_text(encoding="utf-8").splitlines() if document and section else []
                if document is None or (section and not any(re.fullmatch("#+ " + re.escape(section), h) for h in headings)):
                    cited = f'{name}, "{section}"' if section else name
                    found.append(f"{file.relative_to(root).as_posix()}:{number}: cites {cited}, which is not there")
    return found


def breaches(root):
    found = []
    for file in sources(root):
        path = file.relative_to(root).as_posix()
        if path.split("/")[0] not in ROOMS:
            found.append(f"{path}:1: lies in no room; rooms are {', '.join(sorted(ROOMS))}")
            continue
        lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            reason = breach_of(path, match.group(2), match.group(1) == '"') if match else None
            if reason:
                found.append(f"{path}:{number}: {reason}")
        if file.name == "main.cpp" and path.startswith(NODES) and len(lines) > MAIN_LINES:
            found.append(f"{path}:{len(lines)}: a node's main has at most {MAIN_LINES} lines")
    return found


def left_about(root):
    """Packages, archives and built files that a commit took along."""
    return [f"{file.relative_to(root).as_posix()}:1: is nobody's source" for file in sources(root, LEFT_ABOUT)]


def unlinted_rooms(root):
    """Rooms with sources that clang-tidy would pass over in silence, and names in its lists that are no room's."""
    found = []
    for path, pattern, suffix in LINT_LISTS:
        rooms = {file.relative_to(root).parts[0] for file in sources(root, {suffix})} & (ROOMS - FREE)
        lines = (root / path).read_text(encoding="utf-8").splitlines() if (root / path).is_file() else []
        listed = [(number, match) for number, line in enumerate(lines, 1) if (match := pattern.match(line))]
        number, names = (listed[0][0], set(listed[0][1].group(1).split("|"))) if listed else (1, set())
        found += [f"{path}:{number}: leaves out {room}, which has {suffix} files" for room in sorted(rooms - names)]
        found += [f"{path}:{number}: names {name}, which is no room" for name in sorted(names - ROOMS)]
    return found


def main():
    if len(sys.argv) != 2:
        print("usage: house_rules.py ROOT", file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    found = breaches(root) + wrong_citations(root) + unlinted_rooms(root) + left_about(root)
    print("\n".join(found) if found else "no breach")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
