"""A machine of a session, as the session sees it: it takes files, starts programs and gives back what they wrote. This one,
where all is in place already; remote_host.py has the others."""
import ctypes
import functools
import os
import signal
import subprocess

from . import machine_facts, options, reach
from .errors import Refusal
from .machine import StealWatch

PR_SET_PDEATHSIG = 1


def prepare_child(processors=None, is_node=False):
    """In a new process, before its program."""
    # whatever ends the launcher ends its nodes
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if is_node:
        # one that does not listen yet is told when it does (runtime/signals.h)
        signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    if processors:
        os.sched_setaffinity(0, processors)


def realtime_granted(pid):
    """Whether any thread of the process runs under SCHED_FIFO: the kernel's word, not the node's."""
    folder = f"/proc/{pid}/task"
    try:
        policies = [os.sched_getscheduler(int(thread)) & ~os.SCHED_RESET_ON_FORK for thread in os.listdir(folder)]
        return os.SCHED_FIFO in policies
    except OSError:
        return False


class Here:
    """The launcher's own machine."""

    name = "this machine"

    def __init__(self, environment=None, spec=None):
        """`environment`: what the programs get beside the launcher's; `spec`: of the table of hosts, if it has one."""
        self.environment, self.spec, self.echo = environment or {}, spec, None
        self.name = spec.name if spec else Here.name
        self.clock_apart_s = self.round_trip_s = 0.0
        self.steal = StealWatch()

    @functools.cached_property
    def facts(self):
        return machine_facts.gather(self.spec.interface if self.spec else None)

    def meet(self):
        """Before all else."""

    def popen(self, command, processors=None, captured=False, results=()):
        """Starts a program. `captured`: its output is the caller's; `results`: files of an earlier run, which go.
        Raises Refusal."""
        for file in results:
            file.unlink(missing_ok=True)
        pipe = subprocess.PIPE if captured else None
        try:
            # a session of its own, among which Linux shares processors out: a node says how much of them it needs (runtime/niceness.h)
            return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=pipe, stderr=pipe, text=captured or None,
                                    start_new_session=True, env={**os.environ, **self.environment},
                                    preexec_fn=lambda: prepare_child(processors, is_node=not captured))
        except OSError as error:
            raise Refusal(f"{command[0]}: {error.strerror}") from error

    def file(self, path):
        """Where a program of this machine finds a file, or folder, of the launcher's."""
        return str(path)

    def result(self, path):
        """Where a program writes what gather() brings to `path`."""
        return str(path)

    def home(self, there):
        """Where gather() brings what a program says that it wrote at `there`."""
        return there

    def fetch(self, here):
        """Brings what a program wrote for `here` by now."""

    def gather(self):
        """Brings what the programs wrote."""

    def has_display(self):
        return options.has_display() or "DISPLAY" in self.environment

    def steal_share(self):
        """Of its processors' time, since it became a part of the session."""
        return self.steal.share()

    def realtime(self, process):
        """Whether a process that popen() started has a thread of real-time priority."""
        return realtime_granted(process.pid)

    # the network (reach.py), of a machine with a spec
    def echo_on(self, domain):
        """Answers the other machines' probes. Returns the ports at which it does."""
        self.echo = reach.Echo(self.name, domain, self.spec.address)
        return self.echo.ports

    def echo_off(self):
        self.echo.close()

    def probe(self, domain, others):
        """What each of `others` (name -> [address, ports]) answers."""
        return reach.probe(domain, self.spec.address, others)

    def forget(self):
        """Removes what the session has there: after gather()."""

    def abandon(self):
        """Whatever goes on with it ends; nothing of it can be asked any more."""

    def close(self):
        """After the last program ended."""
