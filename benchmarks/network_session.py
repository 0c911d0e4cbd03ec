"""One session for network_bench: its programs on one machine or on several, which are namespaces here, and bare UDP pings beside them."""
import contextlib
import dataclasses
import json
import pathlib
import signal
import subprocess
import sys
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(REPOSITORY / "tests" / "network"), str(REPOSITORY / "launch_scripts")]
from launcher.domain import Domain  # noqa: E402
import namespaces  # noqa: E402

HOST_OF = {"haptic_node": "theatre", "virtual_device": "theatre", "deform_node": "cluster", "render_node": "gallery"}
ENDING = ("virtual_device", "haptic_node", "deform_node", "render_node")  # the hand lets go first
ENDED_IN_S = 15  # a node that has not ended by then is stopped, and the row fails
SETTLE_S = 4  # the nodes have found each other, and the picture its quality, before the hand comes


@dataclasses.dataclass(frozen=True)
class Way:
    """Between the programs. `hub`: what lossy_hub does to frames; None: one machine, and no network."""
    what: str
    hub: tuple = None
    apart: bool = False  # the device has a machine of its own

    def hosts(self):
        return {**HOST_OF, "virtual_device": "desk"} if self.apart else HOST_OF


@dataclasses.dataclass(frozen=True)
class Ping:
    """As large and as often as what it stands beside; from the device's machine straight to `node`'s and back."""
    node: str
    bytes: int
    back_bytes: int
    rate_hz: int


# Sizes as CDR has them: ToolPose and ToolForce; Contact of a press on 12 nodes, and NodeStatus, which brings the echo
# back; a block of OrganState on a LAN. A tick of the organ and a frame come less often than these two: a percentile
# needs its numbers.
PINGS = {"force": Ping("haptic_node", 152, 108, 1000), "organ": Ping("deform_node", 820, 280, 100),
         "picture": Ping("render_node", 1260, 280, 100)}


class OneMachine:
    """In the place of namespaces.Network."""

    def __init__(self):
        self.addresses = dict.fromkeys([*HOST_OF.values()], "127.0.0.1")

    def within(self, _):
        return []

    def close(self):
        return {}


@contextlib.contextmanager
def place(programs, way):
    """(Where the programs run, the DDS domain, the profile)."""
    if way.hub is None:
        domain = Domain()
        try:
            yield OneMachine(), domain.number, "loopback"
        finally:
            domain.release()
        return
    network = namespaces.Network(programs, *way.hub, hosts=tuple(dict.fromkeys(way.hosts().values())))
    try:
        yield network, 7, "lan"  # nobody else is there
    finally:
        network.close()


class Pings:
    """Beside a session, from start() on."""

    def __init__(self, programs, network, hosts):
        self.programs, self.network, self.hosts, self.echoes, self.running = programs, network, hosts, {}, {}

    def popen(self, host, *options):
        return subprocess.Popen([*self.network.within(host), self.programs / "udp_ping", *map(str, options)], text=True,
                                stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def start(self):
        for name, ping in PINGS.items():
            host = self.hosts[ping.node]
            self.echoes[name] = self.popen(host, "--echo")
            port = self.echoes[name].stdout.readline().strip()
            self.running[name] = self.popen(self.hosts["virtual_device"], "--to", self.network.addresses[host], "--port", port,
                                            "--bytes", ping.bytes, "--back-bytes", ping.back_bytes, "--rate-hz", ping.rate_hz)

    def end(self):
        """What each found, by its name."""
        for process in self.running.values():
            process.stdin.close()
        said = {name: process.stdout.read() for name, process in self.running.items()}
        for process in (*self.running.values(), *self.echoes.values()):
            process.stdin.close()
            process.wait()
            process.stdout.close()
        try:
            return {name: json.loads(text) for name, text in said.items()}
        except json.JSONDecodeError as error:
            raise RuntimeError("udp_ping ended without its figures") from error


def end(nodes):
    """Sends each one home; says who did not go."""
    stuck = []
    for name in ENDING:
        if name not in nodes:
            continue
        nodes[name].send_signal(signal.SIGTERM)
        try:
            nodes[name].wait(ENDED_IN_S)
        except subprocess.TimeoutExpired:
            nodes[name].kill()
            nodes[name].wait()
            stuck.append(name)
    return stuck


def play(programs, scene, way, vendors, seconds, folder, keystore=None):
    """The programs' reports, by their names, and what the pings found while the hand was there (so many seconds). Raises RuntimeError."""
    folder.mkdir(parents=True)
    nodes, pinged = {}, {}
    with place(programs, way) as (network, domain, profile):
        def start(name, *more):
            secure = ["--secure", keystore] if keystore else []
            command = [*network.within(way.hosts()[name]), programs / name, "--scene", scene, "--dds", vendors[name], "--domain", domain,
                       "--profile", profile, "--report", folder / name, *secure, *more]
            with (folder / f"{name}.txt").open("w") as said:
                nodes[name] = subprocess.Popen([*map(str, command)], stdin=subprocess.DEVNULL, stdout=said, stderr=said)

        pings = Pings(programs, network, way.hosts())
        try:
            for name in ("haptic_node", "deform_node"):
                start(name)
            # what draws without a graphics card must leave the processors to the others: here all machines share them
            start("render_node", "--headless", "--out", folder, "--size", "320x200", "--no-panel", "--picture-period-s", 0)
            time.sleep(SETTLE_S)
            start("virtual_device")
            pings.start()
            time.sleep(seconds)
        finally:
            try:
                pinged = pings.end()
            finally:
                stuck = end(nodes)
    failed = [name for name, process in nodes.items() if process.returncode != 0]
    if failed or stuck:
        name = (failed or stuck)[0]
        said = (folder / f"{name}.txt").read_text(errors="replace").strip().splitlines()
        raise RuntimeError(f"{name} ended with code {nodes[name].returncode}: {said[-1] if said else 'it said nothing'}")
    return {name: json.loads((folder / name).read_text(encoding="utf-8")) for name in nodes}, pinged
