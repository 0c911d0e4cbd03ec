#!/usr/bin/env python3
"""device_check against bridges that are processes: those that do what they owe, and one that is killed.

Usage: device_check_test.py PROGRAMS      the folder of device_check, virtual_device and the examples
"""
import json
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(sys.argv[1])


# what a busy machine can spoil; bridge_trial_test judges these by a clock of its own
TIMED = {"poses come evenly", "answers are exerted", "without answers it lets go, and poses go on"}


def claim_domain():
    """Its number, and what holds it for as long as it is open: domain_of_test() of tests/support/process.h."""
    for number in range(100, 0, -1):
        held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            held.bind(f"\0omentum-domain-{number}")
            return str(number), held
        except OSError:
            held.close()
    raise RuntimeError("all DDS domains are in use")


class Check:
    """A bridge and the check beside it, in a domain of their own."""

    def __init__(self, vendor, bridge, how_it_ends=signal.SIGTERM):
        self.how_it_ends = how_it_ends
        number, self.domain = claim_domain()
        self.folder = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.folder.name) / "verdicts.json"
        self.check = subprocess.Popen(
            [PROGRAMS / "device_check", "--dds", vendor, "--domain", number, "--listen", "1", "--report", self.file],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.bridge = subprocess.Popen([PROGRAMS / bridge[0], *[word.replace("DOMAIN", number) for word in bridge[1:]]],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def finish(self):
        """Which requirements passed and which failed, and all that was said."""
        told = ""
        for line in self.check.stdout:
            told += line
            if "now end the bridge" in line:
                self.bridge.send_signal(self.how_it_ends)
        self.check.stdout.close()
        self.check.wait()
        self.bridge.kill()
        self.bridge.wait()
        verdicts = json.loads(self.file.read_text())["requirements"]
        passed, failed = ({one["requirement"] for one in verdicts if one["outcome"] == word} - TIMED for word in ("pass", "FAIL"))
        self.folder.cleanup()
        self.domain.close()
        return passed, failed, told


class DeviceCheck(unittest.TestCase):
    def test_what_it_says_of_bridges_that_are_right_and_of_one_that_is_killed(self):
        in_c, in_cpp = ["cyclone_bridge", "DOMAIN"], ["fast_bridge", "DOMAIN"]
        hands = ["virtual_device", "--scene", str(REPOSITORY / "scenes" / "liver.toml"), "--dds", "fast", "--domain", "DOMAIN"]
        good = {"in C": Check("cyclone", in_c), "in C++": Check("fast", in_cpp), "ours": Check("fast", hands)}
        killed = Check("cyclone", in_c, signal.SIGKILL)
        with ThreadPoolExecutor() as pool:
            last = pool.submit(killed.finish)
            for name, (passed, failed, told) in zip(good, pool.map(Check.finish, good.values())):
                self.assertEqual(failed, set(), f"{name}: {told}")
                self.assertGreaterEqual(len(passed), 9, told)
        _, failed, told = last.result()
        self.assertEqual(failed, {"it leaves cleanly"}, told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
