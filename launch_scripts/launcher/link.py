"""The launcher's end of a connection to its agent on another machine (agent.py), which it brings there itself."""
import contextlib
import ctypes
import io
import itertools
import pathlib
import queue
import shlex
import signal
import subprocess
import sys
import tarfile
import tempfile
import threading

from . import wire
from .errors import Refusal
from .host import PR_SET_PDEATHSIG
from .remote_process import RemoteProcess

PING_S = 1.0
ANSWER_S = 90.0  # longer than ssh waits for a network
# the launcher's own modules, unpacked to a place of their own: whatever version another session has there
BOOTSTRAP = """import io, signal, sys, tarfile, tempfile
signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
with tempfile.TemporaryDirectory(prefix="omentum-agent-") as place:
    size = int(sys.stdin.buffer.readline())
    tarfile.open(fileobj=io.BytesIO(sys.stdin.buffer.read(size))).extractall(place)
    sys.path.insert(0, place)
    from launcher import agent
agent.main(sys.argv[1])
"""


def own_modules():
    """This package as a tar archive."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w") as archive:
        for file in sorted(pathlib.Path(__file__).parent.glob("*.py")):
            archive.add(file, f"launcher/{file.name}")
    return packed.getvalue()


class Link:
    """One command at a time is asked and answered; what programs say and when they end comes by itself."""

    def __init__(self, name, reach, directory):
        """`reach`: the words that, with a line of shell behind them, run it on the machine `name`. Raises Refusal."""
        self.name, self.lost, self.misheard = name, False, None
        self.answers, self.started, self.numbers = queue.Queue(), {}, itertools.count(1)
        self.writing, self.closing = threading.Lock(), threading.Event()
        line = f"exec python3 -B -c {shlex.quote(BOOTSTRAP)} {shlex.quote(directory)}"
        self.errors = tempfile.TemporaryFile("w+")
        try:
            # a group of its own: Ctrl-C is for the launcher, which tells the nodes
            self.process = subprocess.Popen([*reach, line], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors,
                                            start_new_session=True, preexec_fn=end_with_launcher)
        except OSError as error:
            raise Refusal(f"{name}: {reach[0]}: {error.strerror}") from error
        modules = own_modules()
        self.send_raw(f"{len(modules)}\n".encode() + modules)
        threading.Thread(target=self.listen, daemon=True).start()
        threading.Thread(target=self.ping, daemon=True).start()

    def send_raw(self, content):
        try:
            with self.writing:
                self.process.stdin.write(content)
                self.process.stdin.flush()
        except OSError:
            self.lost = True

    # asking
    def ask(self, do, payload=b"", **what):
        """The answer to one message; `payload` as wire.write takes it. Raises Refusal, also when the link is lost."""
        self.send(do, payload, **what)
        try:
            answer = self.answers.get(timeout=ANSWER_S)
        except queue.Empty:
            self.process.kill()  # the reader finds the end
            answer = self.answers.get()
        if answer is None:
            self.answers.put(None)
            raise Refusal(f"{self.name} cannot be reached{self.reason()}")
        if "refused" in answer:
            raise Refusal(f"{self.name}: {answer['refused']}")
        return answer

    def tell(self, do, **what):
        """As ask(), for what does not matter any more when the link is lost."""
        with contextlib.suppress(Refusal):
            self.ask(do, **what)

    def send(self, do, payload=b"", **what):
        try:
            with self.writing:
                wire.write(self.process.stdin, {"do": do, **what}, payload)
        except (OSError, ValueError):
            pass  # the reader finds the end of the link

    def reason(self):
        """What ssh, or the other side, said last."""
        if self.misheard:
            return f": {self.misheard} where its agent should speak: a login without a terminal must print nothing"
        self.errors.seek(0)
        lines = self.errors.read().strip().splitlines()
        return f": {lines[-1]}" if lines else ""

    # hearing
    def listen(self):
        try:
            while message := wire.read(self.process.stdout):
                if message.get("event"):
                    self.pass_on(message)
                elif message["answer"] == "get":
                    self.answers.put({"content": list(wire.parts(self.process.stdout, message["bytes"]))})
                else:
                    self.answers.put(message)
        except wire.Foreign as error:
            self.misheard = str(error)
        except (EOFError, ValueError, OSError):
            pass
        self.lost = True
        for process in list(self.started.values()):
            process.end(RemoteProcess.LOST)
        self.answers.put(None)

    def pass_on(self, event):
        process = self.started.get(event["process"])
        if process is None:
            return
        if event["event"] == "ended":
            process.end(event["code"])
        elif event["event"] == "realtime":
            process.is_realtime = True
        elif process.captured:
            process.hear(event["stream"], event["line"])
        else:
            own = sys.stdout if event["stream"] == "out" else sys.stderr
            own.write(f"{self.name}: {event['line']}")
            own.flush()

    def ping(self):
        while not self.closing.wait(PING_S) and not self.lost:
            self.send("ping")

    # the end
    def close(self, patience_s=10.0):
        """The agent ends its programs, if there are any left, and itself."""
        self.closing.set()
        try:
            self.process.stdin.close()
        except OSError:
            pass
        try:
            self.process.wait(patience_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        self.errors.close()


def end_with_launcher():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
