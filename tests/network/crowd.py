#!/usr/bin/env python3
"""What a crowd costs, measured and not judged: docs/machines.md has the figures.

Usage: crowd.py PROGRAMS SCENE [VENDOR ...]      the folder of the programs; a prepared scene

First the hub between three namespaces counts what participants say that have nothing to tell: packets and bytes a second,
by how many they are, in one domain or in several. Then twenty onlookers join a session that plays: ticks of haptic_node
that were missed, and its periods and computing times, before and after in one run.
"""
import csv
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

from namespaces import HOSTS, SKIPPED, Network, obstacle

SETTLE_S, COUNT_S = 6, 10  # all have found each other; what is counted
JOIN_S = 6  # from the start of onlookers until they are found
LATE_NS = 1_500_000  # half of a period too late
CROWD = 20


def start_onlookers(network, programs, host, count, vendor, domain):
    """They listen once this returns."""
    started = subprocess.Popen([*network.within(host), programs / "onlookers", "--count", str(count), "--dds", vendor, "--domain",
                                str(domain), "--profile", "lan"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    started.stdout.readline()
    return started


def end_onlookers(onlookers):
    return json.loads(onlookers.communicate()[0])


def chatter(programs, vendor, groups, seconds):
    """What the hub saw of idle participants in so long: `groups` has (host, how many, domain)."""
    network = Network(programs)
    try:
        onlookers = [start_onlookers(network, programs, host, count, vendor, domain) for host, count, domain in groups]
        time.sleep(seconds)
        for one in onlookers:
            end_onlookers(one)
    finally:
        told = network.close()
    return told


def tell_chatter(programs, vendor, tables, each):
    """`each` participants on each of three hosts in each of so many domains: with the start's exchange taken off."""
    groups = [(host, each, 7 + table) for table in range(tables) for host in HOSTS]
    short, long = (chatter(programs, vendor, groups, seconds) for seconds in (SETTLE_S, SETTLE_S + COUNT_S))
    rate = {what: (long[what] - short[what]) / COUNT_S for what in long}
    print(f"{vendor:8} {tables:2} domains of {3 * each:2} participants: {rate['frames']:6.0f} packets/s ({rate['shared_frames']:.0f} of them "
          f"multicast), {rate['bytes'] / 1000:7.1f} kB/s; joining took {short['frames'] - SETTLE_S * rate['frames']:.0f} more", flush=True)


def quantile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] / 1000 if ordered else float("nan")


def tell_ticks(what, rows):
    periods, computes = [period for _, period, _ in rows], [compute for _, _, compute in rows]
    late = sum(period > LATE_NS for period in periods)
    print(f"{what}: {len(rows)} ticks, {late} late by half a period or more; period p99 {quantile(periods, 0.99):.0f} us, computing p50 "
          f"{quantile(computes, 0.5):.0f} us, p99 {quantile(computes, 0.99):.0f} us", flush=True)


def ticks_of(log):
    with log.open() as file:
        return [(int(row["start_ns"]), int(row["period_ns"]), int(row["compute_ns"]))
                for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def watch_a_session(programs, scene, vendor, folder):
    """Ticks of haptic_node alone with its session, with twenty onlookers, and after they left."""
    network, nodes, marks = Network(programs), [], []
    try:
        for name, host, more in (("haptic_node", "theatre", ["--log", folder / "log.csv"]), ("virtual_device", "theatre", []),
                                 ("deform_node", "cluster", [])):
            nodes.append(network.start(host, [programs / name, "--scene", scene, "--dds", vendor, "--domain", "7", "--profile", "lan", *more]))
        time.sleep(SETTLE_S)
        marks.append(time.monotonic_ns())
        time.sleep(COUNT_S)
        marks.append(time.monotonic_ns())
        onlookers = start_onlookers(network, programs, "gallery", CROWD, vendor, 7)
        time.sleep(JOIN_S)
        marks.append(time.monotonic_ns())
        time.sleep(COUNT_S)
        marks.append(time.monotonic_ns())
        heard = end_onlookers(onlookers)
    finally:
        for node in nodes:
            node.send_signal(signal.SIGTERM)
            node.wait()
        network.close()
    ticks = ticks_of(folder / "log.csv")
    for what, begin, end in (("alone", marks[0], marks[1]), (f"{CROWD} onlookers join", marks[1], marks[2]),
                             (f"{CROWD} onlookers", marks[2], marks[3])):
        tell_ticks(f"{vendor}, {what}", [tick for tick in ticks if begin <= tick[0] < end])
    print(f"{vendor}: onlookers heard {heard['forces']} forces and {heard['states']} blocks of states; {heard['deaf']} heard nothing",
          flush=True)


def main():
    programs, scene = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    why = obstacle()
    if why:
        print(f"skipped: {why}")
        return SKIPPED
    chosen = sys.argv[3:] or ["fast", "cyclone"]
    for vendor in chosen:
        with tempfile.TemporaryDirectory() as folder:
            watch_a_session(programs, scene, vendor, pathlib.Path(folder))
    for vendor in chosen:
        for tables, each in ((1, 1), (1, 3), (1, 6), (4, 1)):
            tell_chatter(programs, vendor, tables, each)
    return 0


if __name__ == "__main__":
    sys.exit(main())
