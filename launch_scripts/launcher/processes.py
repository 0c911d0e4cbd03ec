"""The processes of a session: started, watched, ended by their own ids."""
import ctypes
import os
import shlex
import signal
import subprocess
import time

from .errors import Refusal

STOP_PATIENCE_S = 8.0  # a node writes its report, render_node its last pictures
LEAD_S = 0.15  # the hand lets go before the others end
REFUSED = 2  # exit code of bad input
MACHINE_LACKS = 3  # and of a node that this machine has no means for, as a display
PR_SET_PDEATHSIG = 1


class Node:
    """One process of the session. Started again, it keeps its place."""

    def __init__(self, name, command, report, processors=None):
        self.name, self.command, self.report, self.processors = name, command, report, processors
        self.process, self.exit, self.starts = None, None, 0
        self.told_to_end = False

    def start(self):
        self.exit, self.told_to_end = None, False
        self.starts += 1
        self.report.unlink(missing_ok=True)  # of the run before: this one may end without one
        try:
            # a session of its own, among which Linux shares processors out: a node says how much of them it needs (runtime/niceness.h)
            self.process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, start_new_session=True,
                                            preexec_fn=self.prepare_child)
        except OSError as error:
            raise Refusal(f"{self.command[0]}: {error.strerror}") from error

    def prepare_child(self):
        # whatever ends the launcher ends its nodes
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        # a node that does not listen yet is told when it does (runtime/signals.h)
        signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
        if self.processors:
            os.sched_setaffinity(0, self.processors)

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
            print(f"run: {node.name} does not end: killed", flush=True)
            node.process.kill()
            node.exit = node.process.wait()


def realtime_granted(node):
    """Whether any thread of the process runs under SCHED_FIFO: the kernel's word, not the node's."""
    folder = f"/proc/{node.process.pid}/task"
    try:
        policies = [os.sched_getscheduler(int(thread)) & ~os.SCHED_RESET_ON_FORK for thread in os.listdir(folder)]
        return os.SCHED_FIFO in policies
    except OSError:
        return False
