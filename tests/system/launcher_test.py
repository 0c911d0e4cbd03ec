#!/usr/bin/env python3
"""launch_scripts/run as a user types it: reports, pictures, refusals, and nothing left behind.

Environment: OMENTUM_BIN and OMENTUM_CACHE, as for launch_scripts/run. A single test: launcher_test.py Class.test
"""
import contextlib
import csv
import fcntl
import io
import json
import math
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest
from unittest import mock

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher.errors import Refusal  # noqa: E402
from launcher import cache, domain, keystore, machine, options, organs, processes, report, session, video  # noqa: E402 (the launcher is no installed package)

RUN = REPOSITORY / "launch_scripts" / "run"
HOLD = REPOSITORY / "tests" / "system" / "hold.toml"
REAL_LIVER = REPOSITORY / ".." / "shared" / "data" / "tet" / "openhelp_liver_7k.msh"
NODES = ("haptic_node", "deform_node", "render_node", "virtual_device")
PATIENCE_S = 120

TIMES = {"p50": float, "p99": float, "p999": float, "max": float, "count": int}
LOOP = {"rate_hz": float, "ticks": int, "missed": int, "period_us": TIMES, "compute_us": TIMES}
# docs/design.md, "Report", field by field
SHAPE = {
    "scene": str, "seconds": float, "protocol": int,
    "machine": {"cores": int, "kernel": str, "realtime": bool, "steal_share": float},
    "nodes": {
        "haptic_node": {"dds": str, "exit": int, "restarts": int, "loop": LOOP, "force_n": {"mean": float, "max": float},
                        "contacts": {"ticks_in_contact": int, "nodes_max": int},
                        "local_models": {"heard": int, "dropped": int, "gone": int}, "hands": list, "faults": list},
        "deform_node": {"dds": str, "exit": int, "loop": LOOP, "states": int, "stress_states": int, "touching_moments": int, "steps": int, "removed_tetrahedra": int,
                        "repaired_tetrahedra": int, "cuts": {"way_cm": float, "lost_cm3": float, "lost_cm3_per_cm": float},
                        "real_time_factor": float, "faults": list},
        "render_node": {"dds": str, "exit": int, "frames": int, "frame_us": TIMES, "deepest_dent_m": float,
                        "unmatched_states": int, "removed_tetrahedra": int, "closed": bool, "videos": list,
                        "picture": {"level": str, "asked_fps": float, "reached_fps": float, "changes": int, "share": dict}, "faults": list},
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

    def nodes_of(self, process, names=NODES):
        """Name -> process id, once all of them run."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            found = {}
            for child in children_of(process.pid):
                try:
                    name = pathlib.Path(f"/proc/{child}/exe").resolve().name
                except OSError:
                    continue
                if name in names:
                    found[name] = child
            if len(found) == len(names):
                return found
            time.sleep(0.05)
        self.fail("the nodes did not start")

    def wait_for(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.05)

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
    def keys(self):
        keystore.make(self.folder / "keys")
        return self.folder / "keys"

    # each vendor alone: tests/system/session_test.cpp, and Endings.test_sessions_in_a_row_end_well
    def test_each_node_on_the_vendor_that_it_was_given(self):
        vendors = dict(haptic_node="fast", deform_node="cyclone", render_node="fast", virtual_device="cyclone")
        done = self.run_it(HOLD, "--headless", "--seconds", "8", "--out", self.out,
                           "--dds", "haptic=fast,deform=cyclone,render=fast,device=cyclone", "--secure", "--keystore", self.keys())
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
        self.assertTrue((self.out / "indent.png").is_file(), "no picture of the dent")


class Pictures(LauncherTest):
    HAND_M = 0.01  # how deep the default scene's hand wants to press

    def test_default_scene_is_visibly_dented_and_leaves_no_picture_of_an_earlier_run(self):
        self.out.mkdir()
        for stale in ("frame_0042.png", "indent.png", "final.png", "report.json"):
            (self.out / stale).write_text("of an earlier run")
        (self.out / "notes.png").write_text("a person's own")
        done = self.run_it("--headless", "--seconds", "8", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # the hand yields by its force over its stiffness (0.9 N over 400 N/m), and its surroundings sink a little
        dent_m = self.report()["nodes"]["render_node"]["deepest_dent_m"]
        self.assertGreater(dent_m, 0.5 * self.HAND_M)
        self.assertLess(dent_m, self.HAND_M)
        for name in ("frame_0001.png", "indent.png", "final.png"):
            self.assertEqual((self.out / name).read_bytes()[1:4], b"PNG", name)
        self.assertFalse((self.out / "frame_0042.png").exists())
        self.assertTrue((self.out / "notes.png").exists())


class Devices(LauncherTest):
    def check_run(self, *arguments, seconds=8):
        done = self.run_it(HOLD, "--headless", "--seconds", seconds, "--out", self.out, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout, self.report()["nodes"]

    def test_none_leaves_the_tools_to_others(self):
        _, nodes = self.check_run("--device", "none", seconds=3)
        self.assertNotIn("virtual_device", nodes)
        self.assertGreater(nodes["haptic_node"]["loop"]["ticks"], 0)
        self.assertEqual(nodes["haptic_node"]["contacts"]["ticks_in_contact"], 0)

    def test_trace_plays_a_recorded_hand(self):
        # down onto the right lobe within 6 s, 10 mm deep at the end
        rows = ["t_s,px,py,pz,qw,qx,qy,qz,grip"]
        rows += [f"{t:g},-0.048,-0.015,{0.058 - 0.04 * min(t / 6, 1):.6f},1,0,0,0,0" for t in range(60)]
        trace = self.folder / "hand.csv"
        trace.write_text("\n".join(rows) + "\n")
        _, nodes = self.check_run("--device", f"trace:{trace}")
        self.assertGreater(nodes["virtual_device"]["sent"], 0)
        self.assertGreater(nodes["haptic_node"]["contacts"]["ticks_in_contact"], 0)
        self.assertGreater(nodes["haptic_node"]["force_n"]["max"], 0.1)

    def test_paused_from_the_start_nobody_moves(self):
        said, nodes = self.check_run("--paused")
        self.assertEqual(said.count("run: paused"), 1, said)
        self.assertEqual(nodes["haptic_node"]["contacts"]["ticks_in_contact"], 0)
        self.assertEqual(nodes["haptic_node"]["force_n"]["max"], 0)


class Strangers(LauncherTest):
    def test_where_nobody_hears_anybody_the_session_says_so_and_fails(self):
        """A network namespace of its own, whose lo is down; Cyclone refuses to start there, Fast DDS does not."""
        if subprocess.run(["unshare", "-n", "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("no network namespaces here")
        done = subprocess.run(["unshare", "-n", RUN, HOLD, "--headless", "--dds", "fast", "--seconds", "12", "--out", self.out],
                              cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("no answer ever came", done.stdout)

    def test_pictures_that_a_full_disk_did_not_take_are_told_and_leave_nothing(self):
        """A small file system in a mount namespace of its own."""
        self.out.mkdir()
        script = f"mount -t tmpfs -o size=200k none {self.out} && {RUN} {HOLD} --headless --seconds 5 --out {self.out}; " \
                 f"echo code $?; ls {self.out}"
        if subprocess.run(["unshare", "-m", "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("no mount namespaces here")
        done = subprocess.run(["unshare", "-m", "sh", "-c", script], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE_S, check=False)
        self.assertIn("code 1", done.stdout, done.stderr)
        self.assertIn("No space left on device", done.stdout)
        self.assertNotIn(".part", done.stdout.rpartition("code")[2])


class RealOrgan(LauncherTest):
    def test_default_scene_on_a_real_liver(self):
        if not REAL_LIVER.is_file():
            self.skipTest("the real meshes are absent")
        done = self.run_it("--organ", REAL_LIVER, "--headless", "--seconds", "8", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("taken as millimetres", done.stdout)
        self.assertEqual(self.report()["scene"], f"{REAL_LIVER.stem} pressed by a simulated hand")
        self.assertGreater(self.report()["nodes"]["haptic_node"]["force_n"]["max"], 0.1)


class PaperSplit(LauncherTest):
    def test_hand_and_organ_on_a_processor_each_at_the_papers_rate(self):
        if len(os.sched_getaffinity(0)) < 2:
            self.skipTest("one processor")
        done = self.run_it(HOLD, "--headless", "--seconds", "3", "--out", self.out, "--split", "paper", "--rate-hz", "300", "--log")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("split as in the paper", done.stdout)
        self.assertEqual(self.report()["nodes"]["haptic_node"]["loop"]["rate_hz"], 300)
        with open(self.out / "haptic_node.csv", encoding="utf-8") as log:
            ticks = [line for line in csv.DictReader(log) if not line["tick"].startswith("#")]
        felt = max(math.dist((0, 0, 0), [float(tick[f"tool0_f{axis}_n"]) for axis in "xyz"]) for tick in ticks)
        self.assertAlmostEqual(felt, self.report()["nodes"]["haptic_node"]["force_n"]["max"], delta=1e-3)
        self.assertTrue(any(int(tick["tool0_seq"]) > 0 and float(tick["tool0_qw"]) != 0 for tick in ticks))


class Endings(LauncherTest):
    def test_terminated_it_stops_its_nodes_and_reports(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE_S), 0, process.stdout.read())
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])
        self.check_shape(self.report(), SHAPE)

    def test_ended_before_it_began_it_leaves_no_traceback(self):
        # while Python starts, reads its modules, checks the words, and the same again
        for delay_s in (0.02, 0.06, 0.1, 0.14, 0.18, 0.26, 0.34, 0.42):
            process = subprocess.Popen([RUN, HOLD, "--prepare", "--out", self.out], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                       text=True, start_new_session=True)
            time.sleep(delay_s)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of them
            self.assertNotIn("Traceback", process.communicate(timeout=PATIENCE_S)[0], f"after {delay_s} s")

    def test_a_closed_terminal_ends_it_like_sigterm(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(PATIENCE_S), 0, process.stdout.read())
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])
        self.check_shape(self.report(), SHAPE)

    def test_where_nobody_reads_any_more_it_ends_like_a_closed_terminal(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        process.stdout.close()
        os.kill(nodes["render_node"], signal.SIGTERM)  # which is told
        self.assertEqual(process.wait(PATIENCE_S), 0)
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])
        self.check_shape(self.report(), SHAPE)

    def start_in_terminal(self, *arguments):
        """The process, and our end of its terminal. What it says is in `log`."""
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        log = open(self.folder / "log", "w+", encoding="utf-8")
        self.addCleanup(log.close)
        process = subprocess.Popen(
            [RUN, HOLD, "--headless", "--out", self.out, *arguments], cwd=self.folder, stdin=theirs, stdout=log,
            stderr=log, start_new_session=True, preexec_fn=lambda: fcntl.ioctl(theirs, termios.TIOCSCTTY, 0))
        os.close(theirs)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        return process, ours

    def test_keys_in_a_terminal_pause_reset_and_end_it(self):
        process, ours = self.start_in_terminal()
        self.nodes_of(process)
        for key, said in ((b"p", "run: paused"), (b"p", "run: goes on"), (b"r", "run: reset"), (b"c", "run: fault cleared")):
            os.write(ours, key)
            self.wait_for(lambda said=said: said in (self.folder / "log").read_text(), said)
        os.write(ours, b"q")
        self.assertEqual(process.wait(PATIENCE_S), 0)
        self.check_shape(self.report(), SHAPE)

    def test_ended_before_its_hand_starts_it_ends_well_and_says_that_there_was_none(self):
        process, ours = self.start_in_terminal("--paused")
        self.nodes_of(process, [name for name in NODES if name != "virtual_device"])
        os.write(ours, b"q")
        said = (self.folder / "log").read_text
        self.assertEqual(process.wait(PATIENCE_S), 0, said())
        hand = self.report()["nodes"]["virtual_device"]
        self.assertIsNone(hand["exit"])
        self.assertEqual(hand["faults"], [])
        self.assertIn("virtual_device was not started", said())

    def test_sessions_in_a_row_end_well(self):
        for vendor in ("fast", "cyclone", "fast", "cyclone"):
            done = self.run_it("--headless", "--seconds", "3", "--out", self.out, "--dds", vendor)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

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
        self.assertEqual(self.report()["nodes"]["haptic_node"]["restarts"], 1)

    def test_killed_itself_it_leaves_no_node_behind(self):
        process = self.start(HOLD, "--headless", "--out", self.out)
        nodes = self.nodes_of(process)
        process.kill()
        deadline = time.monotonic() + PATIENCE_S
        while any(map(alive, nodes.values())) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual([name for name, pid in nodes.items() if alive(pid)], [])


class OnDisplay(LauncherTest):
    """On a display of its own."""
    SCREEN = "800x600x24"

    def setUp(self):
        super().setUp()
        if not shutil.which("Xvfb"):
            self.skipTest("Xvfb is absent")
        reading, writing = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", self.SCREEN],
                                  pass_fds=[writing], stderr=subprocess.DEVNULL)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        os.close(writing)
        with os.fdopen(reading, encoding="ascii") as answer:
            number = answer.readline().strip()
        if not number:
            self.skipTest("Xvfb does not start")
        display = mock.patch.dict(os.environ, {"DISPLAY": f":{number}"})
        display.start()
        self.addCleanup(display.stop)


class Windows(OnDisplay):
    def test_an_ended_render_node_is_no_closed_window(self):
        process = self.start(HOLD, "--out", self.out)
        nodes = self.nodes_of(process)
        time.sleep(1)
        os.kill(nodes["render_node"], signal.SIGTERM)
        self.wait_for(lambda: not alive(nodes["render_node"]), "render_node does not end")
        time.sleep(1)
        self.assertTrue(all(alive(nodes[name]) for name in NODES if name != "render_node"))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 0)
        said = process.stdout.read()
        self.assertIn("render_node ended with code 0; the others go on", said)
        self.assertNotIn("the window was closed", said)


class Parts(unittest.TestCase):
    """What needs no processes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        environment = mock.patch.dict(os.environ, {"OMENTUM_CACHE": str(self.folder / "cache")})
        environment.start()
        self.addCleanup(environment.stop)

    def build(self, fixed, name="liver", mesh=None, regions=(), dynamic="", dynamic_mesh=None):
        """What build_organ would take from the cache, made by a stand-in for organ_build."""
        mesh = mesh or self.folder / "liver.msh"
        mesh.touch()
        options = mock.Mock(programs=self.folder)
        spec = {"young_pa": 1, "poisson": 0.4, "density_kg_m3": 1, "regions": list(regions)}
        with mock.patch.object(organs, "run_tool", lambda _, words, __: pathlib.Path(words[3]).write_text("organ")):
            return organs.build_organ(options, cache.Cache(), mesh, name, spec, 1.0, fixed, dynamic,
                                       dynamic_mesh)

    def test_a_node_without_a_report_has_every_field_all_the_same(self):
        seen_by_the_launcher = {"dds", "exit", "restarts"}
        for name in NODES:
            self.assertEqual(set(report.FIELDS[name]) | seen_by_the_launcher, set(SHAPE["nodes"][name]) | seen_by_the_launcher)

    def test_each_scene_of_the_project_is_found_by_its_name_and_told_in_the_readme(self):
        readme = (REPOSITORY / "README.md").read_text(encoding="utf-8")
        names = {file.stem for file in (REPOSITORY / "scenes").glob("*.toml")}
        self.assertLessEqual({"liver", "plate_cut", "cylinder_tear", "liver_dynamic"}, names)
        for name in names:
            self.assertEqual(options.find_scene(name), REPOSITORY / "scenes" / f"{name}.toml")
            self.assertIn(name, readme)
        listed = subprocess.run([REPOSITORY / "launch_scripts" / "run", "--list"], capture_output=True, text=True, check=True)
        self.assertEqual({line.split()[0] for line in listed.stdout.splitlines()}, names)

    def test_changed_support_file_is_another_organ(self):
        nodes = self.folder / "nodes.csv"
        for fixed in (str(nodes), f"{nodes}:xz"):
            nodes.write_text("1\n2\n")
            first = self.build(fixed)
            self.assertEqual(self.build(fixed), first)
            nodes.write_text("1\n3\n")
            self.assertNotEqual(self.build(fixed), first, fixed)

    def test_a_dynamic_part_and_what_its_file_lists_make_another_organ(self):
        plain = self.build("plane:x<0")
        self.assertNotEqual(self.build("plane:x<0", dynamic="plane:x>1"), plain)
        listed = self.folder / "tetrahedra.csv"
        listed.write_text("1\n2\n")
        first = self.build("plane:x<0", dynamic=str(listed))
        listed.write_text("1\n3\n")
        self.assertNotEqual(self.build("plane:x<0", dynamic=str(listed)), first)
        self.assertEqual(organs.support_files("label:3"), [])

    def test_a_second_mesh_makes_another_organ_and_belongs_to_its_inputs(self):
        second = self.folder / "coarse.msh"
        second.write_text("1")
        plain, first = self.build("plane:x<0"), self.build("plane:x<0", dynamic_mesh=second)
        self.assertNotEqual(first, plain)
        second.write_text("2")
        self.assertNotEqual(self.build("plane:x<0", dynamic_mesh=second), first)

    def test_a_foreign_mesh_moves_at_the_end_that_is_not_held(self):
        measured = {"min": [0, -30, 0], "max": [90, 30, 30]}
        self.assertEqual(organs.dynamic_spec(measured, 0.001, "plane:x<0.01"), "plane:x>0.06")
        self.assertEqual(organs.dynamic_spec(measured, 0.001, "plane:y>0.01"), "plane:y<-0.01")
        self.assertEqual(organs.dynamic_spec(measured, 0.001, "nodes.csv"), "plane:z>0.02")

    def test_each_region_is_told_to_organ_build_and_makes_another_organ(self):
        told = []
        spec = {"young_pa": 1, "poisson": 0.4, "density_kg_m3": 1, "regions": ["label=1; young=2", "ball=0,0,0,1; young=3"]}
        (self.folder / "liver.msh").touch()

        def run_tool(_, words, __):
            told.extend(words)
            pathlib.Path(words[3]).write_text("organ")

        with mock.patch.object(organs, "run_tool", run_tool):
            organs.build_organ(mock.Mock(programs=self.folder), cache.Cache(), self.folder / "liver.msh", "liver", spec, 1.0, "x")
        self.assertEqual(told[-4:], ["--region", "label=1; young=2", "--region", "ball=0,0,0,1; young=3"])
        plain = self.build("plane:x<0")
        self.assertNotEqual(self.build("plane:x<0", regions=["label=1; young=2"]), plain)
        self.assertNotEqual(self.build("plane:x<0", regions=["label=1; young=3"]),
                            self.build("plane:x<0", regions=["label=1; young=2"]))

    def test_regions_stay_behind_when_another_organ_comes(self):
        told = []
        (self.folder / "kidney.msh").touch()
        spec = {"young_pa": 1, "poisson": 0.4, "density_kg_m3": 1, "regions": ["ball=0,0,0,1; young=3"]}
        options = mock.Mock(programs=self.folder, organ=self.folder / "kidney.msh", scale=1.0, fixed="plane:x<0")

        def run_tool(_, words, __):
            if words[0] == "scene_prepare":
                return '{"min": [0, 0, 0], "max": [0.1, 0.1, 0.1]}'
            told.extend(words)
            pathlib.Path(words[3]).write_text("organ")
            return ""

        with mock.patch.object(organs, "run_tool", run_tool), contextlib.redirect_stdout(io.StringIO()) as said:
            organs.users_organ_file(options, cache.Cache(), spec)
        self.assertNotIn("--region", told)
        self.assertIn("kidney.msh is of one material", said.getvalue())

    def test_scenery_is_made_or_named_and_stays_behind_when_another_organ_comes(self):
        specs = [{"mesh": "phantom:cavity"}, {"mesh": "/data/ribs.vtk"}]
        with mock.patch.object(organs, "phantom_mesh", lambda options, cache, word: f"made/{word}.msh"):
            self.assertEqual(organs.scenery_files(mock.Mock(organ=None), None, specs),
                             ["made/cavity.msh", "/data/ribs.vtk"])
            self.assertEqual(organs.scenery_files(mock.Mock(organ="kidney.msh"), None, specs), [])

    def test_support_file_of_a_scene_lies_beside_it(self):
        scene = self.folder / "scenes" / "a.toml"
        self.assertEqual(organs.relative_to(scene, "nodes.csv:xz"), str(self.folder / "scenes" / "nodes.csv:xz"))
        self.assertEqual(organs.relative_to(scene, "/else/nodes.csv"), "/else/nodes.csv")
        self.assertEqual(organs.relative_to(scene, "plane:y>0.05"), "plane:y>0.05")

    def test_guess_of_the_scale_is_said_with_its_reason(self):
        def guess(length):
            with contextlib.redirect_stdout(io.StringIO()) as said:
                scale = organs.guessed_scale("a.msh", {"min": [0, 0, 0], "max": [length, length / 2, 0]})
            return scale, said.getvalue()

        scale, said = guess(6.5)
        self.assertEqual(scale, 0.001)
        for part in ("warning: a.msh is 6.5 units long: taken as millimetres", "longer than 1 m", "an organ of 6.5 mm"):
            self.assertIn(part, said)
        scale, said = guess(0.0065)
        self.assertEqual(scale, 1.0)
        self.assertIn("warning: a.msh is 0.0065 units long: taken as metres", said)
        self.assertNotIn("warning", guess(0.18)[1])

    def test_help_names_the_environment(self):
        text = " ".join(options.build_parser().format_help().split())
        for said in ("OMENTUM_CACHE=FOLDER", "build/cache", "OMENTUM_BIN=FOLDER", "--log"):
            self.assertIn(said, text)

    def test_a_warning_of_two_programs_is_said_once(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            organs.pass_on_warnings("organ_build: warning: the organ is 3 m long\norgan_build: 34 %\n")
            organs.pass_on_warnings("scene_prepare: warning: the organ is 3 m long\n")
        self.assertEqual(said.getvalue(), "organ_build: warning: the organ is 3 m long\n")

    def test_both_files_of_a_mesh_in_capitals_are_part_of_the_cache(self):
        node = self.folder / "liver.NODE"
        node.write_text("1")
        first = self.build("plane:y>0", mesh=node)
        self.assertEqual(self.build("plane:y>0", mesh=node), first)
        (self.folder / "liver.ELE").write_text("another")
        self.assertNotEqual(self.build("plane:y>0", mesh=node), first)

    def test_organ_of_another_organ_build_is_made_again(self):
        # whose format may be another
        (self.folder / "organ_build").write_text("format 2")
        first = self.build("plane:y>0")
        (self.folder / "organ_build").write_text("format 3")
        self.assertNotEqual(self.build("plane:y>0"), first)

    def test_a_users_organ_takes_the_place_of_the_first_alone(self):
        specs = [{"has_file": True, "file": "", "mesh": f"phantom:{kind}", "name": name, "metres_per_unit": 1,
                  "fixed": "plane:y>0"}
                 for kind, name in (("paper", "liver"), ("gallbladder", "sac"))]
        made = []

        def tool(_, words, __):
            made.append(words[1:-2])
            pathlib.Path(words[-1]).write_text(words[2])

        for given, wanted in ((None, ["liver", "sac"]), (self.folder / "own.h5", [self.folder / "own.h5", "sac"])):
            opened = mock.Mock(programs=self.folder, organ=given, scene=HOLD)
            with mock.patch.object(organs, "run_tool", tool), \
                    mock.patch.object(organs, "build_organ", lambda _, __, mesh, name, *more: name):
                self.assertEqual(organs.organ_files(opened, cache.Cache(), specs), wanted)
        self.assertEqual(made, [["--size", "paper"], ["--part", "gallbladder"]])

    def test_organ_of_another_name_is_another_file_and_takes_none_away(self):
        first = self.build("plane:y>0", "liver")
        second = self.build("plane:y>0", "spleen")
        self.assertNotEqual(first.parent, second.parent)
        self.assertTrue(first.is_file())

    def test_longest_unused_files_are_forgotten(self):
        store = cache.Cache()
        with mock.patch.object(cache, "KEPT_BYTES", 25):
            made = [store.get(f"{name}.h5", [], lambda file: file.write_text("x" * 10)) for name in "abcd"]
            for age, file in enumerate(made):
                day = time.time() - (10 - age) * cache.IN_USE_S
                os.utime(file.parent, (day, day))
            store.get("d.h5", [], None)
        self.assertEqual([file.exists() for file in made], [False, False, True, True])

    def test_who_waits_for_the_cache_says_for_whom(self):
        store, said, waiting = cache.Cache(), [], threading.Event()

        def tell(line, **_):
            said.append(line)
            waiting.set()

        def other():
            cache.Cache().get("b.h5", [], lambda file: file.write_text("b"))

        with mock.patch.object(cache, "PATIENCE_S", 0), mock.patch("builtins.print", tell), store.locked("a.h5"):
            thread = threading.Thread(target=other)
            thread.start()
            self.assertTrue(waiting.wait(PATIENCE_S))
        thread.join()
        self.assertIn(f"process {os.getpid()} makes a.h5", said[0])

    def test_named_domain_is_not_given_to_another_session(self):
        free = domain.Domain()
        number = free.number
        free.socket.close()
        named = domain.Domain(number)
        self.addCleanup(named.socket.close)
        other = domain.Domain()
        self.addCleanup(other.socket.close)
        self.assertNotEqual(other.number, number)
        self.assertEqual(domain.Domain(number).number, number, "a person may join it")

    def stopped(self, once, program):
        """How a node ends whose session ends once it wrote the file `once`. `program` is its Python, with two words."""
        node = processes.Node("virtual_device", [sys.executable, "-c", f"""
import pathlib, signal, sys, time
def say(word):
    pathlib.Path({str(self.folder)!r}, word).touch()
def hear(on_signal):
    signal.signal(signal.SIGTERM, on_signal)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
{program}
"""], self.folder / "report.json")
        node.start()
        deadline = time.monotonic() + PATIENCE_S
        while not (self.folder / once).exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        processes.stop_all([node])
        return node.exit

    def test_a_node_is_told_once_to_end(self):
        # as after main: the handler is gone while libraries still end their threads
        self.assertEqual(self.stopped("listens", f"""
def end(*_):
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    time.sleep({3 * processes.LEAD_S})
    sys.exit(0)
hear(end)
say("listens")
time.sleep({PATIENCE_S})"""), 0)

    def test_a_node_that_does_not_listen_yet_ends_when_it_does(self):
        self.assertEqual(self.stopped("begins", f"""
say("begins")
time.sleep({3 * processes.LEAD_S})
hear(lambda *_: sys.exit(0))
time.sleep({PATIENCE_S})"""), 0)

    def ended(self, name, code, own_report="{}", starts=2):
        """What a session that restarts nodes makes of one's end."""
        file = self.folder / f"{name}.json"
        file.write_text(own_report)
        watching = session.Session.__new__(session.Session)
        watching.options, watching.restarts, watching.stopping = mock.Mock(restart=True), {}, False
        node = mock.Mock(exit=code, starts=starts, report=file)
        node.name = name
        with mock.patch("builtins.print"):
            watching.ended(node, elapsed=1.0)
        return watching

    def test_closed_window_ends_the_session_and_an_ended_render_node_does_not(self):
        self.assertTrue(self.ended("render_node", 0, '{"closed": true}').stopping)
        self.assertFalse(self.ended("render_node", 0, '{"closed": false}').stopping)
        self.assertFalse(self.ended("render_node", -9, "").stopping)

    def test_crashed_nodes_start_again_but_neither_ended_nor_refusing_ones(self):
        self.assertIn("deform_node", self.ended("deform_node", -11).restarts)
        self.assertNotIn("deform_node", self.ended("deform_node", 0).restarts)
        self.assertNotIn("deform_node", self.ended("deform_node", 2).restarts)

    def test_a_node_that_this_machine_cannot_run_ends_no_session_and_is_not_tried_again(self):
        file = self.folder / "render_node.json"
        watching = session.Session.__new__(session.Session)
        watching.options, watching.restarts, watching.stopping = mock.Mock(restart=True), {}, False
        node = mock.Mock(exit=processes.MACHINE_LACKS, starts=1, report=file)
        node.name = "render_node"
        with mock.patch("builtins.print") as said:
            self.assertNotEqual(watching.ended(node, elapsed=1.0), processes.REFUSED)
        self.assertFalse(watching.stopping)
        self.assertEqual(watching.restarts, {})
        self.assertIn("the others go on", str(said.call_args_list))

    def test_a_session_has_one_journal_of_cuts_for_every_deform_node_and_none_from_before(self):
        def journal():
            made = session.Session.__new__(session.Session)
            made.options = options.parse([str(HOLD), "--headless"])
            made.scene, made.headless, made.domain = HOLD, True, mock.Mock(number=1)
            made.folder = tempfile.TemporaryDirectory()
            self.addCleanup(made.folder.cleanup)
            command, = (node.command for node in made.make_nodes() if node.name == "deform_node")
            return pathlib.Path(command[command.index("--journal") + 1])
        self.assertFalse(journal().exists())
        self.assertNotEqual(journal(), journal())

    def test_stolen_time_is_a_share_of_the_time_since_the_watch_began(self):
        stat = self.folder / "stat"
        stat.write_text("cpu  900 0 50 8000 10 0 0 40 500 0\ncpu0 1 2 3\n")
        watch = machine.StealWatch(stat)
        self.assertEqual(watch.share(), 0)
        stat.write_text("cpu  930 0 60 8050 10 0 0 50 530 0\ncpu0 1 2 3\n")
        self.assertEqual(watch.share(), 0.1)
        stat.write_text("cpu  1000 0 60 8050\n")  # a kernel that does not count it
        self.assertEqual(machine.processor_times(stat.read_text())[0], 0)

    def read_only_cache(self, said):
        """What another user's session finds: the outcome of get() for a file that is there and for one that is not."""
        if os.geteuid() != 0:
            self.skipTest("another user's folders need root to make")
        store = cache.Cache()
        store.get("a.h5", [], lambda file: file.write_text("a"))
        self.folder.chmod(0o755)
        child = os.fork()
        if child == 0:
            code = 1
            try:
                os.setgid(65534)
                os.setuid(65534)
                held = cache.Cache().get("a.h5", [], None)
                try:
                    cache.Cache().get("b.h5", [], None)
                except Refusal as refusal:
                    said.write(f"{held}\n{refusal}")
                    said.flush()
                    code = 0
            finally:
                os._exit(code)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

    def test_a_cache_of_another_user_serves_what_it_holds_and_names_the_way_out(self):
        with open(self.folder / "said", "w+", encoding="utf-8") as said:
            self.assertEqual(self.read_only_cache(said), 0)
            said.seek(0)
            held, refusal = said.read().splitlines()
        self.assertTrue(held.endswith("a.h5"), held)
        self.assertIn("OMENTUM_CACHE", refusal)
        self.assertIn(str(self.folder / "cache"), refusal)

    def test_a_checkout_of_another_user_names_the_way_out(self):
        if os.geteuid() != 0 or not shutil.which("setpriv"):
            self.skipTest("another user needs root and setpriv")
        checkout = self.folder / "checkout"
        shutil.copytree(REPOSITORY / "launch_scripts", checkout / "launch_scripts")
        self.folder.chmod(0o755)
        done = subprocess.run(["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-c",
                               "source launch_scripts/build.sh; build_preset release"], cwd=checkout, capture_output=True,
                              text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("OMENTUM_BIN", done.stderr)
        self.assertIn("OMENTUM_CACHE", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_report_replaces_files_only_and_says_why_it_cannot(self):
        target = self.folder / "far.json"
        link = self.folder / "report.json"
        link.symlink_to(target)
        report.write({"a": 1}, link)
        self.assertTrue(link.is_symlink())
        self.assertEqual(json.loads(target.read_text()), {"a": 1})
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for place in (pipe, pathlib.Path("/dev/null"), self.folder / "absent" / "report.json"):
            with self.assertRaises(Refusal) as refused:
                report.write({}, place)
            self.assertIn(str(place), str(refused.exception))
        self.assertTrue(pipe.is_fifo())
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["far.json", "pipe", "report.json"])

    def test_a_session_in_which_no_answer_came_is_told_from_one_that_was_short(self):
        def met(seconds, answers):
            loop = {**report.NO_LOOP, "rate_hz": 1000.0, "ticks": int(1000 * seconds)}
            hand = {"loop": loop, "sent": loop["ticks"], "round_trip_us": {**report.NONE_US, "count": answers}}
            return not report.never_answered({"nodes": {"haptic_node": {"loop": loop}, "virtual_device": hand}})

        self.assertFalse(met(8, 0))
        self.assertTrue(met(8, 1))
        self.assertTrue(met(2, 0))
        self.assertFalse(report.never_answered({"nodes": {"haptic_node": {}}}))

    def test_table_shows_the_devices_round_trip_and_losses(self):
        times = {**report.NONE_US, "p50": 180.0, "p99": 2500.0, "max": 9000.0, "count": 7}
        node = {"dds": "fast", "exit": 0, "restarts": 0, "loop": report.NO_LOOP, "round_trip_us": times, "sent": 70,
                "lost": 3}
        row = report.node_row("virtual_device", node)
        self.assertEqual(row[4:], ["70 poses", "3 lost", "round trip", "180 us", "2.5 ms", "9.0 ms"])

    def test_what_organs_lack_is_told_beside_what_it_cost(self):
        organ = {**report.FIELDS["deform_node"], "removed_tetrahedra": 312, "repaired_tetrahedra": 4,
                 "cuts": {"way_cm": 12.0, "lost_cm3": 3.5, "lost_cm3_per_cm": 0.29}}
        self.assertEqual(report.removed_line(organ), "removed tetrahedra: 312; 4 went because they hung on a node or an "
                         "edge; 3.5 cm^3 lost over 12.0 cm of cut")
        torn = {**report.FIELDS["deform_node"], "removed_tetrahedra": 5}
        self.assertEqual(report.removed_line(torn), "removed tetrahedra: 5")

    def test_a_score_is_told_of_a_planned_cut_and_of_jaws_that_closed(self):
        probe = {"tool": 0, "force_max_n": 1.234, "pull_max_n": 0.0, "pulls_beyond_limit": 0}
        jaws = {"tool": 1, "force_max_n": 3.0, "pull_max_n": 6.5, "pulls_beyond_limit": 2, "grip_torque_max_nm": 0.012,
                "grasps": {"begun": 3, "empty": 1, "torn": 1, "lost": 0}}
        self.assertEqual(report.score_lines({"hands": [probe]}, {}), [])
        self.assertEqual(report.score_lines({"hands": [probe, jaws]}, {}),
                         ["hand 1: largest force 3.00 N, largest pull 6.50 N, 2 beyond the limit; "
                          "3 grasps (1 empty, 1 torn), up to 12.0 mN m on the jaws"])
        score = {"mean_mm": 1.26, "largest_mm": 4.0, "way_mm": 90.4, "removed_cm3": 5.0, "outside_cm3": 0.25, "seconds": 6.0}
        self.assertEqual(report.score_lines({"hands": [probe]}, {"score": score}),
                         ["cut: 1.3 mm from the planned line in the mean, 4.0 mm at most, over 90 mm; "
                          "0.2 of 5.0 cm^3 outside of it; 6.0 s", "hand 0: largest force 1.23 N"])
        nothing = dict.fromkeys(score, 0.0)
        self.assertEqual(report.score_lines({"hands": [probe]}, {"score": nothing})[0], "cut: nothing since the start or the last reset")

    def nodes_asked(self, *words):
        """The names of the nodes that a session gives `words`, of its own command line."""
        made = session.Session.__new__(session.Session)
        made.options = options.parse([str(HOLD), "--headless", *words])
        made.scene, made.headless, made.domain = HOLD, True, mock.Mock(number=1)
        made.folder = tempfile.TemporaryDirectory()
        self.addCleanup(made.folder.cleanup)
        return [node.name for node in made.make_nodes() if " ".join(words) in " ".join(node.command)]

    def test_a_map_a_video_and_the_panels_size_are_asked_of_render_node_alone(self):
        for words in (("--map", "stress"), ("--record", "30"), ("--ui-scale", "1.5")):
            self.assertEqual(self.nodes_asked(*words), ["render_node"], words)
        self.assertEqual(options.parse([str(HOLD), "--record"]).record, 25)
        self.assertIsNone(options.parse([str(HOLD)]).record)

    def test_how_devices_stand_is_asked_of_virtual_device_alone(self):
        frames = REPOSITORY / "device_bridge" / "examples" / "frames.toml"
        self.assertEqual(self.nodes_asked("--frames", str(frames)), ["virtual_device"])
        with self.assertRaisesRegex(Refusal, "--frames: missing.toml: no such file"):
            options.parse([str(HOLD), "--frames", "missing.toml"])

    def test_what_an_earlier_session_recorded_goes_and_nothing_else_does(self):
        for name in ("video/000000.png", "video_2/000001.png", "video_2/mine.png", "videos/000000.png", "video/notes/000000.png"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).touch()
        (self.folder / "video.mp4").touch()
        video.clear(self.folder)
        left = sorted(str(file.relative_to(self.folder)) for file in self.folder.rglob("*") if file.is_file())
        self.assertEqual(left, ["video/notes/000000.png", "video_2/mine.png", "videos/000000.png"])

    def record_told(self, found, **fields):
        """What is said of a video on a machine with or without ffmpeg."""
        told = {"folder": str(self.folder / "video"), "fps": 25.0, "seconds": 2.0, "pictures": 50, "repeated": 0, "dropped": 0}
        with mock.patch.object(video.shutil, "which", lambda _: found), mock.patch("builtins.print") as said:
            video.make({**told, **fields})
        return "\n".join(str(call.args[0]) for call in said.call_args_list)

    def test_without_ffmpeg_the_command_is_told_and_what_is_missing_too(self):
        said = self.record_told(None, repeated=7, dropped=3)
        self.assertIn("-framerate 25 -i", said)
        self.assertIn("7 of them repeated", said)
        self.assertIn("3 were dropped", said)

    @unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is absent")
    def test_a_video_lasts_as_long_as_what_it_shows(self):
        (self.folder / "video").mkdir()
        picture = self.folder / "video" / "000000.png"
        subprocess.run(["ffmpeg", "-loglevel", "error", "-f", "lavfi", "-i", "color=red:size=65x41", "-frames:v", "1", picture],
                       check=True, stdin=subprocess.DEVNULL)
        for number in range(1, 50):
            os.link(picture, self.folder / "video" / f"{number:06}.png")
        self.assertIn("video.mp4", self.record_told(shutil.which("ffmpeg")))
        length = subprocess.run(["ffprobe", "-loglevel", "error", "-show_entries", "format=duration", "-of", "csv=p=0",
                                 self.folder / "video.mp4"], capture_output=True, text=True, check=True).stdout
        self.assertAlmostEqual(float(length), 2.0, delta=0.05)


    def test_a_mouse_is_a_device_of_sessions_with_a_window(self):
        with mock.patch.dict(os.environ, {"DISPLAY": ":7"}):
            made = session.Session.__new__(session.Session)
            made.options = options.parse([str(HOLD), "--device", "mouse"])
            with self.assertRaisesRegex(Refusal, "needs a window"):
                options.parse(["--device", "mouse", "--headless"])
        made.scene, made.headless, made.domain = HOLD, False, mock.Mock(number=1)
        made.folder = tempfile.TemporaryDirectory()
        self.addCleanup(made.folder.cleanup)
        self.assertEqual([node.name for node in made.make_nodes() if "--mouse" in node.command], ["virtual_device"])
        with mock.patch.dict(os.environ):
            os.environ.pop("DISPLAY", None)
            os.environ.pop("WAYLAND_DISPLAY", None)
            with self.assertRaisesRegex(Refusal, "needs a display"):
                options.parse(["--device", "mouse"])


class Refusals(LauncherTest):
    """One line, exit code 2, no session."""

    def check_refused(self, *arguments, about):
        done = self.run_it(*arguments, "--headless", "--seconds", "2", "--out", self.out)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        # a node that had started beside the one that refused may have told that this user has no privilege
        lines = [line for line in done.stderr.strip().splitlines() if "warning: no real-time priority" not in line]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn(about, lines[0])
        self.assertNotIn("median", done.stdout, "no table of a session that never was")
        self.assertFalse((self.out / "report.json").exists())
        self.assertFalse(list(self.out.glob("*.png")))

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_wrong_words(self):
        self.check_refused("--dds", "telepathy", about="telepathy")
        self.check_refused("--dds", "haptic=fast,nose=fast", about="nose")
        self.check_refused("--device", "broom", about="broom")
        self.check_refused("--device", "mouse", about="mouse")
        self.check_refused("--device", "mouse", "--frames", HOLD, about="--frames: a mouse has no frames")
        self.check_refused("--device", "trace:missing.csv", about="missing.csv")
        self.check_refused("--keystore", "keys", about="--secure")
        self.check_refused("--secure", "--keystore", "missing", about="make_keystore missing")
        self.check_refused("--domain", "500", about="500")
        self.check_refused("--rate-hz", "0", about="--rate-hz")
        self.check_refused("--record", "0", about="--record")
        self.check_refused("--ui-scale", "9", about="--ui-scale")
        self.check_refused("--frobnicate", about="--frobnicate")

    def test_what_a_node_refuses(self):
        self.check_refused("--device", f"trace:{self.file('bad.csv', 'no trace')}", about="bad.csv")

    def test_wrong_scenes(self):
        self.check_refused("missing.toml", about="missing.toml")
        self.check_refused(self.file("syntax.toml", "name = \n"), about="syntax.toml:1")
        self.check_refused(self.file("key.toml", HOLD.read_text() + "\nflavour = 3\n"), about="flavour")
        two = (options.REPOSITORY / "scenes" / "two_organs.toml").read_text()
        line = two[:two.index('name = "gallbladder"')].count("\n") + 1
        self.check_refused(self.file("twice.toml", two.replace('name = "gallbladder"', 'name = "liver"')),
                           about=f'twice.toml:{line}: organs[1].name: found "liver" again')
        self.check_refused(self.file("mesh.toml", HOLD.read_text().replace("phantom:paper", "gone.msh")), about="gone.msh")

    def test_wrong_organs(self):
        self.check_refused("--organ", "missing.msh", about="missing.msh")
        self.check_refused("--organ", self.file("broken.msh", "$MeshFormat\n2.2 0 8\n"), about="broken.msh")
        self.check_refused("--organ", self.file("broken.h5", "no organ"), about="broken.h5")
        self.check_refused("--organ", self.file("organ.doc", "no organ"), about="organ.doc")


if __name__ == "__main__":
    unittest.main(verbosity=2)
