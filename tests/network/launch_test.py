#!/usr/bin/env python3
"""launch_scripts/launch: one secured session on three machines, which are network namespaces here, from one command.

Usage: launch_test.py PROGRAMS SCENE      the folder of the programs; a prepared scene
Exit code 77: this machine does not allow it; why is said.
"""
import json
import os
import pathlib
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest

from namespaces import SKIPPED, Network, obstacle

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS, SCENE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
NODES = {"theatre": ("haptic_node", "virtual_device"), "cluster": ("deform_node",), "gallery": ("render_node",)}
CYCLONES = ("deform_node", "virtual_device")
PICTURES, PATIENCE_S = 2, 60  # a picture each two seconds: the hand has heard of one by then


class Launch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.network = Network(PROGRAMS)
        self.addCleanup(self.network.close)

    def table(self):
        lines = []
        for host, nodes in NODES.items():
            lines += ["[[hosts]]", f'name = "{host}"', f'address = "{self.network.addresses[host]}"',
                      f'directory = "{self.folder / host}"', f'reach = {json.dumps([*self.network.within(host), "sh", "-c"])}']
            for node in nodes:
                lines += [f"[hosts.nodes.{node}]", f'dds = "{"cyclone" if node in CYCLONES else "fast"}"']
        file = self.folder / "hosts.toml"
        file.write_text("\n".join(lines) + "\n")
        return file

    def keys_of(self, host):
        """role -> mode of its key, in the sessions of a machine."""
        return {(file.parent.parent.name, file.parent.name): stat.S_IMODE(file.stat().st_mode)
                for file in (self.folder / host / "sessions").glob("*/keys/*/*/key.pem")}

    def wait_for(self, condition, session):
        deadline = time.monotonic() + PATIENCE_S
        while not condition() and session.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)

    def test_one_command_plays_a_secured_session_on_three_machines_and_brings_home_what_they_wrote(self):
        subprocess.run([REPOSITORY / "launch_scripts" / "make_keystore", self.folder / "keys"], check=True, stdout=subprocess.DEVNULL)
        command = [REPOSITORY / "launch_scripts" / "launch", self.table(), SCENE, "--headless", "--log", "--secure", "--keystore",
                   self.folder / "keys", "--out", self.folder / "out"]
        session = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env={**os.environ, "OMENTUM_BIN": str(PROGRAMS)})
        self.addCleanup(session.stdout.close)
        self.addCleanup(lambda: session.poll() is None and session.kill())
        self.wait_for(lambda: ("cyclone", "deform_node") in self.keys_of("cluster"), session)
        self.assertEqual(self.keys_of("cluster"), {("cyclone", "deform_node"): 0o600}, "its own key, and nobody else's")
        self.wait_for(lambda: len(list((self.folder / "gallery").glob("sessions/*/results/*/out/frame_*.png"))) >= PICTURES, session)
        session.send_signal(signal.SIGINT)
        said = session.communicate(timeout=PATIENCE_S)[0]
        self.assertEqual(session.returncode, 0, said)

        report = json.loads((self.folder / "out" / "report.json").read_text())
        hand = report["nodes"]["virtual_device"]
        self.assertGreater(hand["answers"], 0, said)
        self.assertGreater(report["link"]["tool_to_organ_us"]["count"], 0, "the hand heard of the organ on another machine")
        self.assertGreater(report["link"]["tool_to_picture_us"]["count"], 0, "and of its picture on a third one")
        self.assertEqual({name: tuple(host["nodes"]) for name, host in report["hosts"].items()}, NODES)
        self.assertTrue((self.folder / "out" / "final.png").stat().st_size > 0)
        for node in report["nodes"]:
            self.assertEqual(report["nodes"][node]["exit"], 0, said)
            if node != "render_node":
                self.assertGreater((self.folder / "out" / f"{node}.csv").stat().st_size, 0, node)
        for host in NODES:
            self.assertEqual(list((self.folder / host / "sessions").iterdir()), [], "only the files that are kept stay there")
        self.assertNotIn("warning: cluster", said, "namespaces of one machine pass the check")
        self.assertNotIn("reaches no port", said)


if __name__ == "__main__":
    why = obstacle()
    if why:
        print(f"skipped: {why}")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
