"""The processes of a session: started, watched, ended by their own ids."""
import shlex
import signal
import subprocess
import time

from .host import Here
from .telling import tell

STOP_PATIENCE_S = 8.0  # a node writes its report, render_node its last pictures
LEAD_S = 0.15  # the hand lets go before the others end
REFUSED = 2  # exit code of bad input
MACHINE_LACKS = 3  # and of a node that this machine has no means for, as a display


class Node:
    """One process of the session. Started again, it keeps its place."""

    def __init__(self, name, command, report, processors=None, host=Here()):
        """`report`: the file here that its own report becomes; None: it writes none."""
        self.name, self.command, self.report, self.processors, self.host = name, command, report, processors, host
        self.process, self.exit, self.starts = None, None, 0
        self.told_to_end = False

    def start(self):
        self.exit, self.told_to_end = None, False
        self.starts += 1
        # the report of the run before goes: this one may end without one
        self.process = self.host.popen(self.command, processors=self.processors, results=[self.report] if self.report else [])

    def running(self):
        return self.process is not None and self.exit is None

    def ended_now(self):
        """True once, when the process is found ended."""
        if not self.running() or self.process.poll() is None:
            return False
        self.exit = self.process.returncode
        return True

    def terminate(self):
        """Once: a second signal would meet a process that has ended all but its libraries' threads."""
        if self.running() and not self.told_to_end and self.process.poll() is None:
            self.told_to_end = True
            self.process.terminate()

    def realtime(self):
        return self.running() and self.host.realtime(self.process)

    def failed(self):
        """A node that was never started, in a session that ended before its turn, did not fail."""
        return self.starts > 0 and self.exit != 0

    def restarts(self):
        return max(0, self.starts - 1)

    def how_it_ended(self):
        if self.exit < 0:
            return f"was ended by {signal.Signals(-self.exit).name}"
        return f"ended with code {self.exit}"

    def command_line(self):
        return shlex.join(self.command)


def start_all(nodes):
    try:
        for node in nodes:
            node.start()
    except BaseException:
        stop_all(nodes)
        raise


def stop_all(nodes):
    """SIGTERM, patience, SIGKILL; only to our own children. The device goes first: the hand has let go; and render_node,
    whose last picture shows what it was like until then."""
    for name in ("render_node", "virtual_device"):
        for node in nodes:
            if node.name == name:
                node.terminate()
    if any(node.running() for node in nodes):
        time.sleep(LEAD_S)
    for node in nodes:
        node.terminate()
    deadline = time.monotonic() + STOP_PATIENCE_S
    for node in nodes:
        if not node.running():
            continue
        try:
            node.exit = node.process.wait(max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            tell(f"run: {node.name} does not end: killed")
            node.process.kill()
            node.exit = node.process.wait()
