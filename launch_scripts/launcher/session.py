"""One run: four processes, of one machine or several, from start to report."""
import contextlib
import os
import pathlib
import tempfile
import time

from . import processes, report, video
from .domain import Domain
from .errors import Refusal
from .hosts import Hosts
from .keys import Keys
from .machine import StealWatch
from .messenger import Messenger
from .telling import tell

POLL_S = 0.1
REFUSAL_WINDOW_S = 10.0  # a node that ends with code 2 within this refused to start
RESTART_PAUSE_S = 1.0
COMMANDS = {"p": "toggle-pause", "r": "reset", "c": "clear-fault", "v": "record"}
PICTURES = ("frame_[0-9][0-9][0-9][0-9].png", "indent.png", "final.png")


def processors_of(split):
    """Cotin's two machines: the hand's on one processor, organ and picture on the other."""
    if split != "paper":
        return {}
    first, second = sorted(os.sched_getaffinity(0))[:2]
    return {"haptic_node": {first}, "virtual_device": {first}, "deform_node": {second}, "render_node": {second}}


class Session:
    """Runs until its time is over, somebody asks, or a node refuses to start."""

    hosts = Hosts()

    def __init__(self, options, scene, name, hosts=hosts):
        self.options, self.scene, self.name, self.hosts = options, scene, name, hosts
        control = hosts.control()
        claim_program = control.file(options.programs / "omentum_domain") if options.profile == "lan" else None
        self.domain = Domain(options.domain, claim_program, hosts.others(), control)
        for line in hosts.advice(self.domain.number, options.profile == "lan"):
            tell(f"run: warning: {line}")
        self.folder = tempfile.TemporaryDirectory(prefix="omentum-")
        self.headless = options.headless
        self.stopping = False
        self.realtime = False
        self.restarts = {}
        if not self.headless and not hosts.of("render_node").has_display():
            self.headless = True
            tell("run: no display: writing pictures instead (--headless)")
        self.nodes = self.make_nodes()
        self.messenger = Messenger(control.file(options.programs / "omentum_session"), [
            "--dds", options.dds["haptic_node"], *self.place(control)], control)

    def stop(self):
        self.stopping = True

    # starting
    def make_nodes(self):
        journal = pathlib.Path(self.folder.name) / "cuts.json"  # ends with the session, outlives its nodes
        own = {"haptic_node": [], "deform_node": ["--journal", self.hosts.of("deform_node").result(journal)],
               "render_node": ["--out", self.hosts.of("render_node").result(self.options.out.resolve())]}
        if self.options.device != "none" and self.hosts.has("virtual_device"):
            own["virtual_device"] = self.device_options()
        if self.options.rate_hz:
            # the loop is stepped by the hand's poses: both keep the rate
            for name in {"haptic_node", "virtual_device"} & own.keys():
                own[name] += ["--rate-hz", f"{self.options.rate_hz:g}"]
        if self.headless:
            own["render_node"].append("--headless")
        if self.options.pairs:
            own["render_node"].append("--pairs")
        if self.options.map:
            own["render_node"] += ["--map", self.options.map]
        for option, value in (("--record", self.options.record), ("--ui-scale", self.options.ui_scale)):
            if value:
                own["render_node"] += [option, f"{value:g}"]
        processors = processors_of(self.options.split)
        return [processes.Node(name, self.command(name) + extra + self.hosts.options_of(name), self.report_file(name),
                               processors.get(name), self.hosts.of(name))
                for name, extra in own.items()]

    def device_options(self):
        host = self.hosts.of("virtual_device")
        frames = ["--frames", host.file(self.options.frames)] if self.options.frames else []
        if self.options.trace:
            return ["--trace", host.file(self.options.trace), *frames]
        return (["--mouse"] if self.options.device == "mouse" else []) + frames

    def command(self, name):
        host = self.hosts.of(name)
        command = [host.file(self.options.programs / name), "--scene", host.file(self.scene), "--dds", self.options.dds[name],
                   *self.place(host), "--report", host.result(self.report_file(name))]
        if self.options.log:
            command += ["--log", host.result(self.options.out.resolve() / f"{name}.csv")]
        return command

    def place(self, host):
        """Where programs meet, as options of each of them."""
        keys = ["--secure", host.file(self.options.keystore)] if self.options.keystore else []
        return ["--domain", str(self.domain.number), "--profile", self.options.profile, *keys]

    def report_file(self, name):
        return pathlib.Path(self.folder.name) / f"{name}.json"

    def clear_out(self):
        """What an earlier session wrote is not this one's."""
        for pattern in (*PICTURES, "report.json"):
            for file in self.options.out.glob(pattern):
                file.unlink()
        video.clear(self.options.out)

    def announce(self):
        vendors = sorted(set(self.options.dds[node.name] for node in self.nodes))
        secured = ", secured" if self.options.keystore else ""
        tell(f"run: {self.name}; DDS domain {self.domain.number}, {' and '.join(vendors)}{secured}")
        for line in self.hosts.said():
            tell(f"run: {line}")
        if self.options.split:
            sides = {}
            for node in self.nodes:
                sides.setdefault(min(node.processors), []).append(node.name)
            said = "; ".join(f"processor {cpu}: {', '.join(names)}" for cpu, names in sides.items())
            tell(f"run: split as in the paper: {said}")

    # running
    def run(self):
        """The exit code: 0; 1 when a node crashed or no answer ever came; 2 when one refused to start, which then said why."""
        self.announce()
        self.clear_out()
        begin, steal = time.monotonic(), StealWatch()
        with Keys() as keys:
            try:
                self.start()
                code = self.watch(keys, begin)
            finally:
                seconds, steal_share = time.monotonic() - begin, steal.share()
                processes.stop_all(self.nodes)
                self.messenger.stop()
                self.domain.release()
                machines = self.hosts.figures()
                self.hosts.gather()
        if code == processes.REFUSED:
            self.clear_out()  # a picture of a session that never was
        else:
            code = self.finish(seconds, steal_share, machines)
        self.folder.cleanup()
        return code or (1 if any(node.failed() for node in self.nodes) else 0)

    def start(self):
        """Paused, the hand comes last, when the force is known to be off; it is then told to stand still itself."""
        if not self.options.paused:
            processes.start_all(self.nodes)
            return
        others = [node for node in self.nodes if node.name != "virtual_device"]
        processes.start_all(others)
        hands = [node for node in self.nodes if node not in others]

        def start_hands():
            processes.start_all(hands)
            self.messenger.send("pause", len(self.nodes), quiet=True)

        self.messenger.send("pause", len(others), start_hands if hands else None)

    def watch(self, keys, begin):
        while not self.stopping and any(node.running() for node in self.nodes):
            self.obey(keys.wait(POLL_S))
            self.messenger.poll()
            elapsed = time.monotonic() - begin
            for node in self.nodes:
                if not node.ended_now():
                    continue
                if self.ended(node, elapsed) == processes.REFUSED:
                    return processes.REFUSED
            self.restart_due()
            self.look_at_realtime()
            if self.options.seconds and elapsed >= self.options.seconds:
                break
        return 0

    def ended(self, node, elapsed):
        """Somebody may have ended a node on purpose; the others go on in any case. Returns 2 for a refusal."""
        if node.exit == processes.REFUSED and node.starts == 1 and elapsed < REFUSAL_WINDOW_S:
            return processes.REFUSED
        with contextlib.suppress(Refusal):  # a machine that is lost
            node.host.fetch(node.report)
        if node.name == "render_node" and report.read_node(node.report, node.name).get("closed"):
            tell("run: the window was closed")
            self.stop()
            return 0
        tell(f"run: {node.name} {node.how_it_ended()}; the others go on")
        if node.exit == processes.MACHINE_LACKS:
            return 0  # its own line says what; trying again would not help
        if self.options.restart and node.exit not in (0, processes.REFUSED):
            self.restarts[node.name] = time.monotonic() + RESTART_PAUSE_S
        else:
            tell(f"run: to start it again: {node.command_line()}")
        return 0

    def restart_due(self):
        for node in self.nodes:
            if self.restarts.get(node.name, float("inf")) <= time.monotonic():
                del self.restarts[node.name]
                tell(f"run: starting {node.name} again")
                node.start()

    def look_at_realtime(self):
        haptic = self.nodes[0]
        self.realtime = self.realtime or haptic.realtime()

    # keys
    def obey(self, key):
        if key == "q":
            self.stop()
        elif key in COMMANDS:
            self.send(COMMANDS[key])

    def send(self, command):
        self.messenger.send(command, sum(node.running() for node in self.nodes))

    # the end
    def finish(self, seconds, steal_share, machines):
        """1 when hand and node never met, else 0. `machines`: of a table of hosts, as the report has them."""
        machine = {"steal_share": round(steal_share, 5)}
        if machines:  # the one that the hand is at
            machine = {key: machines[self.hosts.control().name][key] for key in ("cores", "kernel", "steal_share")}
        merged = report.merge(self.name, seconds, {**machine, "realtime": self.realtime}, self.nodes, self.options.dds)
        if machines:
            merged["hosts"] = machines
        videos = merged["nodes"].get("render_node", {}).get("videos", [])
        for one in videos:
            one["folder"] = self.hosts.of("render_node").home(one["folder"])
        report.write(merged, self.options.out / "report.json")
        tell(report.summary(merged))
        tell(f"run: {self.options.out / 'report.json'}")
        video.make_all(videos)
        return 1 if report.never_answered(merged) else 0
