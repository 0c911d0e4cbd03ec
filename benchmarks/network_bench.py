#!/usr/bin/env python3
"""Latencies and losses of whole sessions, as ratios to a bare UDP ping-pong of the same sizes over the same way in the same run.

A row is a way (one machine, three, a lossy link between them, the device on a machine of its own), the vendors, and whether
topics are secured: WAY/VENDORS/plain or WAY/VENDORS/secured. Its figures are the device's own: from a pose to the force, the
organ and the picture that take it into account, at the median, 99 % and 99.9 % (not of fewer than a thousand); poses without an
answer, and states that render_node lacks, by their numbers. Several machines are network namespaces, which need root.
Environment: OMENTUM_BIN and OMENTUM_CACHE, as for launch_scripts/run.
"""
import argparse
import fnmatch
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import network_session
from network_session import HOST_OF, REPOSITORY, SETTLE_S, Way
from launcher import keystore  # network_session knows where it is
import namespaces

SCENE = pathlib.Path(__file__).with_name("network_scene.toml")
LOSSY = ("--delay-ms", "1", "--loss")  # each way, of every frame
WAYS = {"loopback": Way("one machine"),
        "hosts": Way("three machines", ()),
        "lossy1": Way("three machines, 1 ms, 1 % lost", (*LOSSY, "0.01")),
        "lossy5": Way("three machines, 1 ms, 5 % lost", (*LOSSY, "0.05")),
        "apart": Way("as before with 1 %, the device on a fourth one", (*LOSSY, "0.01"), apart=True)}
FAST, CYCLONE = dict.fromkeys(HOST_OF, "fast"), dict.fromkeys(HOST_OF, "cyclone")
PAIRINGS = {"fast": FAST, "cyclone": CYCLONE,
            "mixed": {**FAST, "deform_node": "cyclone", "virtual_device": "cyclone"}}  # all three figures cross
KEYS = ("plain", "secured")
SHARES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}
LATENCIES = {"force": "tool_to_force_us", "organ": "tool_to_organ_us", "picture": "tool_to_picture_us"}
ENDING_S = 2  # of a row, about: the programs end, and write what they found


# the rows
def all_rows():
    return [f"{way}/{pairing}/{keys}" for way in WAYS for pairing in PAIRINGS for keys in KEYS]


def chosen_rows(patterns):
    """In the table's order. Raises ValueError for a pattern that names none."""
    def meant(row, pattern):
        return fnmatch.fnmatchcase(row, pattern) or pattern in row.split("/")

    for pattern in patterns:
        if not any(meant(row, pattern) for row in all_rows()):
            raise ValueError(f"--rows: found '{pattern}', expected WAY/VENDORS/KEYS or one of them, of {', '.join(WAYS)}; "
                             f"{', '.join(PAIRINGS)}; {', '.join(KEYS)}")
    return [row for row in all_rows() if not patterns or any(meant(row, pattern) for pattern in patterns)]


def positive(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number of seconds above 0")
    return value


# the figures
def entry(name, value, unit, reference):
    made = {"name": name, "value": value, "unit": unit, "reference": reference}
    if reference > 0:
        made["ratio"] = value / reference
    return made


def share_of(part, rest):
    return part / (part + rest) if part + rest else 0.0


def figures(row, reports, pinged):
    """A row's. A percentile that fewer samples lie beyond than one is left out."""
    found = []
    for what, field in LATENCIES.items():
        times, floor = reports["virtual_device"]["link"][field], pinged[what]["round_trip_us"]
        found += [entry(f"network/{row}/{what}/{name}", times[name], "us", floor[name])
                  for name, share in SHARES.items() if times["count"] > 0 and times["count"] * (1 - share) > 1 - 1e-9]
    hand, states = reports["virtual_device"], reports["render_node"]["organ_states"]
    lost = {what: share_of(ping["lost"], ping["sent"] - ping["lost"]) for what, ping in pinged.items()}
    came = states["whole"] + states["incomplete"]
    found.append(entry(f"network/{row}/poses_unanswered", share_of(hand["unanswered"], hand["link"][LATENCIES["force"]]["count"]),
                       "1", lost["force"]))
    found.append(entry(f"network/{row}/states_incomplete", share_of(states["incomplete"], states["whole"]), "1", lost["picture"]))
    found.append(entry(f"network/{row}/states_missing", share_of(states["missing"], came), "1", lost["picture"]))
    return found


# the table
HEAD = ("way", "vendors", "topics", "ping as pose and force, ms: 50, 99, 99.9 %", *(f"pose to {what} (x its ping)" for what in LATENCIES),
        "poses unanswered (pings lost)", "states that lack blocks, or all (pings lost)")


def short(number):
    """Three digits that count, and no exponent."""
    if number == 0:
        return "0"
    digits = max(0, 2 - math.floor(math.log10(abs(number))))
    return f"{number:.{digits}f}"


def milliseconds(times_us):
    return ", ".join(short(one / 1000) for one in times_us)


def latency_cell(found):
    """`found`: of one latency, in the order of SHARES."""
    if not found:
        return "none came"
    times = milliseconds(one["value"] for one in found)
    ratios = ", ".join(f"{one['ratio']:.1f}" if one.get("ratio", 10) < 10 else f"{one['ratio']:.0f}" for one in found if "ratio" in one)
    return times + (f" ({ratios})" if ratios else "")


def percent(share):
    return f"{100 * share:.1f} %"


def cells(row, found):
    way, vendors, keys = row.split("/")
    named = {one["name"]: one for one in found}

    def of(name):
        return named[f"network/{row}/{name}"]

    latencies = {what: [one for name, one in named.items() if name.startswith(f"network/{row}/{what}/")] for what in LATENCIES}
    poses, lacking, missing = of("poses_unanswered"), of("states_incomplete"), of("states_missing")
    return [WAYS[way].what, vendors, keys, milliseconds(one["reference"] for one in latencies["force"]),
            *map(latency_cell, latencies.values()), f"{percent(poses['value'])} ({percent(poses['reference'])})",
            f"{percent(lacking['value'])}, {percent(missing['value'])} ({percent(missing['reference'])})"]


def table_line(texts):
    return "| " + " | ".join(texts) + " |"


# the run
def prepared(programs, folder):
    """The scene, ready for the programs, with its organ. Ends the program where that failed, which said why."""
    done = subprocess.run([sys.executable, "-B", REPOSITORY / "launch_scripts" / "supervisor.py", SCENE, "--prepare", "--out", folder],
                          env={**os.environ, "OMENTUM_BIN": str(programs)}, stdout=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        sys.exit(f"network_bench: {SCENE.name} could not be prepared")
    return folder / "scene.toml"


def without_network(programs):
    """Why there are no several machines here; None where there are."""
    if not (programs / "lossy_hub").exists():
        return f"{programs} has no lossy_hub"
    return namespaces.obstacle()


def measure(rows, seconds, programs, folder):
    """(Figures, whether all was measured); prints each row as it is known."""
    if not (programs / "udp_ping").exists():
        sys.exit(f"network_bench: {programs} has no udp_ping; launch_scripts/bench network builds it")
    scene, store, found, whole = prepared(programs, folder), None, [], True
    if any(row.endswith("/secured") for row in rows):
        store = folder / "keys"
        keystore.make(store)
    print("\n".join((table_line(HEAD), "|" + "---|" * len(HEAD))), flush=True)
    for number, row in enumerate(rows):
        way, pairing, keys = row.split("/")
        try:
            played = network_session.play(programs, scene, WAYS[way], PAIRINGS[pairing], seconds, folder / str(number),
                                          store if keys == "secured" else None)
        except RuntimeError as error:
            print(f"network_bench: {row}: {error}", file=sys.stderr, flush=True)
            whole = False
            continue
        of_row = figures(row, *played)
        print(table_line(cells(row, of_row)), flush=True)
        found += of_row
    return found, whole


def main():
    parser = argparse.ArgumentParser(prog="network_bench", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--rows", nargs="+", default=[], metavar="ROW",
                        help="WAY/VENDORS/KEYS (* is any), or one of the three words; --list says which (default: all)")
    parser.add_argument("--seconds", type=positive, default=14.0, metavar="N", help="that a row's hand is there (default: 14)")
    parser.add_argument("--list", action="store_true", help="say which rows there are, and end")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write the figures there")
    arguments = parser.parse_args()
    try:
        rows = chosen_rows(arguments.rows)
    except ValueError as error:
        parser.error(str(error))
    if arguments.list:
        print("\n".join(rows))
        return 0
    programs = pathlib.Path(os.environ.setdefault("OMENTUM_BIN", str(REPOSITORY / "build" / "release" / "bin"))).resolve()
    why = without_network(programs)
    if why and any(WAYS[row.split("/")[0]].hub is not None for row in rows):
        print(f"network_bench: rows of several machines are left out: {why}")
        rows = [row for row in rows if WAYS[row.split("/")[0]].hub is None]
    print(f"network_bench: {len(rows)} rows, about {math.ceil(len(rows) * (SETTLE_S + arguments.seconds + ENDING_S) / 60)} minutes\n",
          flush=True)
    with tempfile.TemporaryDirectory(prefix="omentum-bench-") as folder:
        found, whole = measure(rows, arguments.seconds, programs, pathlib.Path(folder))
    if arguments.json:
        arguments.json.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    return 0 if whole else 1


if __name__ == "__main__":
    sys.exit(main())
