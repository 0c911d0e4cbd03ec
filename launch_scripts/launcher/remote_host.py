"""A machine of a session that the launcher reaches by ssh: the same as host.Here, over a link to an agent there."""
import hashlib
import json
import os
import pathlib
import time

from .errors import Refusal
from .host import Here
from .link import Link
from .remote_process import RemoteProcess
from .telling import tell

PATIENCE_S = 2.0  # anything longer gets a line
READ_BYTES = 1 << 20


def digest_of(file):
    """SHA-256 of a file's content."""
    total = hashlib.sha256()
    with open(file, "rb") as content:
        while part := content.read(READ_BYTES):
            total.update(part)
    return total.hexdigest()


class Told:
    """A file that is read to be sent; says now and then how far it is."""

    def __init__(self, file, size, where):
        self.file, self.size, self.where, self.read_bytes, self.said = file, size, where, 0, time.monotonic()

    def __enter__(self):
        self.stream = open(self.file, "rb")
        return self

    def __exit__(self, *_):
        self.stream.close()

    def read(self, count):
        part = self.stream.read(count)
        self.read_bytes += len(part)
        if time.monotonic() - self.said > PATIENCE_S:
            self.said = time.monotonic()
            name = os.path.basename(self.file)
            tell(f"run: bringing {name} to {self.where}: {self.read_bytes / 1e6:.0f} of {self.size / 1e6:.0f} MB")
        return part


class Elsewhere(Here):
    """`spec`: of the table of hosts. Raises Refusal, as everything here does once the machine cannot be reached; meet() comes first."""

    def __init__(self, spec, environment):
        super().__init__(environment)
        self.name, self.spec = spec.name, spec
        self.files, self.results = {}, {}  # a path here -> its path there
        self.link = Link(spec.name, spec.way_there(), spec.directory)

    def meet(self):
        """Waits until the agent is there and says what machine it is on."""
        try:
            answer = self.link.ask("facts", interface=self.spec.interface)
            begin = time.time()
            there = self.link.ask("clock")["time_s"]
        except BaseException:
            self.link.close()
            raise
        self.round_trip_s = time.time() - begin
        self.session, self.facts, self.display = pathlib.PurePosixPath(answer["session"]), answer["facts"], answer["display"]
        self.clock_apart_s = there - (begin + self.round_trip_s / 2)

    # files
    def bring(self, files):
        """Files there by their hash, where they are not yet: a list of (path here, name in the session)."""
        known = [(file, name, digest_of(file), os.path.getsize(file)) for file, name in files]
        lacks = set(self.link.ask("have", files={digest: size for _, _, digest, size in known})["lacks"])
        begin, sent = time.monotonic(), 0
        for file, name, digest, size in known:
            if digest in lacks:
                mode = 0o755 if os.access(file, os.X_OK) else 0o644
                with Told(file, size, self.name) as content:
                    self.link.ask("put", content, digest=digest, mode=mode, bytes=size)
                lacks.discard(digest)
                sent += size
            self.link.ask("link", name=name, digest=digest)
            self.files[str(file)] = str(self.session / name)
        if time.monotonic() - begin > PATIENCE_S:
            tell(f"run: {self.name} has what it needs: {sent / 1e6:.0f} MB brought there in {time.monotonic() - begin:.1f} s")

    def put(self, content, name, mode=0o600):
        """Bytes of this session alone."""
        self.link.ask("put", content, name=name, mode=mode)

    def file(self, path):
        return self.files.get(str(path), str(path))

    def result(self, path):
        if str(path) not in self.results:
            # a folder each: two results may have one name
            place = pathlib.PurePosixPath("results", str(len(self.results)), pathlib.Path(path).name)
            self.link.ask("folder", name=str(place if pathlib.Path(path).is_dir() else place.parent))
            self.results[str(path)] = str(self.session / place)
        return self.results[str(path)]

    def home(self, there):
        for here, place in self.results.items():
            if pathlib.PurePosixPath(there).is_relative_to(place):
                return str(pathlib.Path(here) / pathlib.PurePosixPath(there).relative_to(place))
        return there

    def fetch(self, here):
        """What there is by now of one result."""
        place = str(pathlib.PurePosixPath(self.results[str(here)]).relative_to(self.session))
        for name in self.link.ask("list", name=place)["files"]:
            target = pathlib.Path(here) / self.below(place, name)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(b"".join(self.link.ask("get", name=name)["content"]))

    def below(self, place, name):
        """What `name` is called within `place`: a machine that lies must not write elsewhere here."""
        named = pathlib.PurePosixPath(name)
        if not named.is_relative_to(place) or ".." in named.parts:
            raise Refusal(f"{self.name}: {name}: found in place of a file of {place}")
        return named.relative_to(place)

    def gather(self):
        for here in self.results:
            self.fetch(here)

    # programs
    def popen(self, command, processors=None, captured=False, results=()):
        process = RemoteProcess(self.link, next(self.link.numbers), command, captured)
        self.link.started[process.number] = process
        self.link.ask("start", process=process.number, name=pathlib.PurePosixPath(command[0]).name, command=command,
                      processors=sorted(processors or ()), captured=captured, environment=self.environment,
                      report=next((self.results[str(file)] for file in results if str(file) in self.results), None))
        return process

    def realtime(self, process):
        return process.is_realtime

    def steal_share(self):
        return self.link.ask("steal")["share"]

    def has_display(self):
        return self.display or "DISPLAY" in self.environment

    # the network
    def echo_on(self, domain):
        return self.link.ask("echo", domain=domain, name=self.name, address=self.spec.address)["ports"]

    def echo_off(self):
        self.link.ask("echo", domain=None)

    def probe(self, domain, others):
        return self.link.ask("probe", domain=domain, address=self.spec.address, others=others)["heard"]

    def claim(self, number, may_join):
        """Whether no other session of that machine has the domain."""
        return self.link.ask("claim", number=number, may_join=may_join)["held"]

    # the end
    def forget(self):
        """What the session has there beside the kept files: after gather()."""
        self.link.tell("forget")

    def abandon(self):
        self.link.process.terminate()

    def close(self):
        self.link.close()


def rewritten(text, places):
    """A prepared scene's text with other paths in it; `places`: old -> new. Longer ones first: one may begin another."""
    for old in sorted(places, key=len, reverse=True):
        for quoted in (json.dumps(old, ensure_ascii=False), f"'{old}'"):
            text = text.replace(quoted, json.dumps(places[old], ensure_ascii=False))
    return text
