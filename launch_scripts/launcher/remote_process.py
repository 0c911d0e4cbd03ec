"""A program on another machine, with as much of subprocess.Popen's interface as the launcher uses."""
import queue
import signal
import subprocess
import threading


class Lines:
    """Standard output or error as it comes."""

    def __init__(self):
        self.lines = queue.Queue()

    def readline(self):
        """Waits; empty at the end."""
        line = self.lines.get()
        if not line:
            self.lines.put("")
        return line

    def read(self):
        return "".join(iter(self.readline, ""))


class RemoteProcess:
    """Made by remote_host.py; link.py tells it what happens, on another thread."""

    LOST = 255  # the code of a program that nobody hears of any more, as ssh has it
    pid = None  # of another machine's

    def __init__(self, link, number, command, captured):
        self.link, self.number, self.command, self.captured = link, number, command, captured
        self.stdout, self.stderr = Lines(), Lines()
        self.returncode, self.is_realtime = None, False
        self.ended = threading.Event()

    def hear(self, stream, line):
        (self.stdout if stream == "out" else self.stderr).lines.put(line)

    def end(self, code):
        if self.returncode is None:
            self.returncode = code
        for stream in (self.stdout, self.stderr):
            stream.lines.put("")
        self.ended.set()

    def poll(self):
        return self.returncode

    def wait(self, timeout=None):
        if not self.ended.wait(timeout):
            raise subprocess.TimeoutExpired(self.command, timeout)
        return self.returncode

    def communicate(self, timeout=None):
        self.wait(timeout)
        return self.stdout.read(), self.stderr.read()

    def send_signal(self, number):
        """Waits for nothing: of a machine that is cut off the others, and the hand, are told to end at once."""
        if self.poll() is None:
            self.link.send("signal", quiet=True, process=self.number, number=int(number))

    def terminate(self):
        self.send_signal(signal.SIGTERM)

    def kill(self):
        """Waits for the answer: where none comes the link is given up, and wait() returns."""
        if self.poll() is None:
            self.link.tell("signal", process=self.number, number=int(signal.SIGKILL))
