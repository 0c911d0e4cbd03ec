#!/usr/bin/env python3
"""A person with a mouse: launch_scripts/run --device mouse on a display, moved by synthetic events.

Environment: as launcher_test.py. Skips where Xvfb or xdotool is absent.
"""
import csv
import itertools
import math
import os
import shutil
import signal
import subprocess
import time
import unittest

import launcher_test
from launcher_test import HOLD, PATIENCE_S

WINDOW = (480, 300)  # drawn by the processor beside whatever else it does
RIGHT_OF_PANEL = (340, 150)
FELT_N = 0.2
TAIL_BYTES = 4096  # some ticks of a log that grows by 250 kB a second
OPENED_S = 0.7  # jaws open and close in half a second
ONE_POINT = "points = [[0.0, 0.0, 0.0]]"
# two on each jaw, and the tip
JAW_POINTS = "points = [[0.0, 0.0, 0.0], [0.003, 0.0, 0.001], [-0.003, 0.0, 0.001], [0.003, 0.0, 0.006], [-0.003, 0.0, 0.006]]"


def point(*words):
    done = subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True, text=True, timeout=PATIENCE_S)
    return done.stdout


class Mouse(launcher_test.OnDisplay):
    SCREEN = "1280x800x24"

    def setUp(self):
        if not shutil.which("xdotool"):
            self.skipTest("xdotool is absent")
        super().setUp()

    def newest_tick(self):
        """What haptic_node knows, by column."""
        try:
            with open(self.out / "haptic_node.csv", "rb") as file:
                header = file.readline().decode().rstrip()
                file.seek(max(len(header) + 1, file.seek(0, os.SEEK_END) - TAIL_BYTES))
                lines = file.read().decode().splitlines()
        except FileNotFoundError:
            return {}
        row = next(csv.DictReader([header, *lines[-2:-1]]), {})  # the last line may not be whole
        return {key: float(value) for key, value in row.items()} if len(lines) > 2 else {}

    def force_n(self, tool):
        tick = self.newest_tick()
        return math.hypot(*(tick.get(f"tool{tool}_f{axis}_n", 0.0) for axis in "xyz"))

    def place_m(self, tool):
        tick = self.newest_tick()
        return [tick.get(f"tool{tool}_{axis}_m", 0.0) for axis in "xyz"]

    def open_window(self):
        # a fresh display has no other window
        point("search", "--sync", "--onlyvisible", "--name", "Omentum", "windowsize", *WINDOW)
        self.wait_for(lambda: self.force_n(1) > FELT_N, "the scripted hand does not press")

    def until(self, happened, do, what):
        """Does it again and again, as a person would who sees nothing happen. Returns how long it took to act."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            self.assertLess(time.monotonic(), deadline, what)
            begin = time.monotonic()
            do()
            while time.monotonic() < begin + 0.4:
                if happened():
                    return time.monotonic() - begin
                time.sleep(0.02)

    def press(self):
        """The first instrument, by pointer and wheel, until its force is felt."""
        x, y = RIGHT_OF_PANEL
        start, ways = self.place_m(0), itertools.cycle((0, 10))
        self.until(lambda: math.dist(self.place_m(0), start) > 1e-3,
                   lambda: point("mousemove", x + next(ways), y), "the pointer moves no instrument")
        self.until(lambda: self.force_n(0) > FELT_N, lambda: point("click", 4), "the wheel presses nothing")

    def grasp(self):
        """The next instrument: its jaws open and close on what its script pressed."""
        point("keydown", "Tab")
        time.sleep(self.slowest_frame_s())
        point("keyup", "Tab")
        time.sleep(self.slowest_frame_s())
        # a device that stood still for a moment has let go
        if self.force_n(1) < FELT_N:
            self.until(lambda: self.force_n(1) > FELT_N, lambda: point("click", 4), "the wheel presses nothing")
        for word in ("mousedown", "mouseup", "mousedown", "mouseup"):
            time.sleep(self.slowest_frame_s())
            point(word, 3)
            time.sleep(OPENED_S)

    def slowest_frame_s(self):
        """A window that draws sees nothing of a person meanwhile."""
        with open(self.out / "render_node.csv", encoding="ascii") as file:
            drawn = [int(row["compute_ns"] or 0) for row in csv.DictReader(file) if row["compute_ns"]]
        return 0.1 + 1.5e-9 * max(drawn[-20:], default=0)

    def test_a_person_presses_and_grasps(self):
        scene = self.folder / "grasp.toml"
        scene.write_text(HOLD.read_text().replace(ONE_POINT, JAW_POINTS))
        process = self.start(scene, "--device", "mouse", "--log", "--out", self.out)
        self.nodes_of(process)
        self.open_window()
        self.press()
        self.grasp()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 0)
        nodes = self.report()["nodes"]
        self.assertEqual({name: node["faults"] for name, node in nodes.items()}, {name: [] for name in nodes})
        self.assertGreater(nodes["virtual_device"]["sent"], 1000)
        probe, grasper = nodes["virtual_device"]["hands"]
        self.assertGreater(probe["rays"], 0)
        self.assertGreater(probe["peak_force_n"], FELT_N / 2)
        self.assertGreater(grasper["rays"], 0)
        pressed, grasped = nodes["haptic_node"]["hands"]
        self.assertGreater(pressed["force_max_n"], FELT_N)
        self.assertGreater(grasped["grasps"]["begun"], 0)
        self.assertGreater(grasped["grip_torque_max_nm"], 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
