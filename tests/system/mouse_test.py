#!/usr/bin/env python3
"""A person with a mouse: launch_scripts/run --device mouse on a display, moved by synthetic events.

Environment: as launcher_test.py. Skips where Xvfb or xdotool is absent.
"""
import shutil
import subprocess
import time
import unittest

import launcher_test
from launcher_test import HOLD, PATIENCE_S

SETTLED_S = 5.0  # haptic_node has found the device and listened for a rival; the scripted hand presses
MIDDLE = (800, 400)  # of the window, to the right of its panel
STEPS_TO_PRESS = 12  # of the wheel: from the hover over the liver to well below its surface
ONE_POINT = "points = [[0.0, 0.0, 0.0]]"
# two on each jaw, and the tip
JAW_POINTS = "points = [[0.0, 0.0, 0.0], [0.003, 0.0, 0.001], [-0.003, 0.0, 0.001], [0.003, 0.0, 0.006], [-0.003, 0.0, 0.006]]"


def point(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True, timeout=PATIENCE_S)


class Mouse(launcher_test.OnDisplay):
    SCREEN = "1280x800x24"

    def setUp(self):
        if not shutil.which("xdotool"):
            self.skipTest("xdotool is absent")
        super().setUp()

    def press(self):
        """The first instrument, by pointer and wheel."""
        x, y = MIDDLE
        point("mousemove", x, y)
        time.sleep(0.3)
        for step in range(4):
            point("mousemove", x + 10 * step, y)
            time.sleep(0.1)
        point("click", "--repeat", STEPS_TO_PRESS, "--delay", 60, 4)
        time.sleep(1)

    def grasp(self):
        """The next instrument: its jaws open and close on what its script pressed."""
        point("key", "Tab")
        time.sleep(0.6)
        for seconds in (0.6, 1.2):
            point("mousedown", 3)
            time.sleep(seconds)
            point("mouseup", 3)
            time.sleep(0.8)

    def test_a_person_presses_and_grasps(self):
        scene = self.folder / "grasp.toml"
        scene.write_text(HOLD.read_text().replace(ONE_POINT, JAW_POINTS))
        process = self.start(scene, "--device", "mouse", "--out", self.out)
        self.nodes_of(process)
        time.sleep(SETTLED_S)
        self.press()
        self.grasp()
        process.send_signal(launcher_test.signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 0, process.stdout.read())
        nodes = self.report()["nodes"]
        self.assertEqual({name: node["faults"] for name, node in nodes.items()}, {name: [] for name in nodes})
        self.assertGreater(nodes["virtual_device"]["sent"], 1000)
        probe, grasper = nodes["virtual_device"]["hands"]
        self.assertGreater(probe["rays"], 0)
        self.assertGreater(probe["peak_force_n"], 0.1)
        self.assertGreater(grasper["rays"], 0)
        pressed, grasped = nodes["haptic_node"]["hands"]
        self.assertGreater(pressed["force_max_n"], 0.1)
        self.assertGreater(grasped["grasps"]["begun"], 0)
        self.assertGreater(grasped["grip_torque_max_nm"], 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
