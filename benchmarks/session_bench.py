#!/usr/bin/env python3
"""Jitter of whole sessions, as a ratio to the machine's own: cyclictest (package rt-tests) runs beside each of them.

idle: nobody holds a tool. busy: the default scene, pressed by its hands. Rows: by how much the haptic loop's period is too
long, from the hand to its force (microseconds), and the ticks that were missed; each beside what cyclictest met at the
same time: how late a thread above all others wakes up. Without cyclictest the figures stand alone.
Environment: OMENTUM_BIN and OMENTUM_CACHE, as for launch_scripts/run.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
SESSIONS = {"idle": ["--device", "none"], "busy": []}
SHARES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}
PERIOD_US = 1000
LONGEST_US = 200_000  # of cyclictest's histogram
PRIORITY = 80  # above the hand's loop (60): what the kernel and a hypervisor leave to anybody


# the floor
def start_floor(seconds, out):
    """cyclictest for so long, its result in `out`; at ordinary priority where no other is permitted."""
    permitted = subprocess.run(["chrt", "--fifo", str(PRIORITY), "true"], stderr=subprocess.DEVNULL, check=False).returncode == 0
    priority = [f"--priority={PRIORITY}"] if permitted else ["--policy=other"]
    # --default-system: the session must not be the quicker for being measured
    return subprocess.Popen(["cyclictest", "--quiet", "--default-system", "--mlockall", f"--interval={PERIOD_US}",
                             f"--duration={seconds:g}", f"--histogram={LONGEST_US}", f"--json={out}", *priority],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def finish_floor(process, result):
    """What floor_of says; {} where cyclictest failed, which is said."""
    _, err = process.communicate()
    if process.returncode == 0:
        return floor_of(json.loads(result.read_text(encoding="utf-8")))
    print(f"session_bench: warning: cyclictest: {(err.strip().splitlines() or ['no reason given'])[-1]}", file=sys.stderr)
    return {}


def quantile(counts, total, share, longest):
    """Of (value, count) pairs in rising order; what they leave out is as large as `longest`."""
    reached = 0
    for value, count in counts:
        reached += count
        if reached >= share * total:
            return float(value)
    return float(longest)


def floor_of(result):
    """From cyclictest's JSON: how late its thread woke up, us, and the share of its wake-ups that were a period late."""
    thread = result["thread"]["0"]
    counts = sorted((int(us), count) for us, count in thread["histogram"].items())
    total = thread["cycles"]
    floor = {name: quantile(counts, total, share, thread["max"]) for name, share in SHARES.items()}
    in_time = sum(count for us, count in counts if us < PERIOD_US)
    return {**floor, "missed": (total - in_time) / total if total else 0.0}


# the figures
def entry(name, value, unit, reference=None):
    made = {"name": name, "value": value, "unit": unit}
    if reference is not None:
        made["reference"] = reference
        if reference > 0:
            made["ratio"] = value / reference
    return made


def figures(kind, report, floor):
    """A session's, from its report.json and what floor_of says (or {})."""
    haptic, machine = report["nodes"]["haptic_node"], report["machine"]
    loop, hand = haptic["loop"], report["nodes"].get("virtual_device")
    found = []
    for share in SHARES:
        late = loop["period_us"][share] - PERIOD_US
        if share != "p50":  # in the middle a period is as long as it should be
            found.append(entry(f"session/{kind}/period_jitter/{share}", late, "us", floor.get(share)))
        if hand:
            found.append(entry(f"session/{kind}/hand_to_force/{share}", hand["round_trip_us"][share], "us", floor.get(share)))
    missed = loop["missed"] / loop["ticks"] if loop["ticks"] else 0.0
    found.append(entry(f"session/{kind}/missed", missed, "1", floor.get("missed")))
    found.append(entry(f"session/{kind}/steal_share", machine["steal_share"], "1"))
    return found


def measure(kind, seconds, folder):
    out, result = folder / kind, folder / f"{kind}.json"
    floor = start_floor(seconds, result) if shutil.which("cyclictest") else None
    done = subprocess.run(
        [sys.executable, "-B", REPOSITORY / "launch_scripts" / "supervisor.py", "--headless", "--seconds", str(seconds),
         "--out", out, *SESSIONS[kind]], stdout=subprocess.DEVNULL, check=False)
    found = finish_floor(floor, result) if floor else {}
    if done.returncode != 0:
        sys.exit(f"session_bench: the {kind} session ended with code {done.returncode}")
    return figures(kind, json.loads((out / "report.json").read_text(encoding="utf-8")), found)


def line(figure):
    scale, unit = (1, "us") if figure["unit"] == "us" else (1000, "in 1000")
    text = f"{figure['name']:36}{scale * figure['value']:10.1f} {unit:8}"
    if "reference" in figure:
        text += f"  floor {scale * figure['reference']:8.1f}"
    if "ratio" in figure:
        text += f"  x{figure['ratio']:.2f}"
    return text.rstrip()


def main():
    parser = argparse.ArgumentParser(prog="session_bench", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--seconds", type=float, default=15.0, metavar="N", help="of each session (default: 15)")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write the figures there")
    arguments = parser.parse_args()
    os.environ.setdefault("OMENTUM_BIN", str(REPOSITORY / "build" / "release" / "bin"))
    if not shutil.which("cyclictest"):
        print("session_bench: cyclictest is absent (Debian: apt install rt-tests): no floor to compare with")
    found = []
    with tempfile.TemporaryDirectory(prefix="omentum-bench-") as folder:
        for kind in SESSIONS:
            found += measure(kind, arguments.seconds, pathlib.Path(folder))
    print("\n".join(map(line, found)))
    if arguments.json:
        arguments.json.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
