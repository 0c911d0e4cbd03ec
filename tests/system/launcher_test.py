#!/usr/bin/env python3
"""launch_scripts/run as a user types it: reports, pictures, refusals, and nothing left behind.

Environment: OMENTUM_BIN and OMENTUM_CACHE, as for launch_scripts/run. A single test: launcher_test.py Class.test
"""
import fcntl
import json
import os
import pathlib
import pty
import signal
import subprocess
import tempfile
import termios
import time
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
RUN = REPOSITORY / "launch_scripts" / "run"
HOLD = REPOSITORY / "tests" / "system" / "hold.toml"
REAL_LIVER = REPOSITORY / ".." / "shared" / "data" / "tet" / "openhelp_liver_7k.msh"
NODES = ("haptic_node", "deform_node", "render_node", "virtual_device")
PATIENCE_S = 120

TIMES = {"p50": float, "p99": float, "p999": float, "max": float, "count": int}
LOOP = {"rate_hz": float, "ticks": int, "missed": int, "period_us": TIMES, "compute_us": TIMES}
# DESIGN section 5, field by field
SHAPE = {
    "scene": str, "seconds": float, "protocol": int,
    "machine": {"cores": int, "kernel": str, "realtime": bool},
    "nodes": {
        "haptic_node": {"dds": str, "exit": int, "loop": LOOP, "force_n": {"mean": float, "max": float},
                        "contacts": {"ticks_in_contact": int, "nodes_max": int}, "faults": list},
        "deform_node": {"dds": str, "exit": int, "loop": LOOP, "states": int, "steps": int, "removed_tetrahedra": int,
                        "faults": list},
        "render_node": {"dds": str, "exit": int, "frames": int, "frame_us": TIMES, "faults": list},
        "virtual_device": {"dds": str, "exit": int, "round_trip_us": TIMES, "sent": int, "lost": int, "energy_j": float,
                           "faults": list},
    },
    "link": {"tool_to_force_us": TIMES, "tool_to_organ_us": TIMES, "tool_to_picture_us": TIMES},
}


def children_of(pid):
    """Process ids below `pid`."""
    listing = subprocess.run(["ps", "-e", "-o", "pid=,ppid="], capture_output=True, text=True, check=True).stdout
    parents = dict(map(int, line.split()) for line in listing.splitlines())
    return [child for child, parent in parents.items() if parent == pid]


def alive(pid):
    try:
        state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


class LauncherTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "o"

    def run_it(self, *arguments):
        return subprocess.run([RUN, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE_S, check=False)

    def start(self, *arguments):
        process = subprocess.Popen([RUN, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        return process

    def nodes_of(self, process):
        """Name -> process id, once all four run."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            found = {}
            for child in children_of(process.pid):
                try:
                    name = pathlib.Path(f"/proc/{child}/exe").resolve().name
                except OSError:
                    continue
                if name in NODES:
                    found[name] = child
            if len(found) == len(NODES):
                return found
            time.sleep(0.05)
        self.fail("the nodes did not start")

    def report(self):
        return json.loads((self.out / "report.json").read_text())

    def check_shape(self, value, shape, place="report"):
        if isinstance(shape, dict):
            self.assertIsInstance(value, dict, place)
            for key, inner in shape.items():
                self.assertIn(key, value, place)
                self.check_shape(value[key], inner, f"{place}.{key}")
        elif shape is float:
            self.assertIsInstance(value, (int, float), place)
            self.assertNotIsInstance(value, bool, place)
        elif shape is int:
            self.assertIsInstance(value, int, place)
            self.assertNotIsInstance(value, bool, place)
        else:
            self.assertIsInstance(value, shape, place)


class Sessions(LauncherTest):
    def check_session(self, dds, vendors, *more):
        done = self.run_it(*more, "--headless", "--seconds", "8", "--out", self.out, "--dds", dds)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        report = self.report()
        self.check_shape(report, SHAPE)
        nodes = report["nodes"]
        self.assertEqual({name: nodes[name]["dds"] for name in NODES}, vendors)
        self.assertEqual({name: nodes[name]["exit"] for name in NODES}, dict.fromkeys(NODES, 0))
        self.assertGreater(nodes["haptic_node"]["force_n"]["max"], 0.1)
        self.assertGreater(nodes["haptic_node"]["contacts"]["ticks_in_contact"], 0)
        self.assertGreater(nodes["virtual_device"]["round_trip_us"]["count"], 0)
        self.assertGreater(nodes["deform_node"]["states"], 0)
        for link in SHAPE["link"]:
            self.assertGreater(report["link"][link]["count"], 0, link)
        self.assertTrue(list(self.out.glob("*.png")), "no picture")
        return report

    def test_fast(self):
        self.check_session("fast", dict.fromkeys(NODES, "fast"), HOLD)

    def test_cyclone(self):
        self.check_session("cyclone", dict.fromkeys(NODES, "cyclone"), HOLD)

    def test_mixed(self):
        self.check_session("haptic=fast,deform=cyclone,render=fast,device=cyclone",
                           dict(haptic_node="fast", deform_node="cyclone", render_node="fast", virtual_device="cyclone"), HOLD)


class RealOrgan(LauncherTest):
    def test_default_scene_on_a_real_liver(self):
        if not REAL_LIVER.is_file():
            self.skipTest("the real meshes are absent")
        done = self.run_it("--organ", REAL_LIVER, "--headless", "--seconds", "8", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("taken as millimetres", done.stdout)
        self.assertGreater(self.report()["nodes"]["haptic_node"]["force_n"]["max"], 0.1)


class PaperSplit(LauncherTest):
    def test_hand_and_organ_on_a_processor_each_at_the_papers_rate(self):
        if len(os.sched_getaffinity(0)) < 2:
            self.skipTest("one processor")
        done = self.run_it(HOLD, "--headless", "--seconds", "3", "--out", self.out, "--split", "paper", "--rate-hz", "300", "--log")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("split as in the paper", done.stdout)
        self.assertEqual(self.report()["nodes"]["haptic_node"]["loop"]["rate_hz"], 300)
        self.assertTrue((self.out / "haptic_node.csv").is_file())


class Endings(LauncherTest):
    def test_terminated_it_stops_its_nodes_and_reports(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE_S), 0, process.stdout.read())
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])
        self.check_shape(self.report(), SHAPE)

    def test_keys_in_a_terminal_pause_and_end_it(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        log = open(self.folder / "log", "w+", encoding="utf-8")
        self.addCleanup(log.close)
        process = subprocess.Popen(
            [RUN, HOLD, "--headless", "--out", self.out], cwd=self.folder, stdin=theirs, stdout=log, stderr=log,
            start_new_session=True, preexec_fn=lambda: fcntl.ioctl(theirs, termios.TIOCSCTTY, 0))
        os.close(theirs)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        self.nodes_of(process)
        os.write(ours, b"p")
        time.sleep(1)
        os.write(ours, b"q")
        self.assertEqual(process.wait(PATIENCE_S), 0)
        self.assertIn("run: paused", (self.folder / "log").read_text())
        self.check_shape(self.report(), SHAPE)

    def test_a_killed_node_leaves_the_others_running_and_is_reported(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        os.kill(nodes["deform_node"], signal.SIGKILL)
        time.sleep(1.5)
        self.assertTrue(all(alive(nodes[name]) for name in NODES if name != "deform_node"))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 1)
        self.assertIn("deform_node was ended by SIGKILL; the others go on", process.stdout.read())
        report = self.report()
        self.check_shape(report, SHAPE)
        self.assertEqual(report["nodes"]["deform_node"]["exit"], -signal.SIGKILL)

    def test_with_restart_a_killed_node_comes_back(self):
        process = self.start(HOLD, "--headless", "--out", self.out, "--restart")
        nodes = self.nodes_of(process)
        os.kill(nodes["haptic_node"], signal.SIGKILL)
        deadline = time.monotonic() + PATIENCE_S
        while alive(nodes["haptic_node"]) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertNotEqual(self.nodes_of(process)["haptic_node"], nodes["haptic_node"])
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 0, process.stdout.read())

    def test_killed_itself_it_leaves_no_node_behind(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        process.kill()
        deadline = time.monotonic() + PATIENCE_S
        while any(map(alive, nodes.values())) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])


class Refusals(LauncherTest):
    """One line, exit code 2, no session."""

    def check_refused(self, *arguments, about):
        done = self.run_it(*arguments, "--headless", "--seconds", "2", "--out", self.out)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn(about, lines[0])
        self.assertFalse((self.out / "report.json").exists())

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_wrong_words(self):
        self.check_refused("--dds", "telepathy", about="telepathy")
        self.check_refused("--dds", "haptic=fast,nose=fast", about="nose")
        self.check_refused("--device", "broom", about="broom")
        self.check_refused("--device", "mouse", about="mouse")
        self.check_refused("--device", "trace:missing.csv", about="missing.csv")
        self.check_refused("--secure", about="--secure")
        self.check_refused("--domain", "500", about="500")
        self.check_refused("--rate-hz", "0", about="--rate-hz")
        self.check_refused("--frobnicate", about="--frobnicate")

    def test_wrong_scenes(self):
        self.check_refused("missing.toml", about="missing.toml")
        self.check_refused(self.file("syntax.toml", "name = \n"), about="syntax.toml:1")
        self.check_refused(self.file("key.toml", HOLD.read_text() + "\nflavour = 3\n"), about="flavour")
        self.check_refused(self.file("mesh.toml", HOLD.read_text().replace("phantom:paper", "gone.msh")), about="gone.msh")

    def test_wrong_organs(self):
        self.check_refused("--organ", "missing.msh", about="missing.msh")
        self.check_refused("--organ", self.file("broken.msh", "$MeshFormat\n2.2 0 8\n"), about="broken.msh")
        self.check_refused("--organ", self.file("broken.h5", "no organ"), about="broken.h5")
        self.check_refused("--organ", self.file("organ.doc", "no organ"), about="organ.doc")


if __name__ == "__main__":
    unittest.main(verbosity=2)
