"""A hand whose haptic_node or whose organ is far away: what it feels, beside what it feels with all on one machine."""
import csv
import dataclasses
import json
import os
import pathlib
import signal
import subprocess
import time

from namespaces import Network

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
HERE, FAR = "theatre", "cluster"
ALL_HERE = {"haptic_node": HERE, "deform_node": HERE, "virtual_device": HERE}
ORGAN_FAR, HAND_FAR = {**ALL_HERE, "deform_node": FAR}, {**ALL_HERE, "virtual_device": FAR}
SLEW_N_PER_S = 2000  # scene::HapticsSpec's own: what a force may change
LIMIT_N = 10  # the scenes' max_force_n


@dataclasses.dataclass
class Felt:
    """Of the first hand; `forces_n`: number of the pose -> (tip in m, force on the hand in N), once it was steady."""
    forces_n: dict
    organs_seen: int
    to_organ_ms: float
    to_force_ms: float
    most_energy_j: float  # that a hand was given, at any moment, since it came
    energy_j: float  # ... at the end, all hands; less than none: they gave it
    rows: list

    def peak_n(self):
        return max((length(force) for _, force in self.forces_n.values()), default=0)

    def presses(self):
        """How often the force rose through half of its peak."""
        half_n = 0.5 * self.peak_n()
        pressed = [length(force) > half_n for _, force in self.forces_n.values()]
        return sum(now and not before for before, now in zip([False, *pressed], pressed))


def length(vector):
    return sum(part * part for part in vector) ** 0.5


def apart(one, other):
    return length([mine - theirs for mine, theirs in zip(one, other)])


def prepared(programs, scene, folder):
    """The project's scene made ready by the launcher, with its organs."""
    subprocess.run([REPOSITORY / "launch_scripts" / "supervisor.py", scene, "--prepare", "--out", folder], check=True,
                   stdout=subprocess.DEVNULL, env={**os.environ, "OMENTUM_BIN": str(programs)})
    return folder / "scene.toml"


def rows_of(log):
    """Of haptic_node's log: (pose's number, s, tip, force) of each new pose of the first tool."""
    with log.open() as file:
        rows = []
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            seq = int(row["tool0_seq"])
            if seq and (not rows or rows[-1][0] != seq):
                tip = tuple(float(row[f"tool0_{axis}_m"]) for axis in "xyz")
                force = tuple(float(row[f"tool0_f{axis}_n"]) for axis in "xyz")
                rows.append((seq, 1e-9 * int(row["start_ns"]), tip, force))
        return rows


def play(programs, scene, folder, seconds, hosts, vendors, *hub, device=()):
    """What a hand felt with the programs on these hosts, and the hub between them."""
    folder.mkdir(parents=True)
    network, nodes = Network(programs, *hub), {}
    own = {"haptic_node": ["--log", folder / "log.csv"], "virtual_device": device}
    try:
        for name, host in hosts.items():
            nodes[name] = network.start(host, [programs / name, "--scene", scene, "--dds", vendors[name], "--domain", "7",
                                               "--profile", "lan", "--report", folder / name, *own.get(name, [])])
        time.sleep(seconds)
    finally:
        for name in ("virtual_device", "haptic_node", "deform_node"):
            if name in nodes:
                nodes[name].send_signal(signal.SIGTERM)
                nodes[name].wait()
        network.close()
    report = json.loads((folder / "virtual_device").read_text())
    rows = rows_of(folder / "log.csv")
    organ, force = report["link"]["tool_to_organ_us"], report["link"]["tool_to_force_us"]
    return Felt({seq: (tip, force) for seq, _, tip, force in rows}, organ["count"], organ["p50"] / 1000, force["p50"] / 1000,
                max((one["most_energy_j"] for one in report["hands"]), default=0), report["energy_j"], rows)


def differences_n(one, other):
    """Sorted, of the forces that were felt at the same poses in both."""
    both = [(one.forces_n[seq], other.forces_n[seq]) for seq in one.forces_n.keys() & other.forces_n.keys()]
    return sorted(apart(mine[1], theirs[1]) for mine, theirs in both if apart(mine[0], theirs[0]) < 1e-9)


def steepest_n_per_s(felt):
    """The largest change of the force from an answer to the next, for the time between them (at least a period)."""
    return max((apart(before[3], after[3]) / max(after[1] - before[1], 1e-3) for before, after in zip(felt.rows, felt.rows[1:])),
               default=0)
