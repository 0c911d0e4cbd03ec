"""What acts for a launcher on another machine: takes files, starts programs, tells of them, gives back what they wrote.

Runs there as `python3 -c BOOTSTRAP`, fed by link.py with messages (wire.py) on its standard input. When that ends, or is
silent for SILENCE_S, the programs end: nothing goes on without somebody who watches it.
"""
import fcntl
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from . import machine_facts, reach, wire
from .domain import claim_here
from .errors import Refusal
from .host import Here, prepare_child, realtime_granted
from .machine import StealWatch
from .processes import Node, stop_all

SILENCE_S = 60.0  # a network that is cut for seconds ends no session; the launcher says something each second
SESSION_KEPT_S = 7 * 24 * 3600  # what a session wrote that nobody came for
FILE_KEPT_S = 30 * 24 * 3600  # since it was last asked for


class Captured(Here):
    """Starts programs with what they say in pipes: the agent's own output speaks to the launcher."""

    def popen(self, command, processors=None, captured=False, results=()):
        for file in results:
            file.unlink(missing_ok=True)
        try:
            return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                    errors="replace", start_new_session=True, env={**os.environ, **self.environment},
                                    preexec_fn=lambda: prepare_child(processors, is_node=True))
        except OSError as error:
            raise Refusal(f"{command[0]}: {error.strerror}") from error


class Agent:
    """Answers one message after the other."""

    def __init__(self, source, sink, directory):
        self.source, self.sink = source, sink
        self.store = directory / "files"
        self.store.mkdir(parents=True, exist_ok=True)
        require_own(self.store)
        sessions = directory / "sessions"
        sessions.mkdir(exist_ok=True)
        forget_keys(sessions)
        forget(sessions, SESSION_KEPT_S)
        forget(self.store, FILE_KEPT_S)
        self.session = pathlib.Path(tempfile.mkdtemp(prefix=f"{time.strftime('%Y%m%d-%H%M%S')}-", dir=sessions))
        self.alive = lock(self.session)
        self.processes, self.claim, self.echo = {}, None, None
        self.writing, self.heard, self.steal = threading.Lock(), time.monotonic(), StealWatch()

    # talking
    def say(self, message, payload=b""):
        with self.writing:
            wire.write(self.sink, message, payload)

    def serve(self):
        threading.Thread(target=self.watch_over, daemon=True).start()
        try:
            while message := wire.read(self.source):
                self.heard = time.monotonic()
                if message["do"] == "ping":
                    continue
                try:
                    answer = getattr(self, "do_" + message["do"])(message) or {}
                except Refusal as refusal:
                    answer = {"refused": str(refusal)}
                except OSError as error:
                    answer = {"refused": f"{error.filename or message['do']}: {error.strerror}"}
                if answer.get("sent") is None and not message.get("quiet"):
                    self.say({"answer": message["do"], **answer})
        except EOFError:
            pass  # the launcher died while it sent a file
        finally:
            self.leave()

    def watch_over(self):
        """Each second: who has real-time priority by now, and whether the launcher still speaks."""
        told = set()
        while time.monotonic() - self.heard < SILENCE_S:
            for number, node in list(self.processes.items()):
                if node.process.pid not in told and realtime_granted(node.process.pid):
                    told.add(node.process.pid)
                    self.tell({"event": "realtime", "process": number})
            time.sleep(1)
        while True:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(1)

    def leave(self):
        stop_all([entry for entry in self.processes.values() if entry.process is not None])
        # keys are of a session; what it wrote stays for a week where nobody came for it
        wrote = any(file.is_file() for file in (self.session / "results").rglob("*"))
        shutil.rmtree(self.session / "keys" if wrote else self.session, ignore_errors=True)

    # files
    def do_have(self, message):
        """Which of these hashes are not here; sizes tell a copy that was broken off."""
        lacks = []
        for digest, size in message["files"].items():
            file = self.store / digest
            if file.is_file() and file.stat().st_size == size:
                os.utime(file)
            else:
                lacks.append(digest)
        return {"lacks": lacks}

    def do_put(self, message):
        """A file into the store, by its hash, or into the session, by its name."""
        digest, name = message.get("digest"), message.get("name")
        pieces = wire.parts(self.source, message["bytes"])
        try:
            self.keep(self.store / digest if digest else self.session / name, message["mode"], pieces, digest)
        except OSError:
            for _ in pieces:
                pass  # what follows in the stream is the next message
            raise

    def keep(self, final, mode, pieces, digest):
        """Whole or not at all: a disk that was full does not stay so for a part of a file."""
        final.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        part, total = final.with_name(final.name + f".part{os.getpid()}"), hashlib.sha256()
        try:
            with open(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, mode), "wb") as file:
                for piece in pieces:
                    self.heard = time.monotonic()
                    total.update(piece)
                    file.write(piece)
            if digest and total.hexdigest() != digest:
                raise Refusal(f"{final}: arrived with the hash {total.hexdigest()}")
            part.rename(final)
        finally:
            part.unlink(missing_ok=True)

    def do_link(self, message):
        """A file of the store under a name of the session: a program is called by its own name, an organ found by it."""
        link = self.session / message["name"]
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to(self.store / message["digest"])

    def do_folder(self, message):
        (self.session / message["name"]).mkdir(parents=True, exist_ok=True)

    def do_list(self, message):
        """What there is of the session at `name`, a file or a folder."""
        place = self.session / message["name"]
        files = [place] if place.is_file() else [file for file in place.rglob("*") if file.is_file()]
        return {"files": [str(file.relative_to(self.session)) for file in files]}

    def do_get(self, message):
        with open(self.session / message["name"], "rb") as file:
            self.say({"answer": "get", "bytes": os.fstat(file.fileno()).st_size}, file)
        return {"sent": True}

    def do_forget(self, _):
        """All was fetched."""
        shutil.rmtree(self.session, ignore_errors=True)

    # programs
    def do_start(self, message):
        node = Node(message["name"], message["command"], pathlib.Path(message["report"]) if message["report"] else None,
                    message["processors"], Captured(message["environment"]))
        node.start()
        self.processes[message["process"]] = node
        threading.Thread(target=self.watch, args=(message["process"], node), daemon=True).start()

    def watch(self, number, node):
        """Tells what the program says, and then its end."""
        def pass_on(stream, pipe):
            for line in pipe:
                self.tell({"event": "said", "process": number, "stream": stream, "line": line})
        reader = threading.Thread(target=pass_on, args=("out", node.process.stdout), daemon=True)
        reader.start()
        pass_on("err", node.process.stderr)
        reader.join()
        self.tell({"event": "ended", "process": number, "code": node.process.wait()})

    def tell(self, event):
        try:
            self.say(event)
        except OSError:
            pass  # nobody listens any more; the end of the input says so, too

    def do_signal(self, message):
        node = self.processes[message["process"]]
        if node.process.poll() is None:
            node.process.send_signal(message["number"])

    # the machine
    def do_facts(self, message):
        return {"session": str(self.session), "facts": machine_facts.gather(message["interface"]), "display": "DISPLAY" in os.environ}

    def do_clock(self, _):
        return {"time_s": time.time()}

    def do_steal(self, _):
        return {"share": self.steal.share()}

    def do_claim(self, message):
        """The domain's number on this machine, in place of the one before; given up with the session."""
        if self.claim:
            self.claim.close()
        self.claim = claim_here(message["number"], message["may_join"])
        return {"held": self.claim is not None}

    def do_echo(self, message):
        """Answers datagrams from here on, or no longer."""
        if self.echo:
            self.echo.close()
            self.echo = None
        if message["domain"] is not None:
            self.echo = reach.Echo(message["name"], message["domain"], message["address"])
            return {"ports": self.echo.ports}
        return {}

    def do_probe(self, message):
        return {"heard": reach.probe(message["domain"], message["address"], message["others"])}


def lock(folder):
    """Holds it for as long as the process lives; None where another one does."""
    held = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(held)
        return None
    return held


def forget_keys(sessions):
    """Of sessions whose agent was killed before it could."""
    for keys in sessions.glob("*/keys"):
        held = lock(keys.parent)
        if held is not None:
            shutil.rmtree(keys, ignore_errors=True)
            os.close(held)


def forget(folder, seconds):
    """What lies there unused for so long."""
    for entry in folder.iterdir():
        if time.time() - entry.stat().st_mtime < seconds:
            continue
        if entry.is_dir():
            shutil.rmtree(entry, ignore_errors=True)
        else:
            entry.unlink(missing_ok=True)


def require_own(folder):
    """Programs are started from there that are known by name and size: whoever else writes there would choose them."""
    if folder.stat().st_uid != os.geteuid():
        raise Refusal(f"{folder}: belongs to another user, expected a directory of this one's own")


def begin(source, sink, directory):
    """The agent, or the end of it, with a line that the launcher passes on."""
    os.umask(os.umask(0o022) | 0o022)
    try:
        return Agent(source, sink, pathlib.Path(directory).expanduser().absolute())
    except OSError as error:
        sys.exit(f"{error.filename or directory}: {error.strerror}")
    except (Refusal, RuntimeError) as error:  # RuntimeError: of a user who is not known here
        sys.exit(str(error) if isinstance(error, Refusal) else f"{directory}: {error}")


def main(directory):
    def end(*_):
        # as if the launcher had left: a read that the signal interrupts goes on here. Nothing is raised, which would leave half
        # undone what follows
        os.dup2(os.open(os.devnull, os.O_RDONLY), sys.stdin.fileno())

    signal.signal(signal.SIGTERM, end)
    signal.signal(signal.SIGHUP, end)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the launcher says when it is over
    sink = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # whatever else prints must not speak to the launcher
    begin(sys.stdin.buffer, sink, directory).serve()
