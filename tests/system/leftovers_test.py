#!/usr/bin/env python3
"""What killed Fast DDS processes leave in /dev/shm: the session's own is removed, and nothing else.

Environment: OMENTUM_BIN (programs, with transport_peer)."""
import fcntl
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher import domain, leftovers  # noqa: E402 (the launcher is no installed package)

PEER = pathlib.Path(os.environ.get("OMENTUM_BIN", REPOSITORY / "build" / "release" / "bin")) / "transport_peer"
HOLD = REPOSITORY / "tests" / "system" / "hold.toml"
PATIENCE_S = 60


class Parts(unittest.TestCase):
    """Folders in the place of /dev/shm and /proc."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.memory, self.processes = pathlib.Path(folder.name) / "shm", pathlib.Path(folder.name) / "proc"
        self.memory.mkdir()
        self.left = leftovers.Leftovers(self.memory, self.processes)

    def make(self, pid, name):
        """A segment or port of a process, which holds its lock open."""
        for file in (name, name + "_el", f"sem.{name}_mutex"):
            (self.memory / file).touch()
        held = self.processes / str(pid) / "fd"
        held.mkdir(parents=True, exist_ok=True)
        (held / str(len(list(held.iterdir())))).symlink_to(self.memory / (name + "_el"))

    def files(self):
        return {file.name for file in self.memory.iterdir()}

    def test_removes_what_a_dead_process_of_its_own_has_made_and_nothing_of_others(self):
        for name in ("fastrtps_0123456789abcdef", "fastrtps_port7410"):
            self.make(1, name)
        self.make(2, "fastrtps_fedcba9876543210")
        (self.memory / "somebody_el").touch()
        others = self.files() - {file for file in self.files() if "0123" in file or "7410" in file}
        self.left.look(1)
        self.left.remove()
        self.assertEqual(self.files(), others)

    def test_what_a_living_process_holds_stays_until_it_ends(self):
        self.make(1, "fastrtps_port7410")
        self.left.look(1)
        with open(self.memory / "fastrtps_port7410_el", "rb") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            before = self.files()
            self.left.remove()
            self.assertEqual(self.files(), before)
        self.left.remove()
        self.assertEqual(self.files(), set())

    def test_a_process_that_has_gone_is_no_error(self):
        self.left.look(12345)
        self.left.remove()
        self.assertEqual(self.files(), set())


class RealProcess(unittest.TestCase):
    def test_a_killed_fast_process_leaves_nothing_behind(self):
        claimed = domain.Domain()
        self.addCleanup(claimed.socket.close)
        left = leftovers.Leftovers()
        peer = subprocess.Popen([PEER, "poses", "fast", str(claimed.number), "loopback"], stdin=subprocess.PIPE,
                                stdout=subprocess.PIPE)
        try:
            peer.stdout.read(1)  # its writers exist
            left.look(peer.pid)
        finally:
            peer.send_signal(signal.SIGKILL)
            peer.communicate()
        made = set(left.made)
        self.assertTrue(any("port" in name for name in made) and any("port" not in name for name in made), made)
        self.assertTrue(all((leftovers.SHARED_MEMORY / name).exists() for name in made), "it leaves nothing by itself")
        deadline = time.monotonic() + PATIENCE_S
        while left.made and time.monotonic() < deadline:  # another process may look at a lock just now
            left.remove()
        names = {form.format(name) for name in made for form in ("{}", "{}_el", "{}_sl", "sem.{}_mutex")}
        self.assertEqual(names & {file.name for file in leftovers.SHARED_MEMORY.iterdir()}, set())

    def test_a_session_removes_what_its_killed_node_left(self):
        with tempfile.TemporaryDirectory(prefix="omentum-test-") as folder:
            run = subprocess.Popen(
                [sys.executable, "-B", REPOSITORY / "launch_scripts" / "supervisor.py", HOLD, "--headless", "--device",
                 "none", "--out", folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                node, left = self.fast_child_of(run.pid)
                os.kill(node, signal.SIGKILL)
                time.sleep(0.5)  # the session finds out
            finally:
                run.send_signal(signal.SIGINT)
                run.wait(PATIENCE_S)
        self.assertEqual({name for name in left.made if (leftovers.SHARED_MEMORY / name).exists()}, set())

    def fast_child_of(self, pid):
        """A process of the session, once it has made its segment and ports, and what they are."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
                left = leftovers.Leftovers()
                left.look(child)
                if len(left.made) >= 3:
                    time.sleep(0.5)  # the session looks too
                    return int(child), left
            time.sleep(0.05)
        raise AssertionError("no node uses shared memory")


if __name__ == "__main__":
    unittest.main()
