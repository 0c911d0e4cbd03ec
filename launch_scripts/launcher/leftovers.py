"""What Fast DDS processes leave in shared memory when they are killed: 8.5 MB each."""
import contextlib
import fcntl
import os
import pathlib
import re

SHARED_MEMORY = pathlib.Path("/dev/shm")
PROCESSES = pathlib.Path("/proc")
# A living process holds flock() on the "_el" or "_sl" file beside each segment and port that it has made
LOCK = re.compile(r"(fastrtps_(?:[0-9a-f]{16}|port\d+))_[es]l")


class Leftovers:
    """Knows which of these files the session's own processes have made, by looking at what they hold open while they
    live, and removes those that no living process holds. Files of others are not touched, dead or not."""

    def __init__(self, shared_memory=SHARED_MEMORY, processes=PROCESSES):
        self.shared_memory, self.processes = pathlib.Path(shared_memory), pathlib.Path(processes)
        self.made = set()

    def look(self, pid):
        """Remembers what the process holds. Often enough to find what it has made before it may die."""
        try:
            for descriptor in (self.processes / str(pid) / "fd").iterdir():
                held = pathlib.Path(os.readlink(descriptor))
                match = LOCK.fullmatch(held.name)
                if match and held.parent == self.shared_memory:
                    self.made.add(match[1])
        except OSError:
            pass  # it has ended, or a descriptor was closed meanwhile

    def remove(self):
        """What was made and is held by nobody."""
        self.made = {name for name in self.made if not self.removed(name)}

    def removed(self, name):
        with contextlib.ExitStack() as locks:
            for end in ("_el", "_sl"):
                with contextlib.suppress(FileNotFoundError):
                    lock = locks.enter_context(open(self.shared_memory / (name + end), "rb"))
                    try:
                        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    except BlockingIOError:
                        return False  # somebody lives: a port's number goes to the next process of the domain
            # the locks go last: nobody takes the name up before the rest is gone
            for file in (name, f"sem.{name}_mutex", name + "_el", name + "_sl"):
                (self.shared_memory / file).unlink(missing_ok=True)
        return True
