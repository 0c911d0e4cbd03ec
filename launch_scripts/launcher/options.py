"""The command line of launch_scripts/run."""
import argparse
import os
import pathlib
import tomllib
from dataclasses import dataclass, field

from . import host_table, keystore
from .errors import Refusal

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
DEFAULT_SCENE = REPOSITORY / "scenes" / "liver.toml"
OWN_KEYSTORE = REPOSITORY / "build" / "keystore"
VENDORS = ("fast", "cyclone")
# short name on the command line -> process
NODES = {"haptic": "haptic_node", "deform": "deform_node", "render": "render_node", "device": "virtual_device"}
# beyond 100 a domain's ports lie among those that Linux gives to any program
FIRST_DOMAIN, LAST_FREE_DOMAIN, LAST_DOMAIN = 1, 100, 230


@dataclass
class Options:
    scene: pathlib.Path = DEFAULT_SCENE
    seconds: float = None
    out: pathlib.Path = pathlib.Path("out")
    dds: dict = field(default_factory=dict)  # process -> vendor
    device: str = "virtual"  # virtual, mouse, none or trace
    trace: pathlib.Path = None
    frames: pathlib.Path = None  # how the devices stand in the scene
    organ: pathlib.Path = None
    scale: float = None
    fixed: str = None
    rate_hz: float = None
    headless: bool = False
    domain: int = None
    log: bool = False
    profile: str = "loopback"
    keystore: pathlib.Path = None  # of a secured session
    hosts: host_table.HostTable = None  # None: all on this machine
    split: str = None
    map: str = None
    pairs: bool = False
    record: float = None  # pictures of a second of video
    ui_scale: float = None
    paused: bool = False
    restart: bool = False
    programs: pathlib.Path = None
    check_only: bool = False
    prepare_only: bool = False


class OneLineParser(argparse.ArgumentParser):
    def error(self, message):
        raise Refusal(f"{message} (see launch_scripts/run --help)")


class ListScenes(argparse.Action):
    """Says what there is, a line each, and ends."""

    def __call__(self, parser, *_):
        for file in sorted((REPOSITORY / "scenes").glob("*.toml")):
            print(f"{file.stem:16}{tomllib.loads(file.read_text(encoding='utf-8'))['name']}")
        parser.exit()


def build_parser():
    parser = OneLineParser(
        prog="launch_scripts/run",
        description="Starts a session: haptic_node, deform_node, render_node and a simulated hand on this machine. "
        "In a terminal: p pauses, r resets, c clears a latched fault, v records a video or ends it, q ends.",
        epilog="Environment: OMENTUM_CACHE=FOLDER keeps the precomputed organs (default: build/cache). OMENTUM_BIN=FOLDER has "
        "the built programs (default: build/release/bin, built when needed).")
    add = parser.add_argument
    add("scene", nargs="?", metavar="SCENE", help="scene file or name of a file in scenes/ (default: liver)")
    add("--list", nargs=0, action=ListScenes, help="say which scenes there are, and end")
    add("--seconds", type=float, metavar="N", help="end after N seconds (default: when told to)")
    add("--out", metavar="DIR", default="out", help="report.json and pictures go here (default: out)")
    add("--dds", default="fast", metavar="VENDOR",
        help="fast, cyclone, or haptic=fast,deform=cyclone,render=fast,device=cyclone")
    add("--device", default="virtual", metavar="KIND", help="virtual, mouse, none or trace:FILE (default: virtual). "
        "mouse: the pointer in the window moves the first instrument, key Tab picks the next one (docs/devices.md)")
    add("--frames", metavar="FILE", help="how devices stand in the scene: axes, scale, clutch, handle (docs/devices.md)")
    add("--organ", metavar="FILE", help="your own organ (.h5) or mesh (.msh .vtk .vtu .node) instead of the scene's first one")
    add("--scale", type=float, metavar="METRES_PER_UNIT", help="of that mesh (default: found from its size)")
    add("--fixed", metavar="SPEC", help="supports of that mesh, as organ_build takes them "
        "(a CSV has the mesh file's own node numbers)")
    add("--rate-hz", type=float, metavar="HZ", help="rate of the haptic loop (default: 1000)")
    add("--headless", action="store_true", help="write pictures instead of opening a window")
    add("--domain", type=int, metavar="N", help="DDS domain, 0..230 (default: a free one)")
    add("--profile", default="loopback", choices=("loopback", "lan"), help="QoS for one machine or for a network")
    add("--hosts", metavar="HOSTS.toml", help="run the nodes on the machines of this table (docs/machines.md), with --profile lan")
    add("--log", action="store_true", help="also write every loop's samples to DIR/PROCESS.csv")
    add("--split", choices=("paper",), help="paper: hand and haptic_node on one processor, organ and picture on the "
        "other, as Cotin 1999 did with two machines")
    add("--map", choices=("strain", "stress"), help="draw organs as a map of it (default: as tissue; key S switches)")
    add("--pairs", action="store_true", help="mark parts of organs that touch (key T switches)")
    add("--record", type=float, nargs="?", const=25.0, metavar="FPS", help="record a video from the start: numbered pictures in "
        "DIR/video, and DIR/video.mp4 where ffmpeg is installed (default: 25 pictures a second; in the window key V)")
    add("--ui-scale", type=float, metavar="SCALE", help="of the window's panel, 0.5 to 4 (default: as monitor and window ask for)")
    add("--paused", action="store_true", help="start paused")
    add("--restart", action="store_true", help="start a node again when it crashed")
    add("--secure", action="store_true", help="encrypted topics, and only who has keys joins (docs/security.md)")
    add("--keystore", metavar="KEYSTORE", help="of launch_scripts/make_keystore, for --secure (default: build/keystore, made "
        "when it is not there)")
    add("--prepare", action="store_true", help="make the organ file and DIR/scene.toml, and end")
    add("--check", action="store_true", help=argparse.SUPPRESS)
    return parser


def parse(arguments):
    """Raises Refusal."""
    given = build_parser().parse_args(arguments)
    options = Options(
        scene=find_scene(given.scene), seconds=given.seconds, out=pathlib.Path(given.out), dds=parse_dds(given.dds),
        scale=given.scale, fixed=given.fixed, rate_hz=given.rate_hz, headless=given.headless, domain=given.domain,
        log=given.log, profile=given.profile, split=given.split, map=given.map, pairs=given.pairs, record=given.record,
        ui_scale=given.ui_scale, paused=given.paused, restart=given.restart,
        check_only=given.check, prepare_only=given.prepare)
    options.device, options.trace = parse_device(given.device)
    options.frames = existing(given.frames, "--frames") if given.frames else None
    options.keystore = parse_keystore(given.secure, given.keystore)
    if given.hosts:
        options.hosts, options.profile = host_table.read(given.hosts), "lan"
        name_vendors(options)
    options.organ = existing(given.organ, "--organ") if given.organ else None
    options.programs = programs_folder()
    check_values(options)
    return options


def programs_folder():
    """Where the programs are."""
    return pathlib.Path(os.environ.get("OMENTUM_BIN") or REPOSITORY / "build" / "release" / "bin")


def find_scene(given):
    if given is None:
        return DEFAULT_SCENE
    named = REPOSITORY / "scenes" / f"{given}.toml"
    if pathlib.PurePath(given).name == given and named.is_file() and not pathlib.Path(given).exists():
        return named
    return existing(given, "SCENE")


def existing(given, what):
    path = pathlib.Path(given)
    if not path.is_file():
        raise Refusal(f"{what}: {given}: no such file")
    return path.resolve()


def parse_keystore(secure, given):
    """None: unsecured. One that is named is there already: a wrong name must not end in new keys that nobody else has."""
    if given and not secure:
        raise Refusal("--keystore is for --secure, which is missing")
    if given and not pathlib.Path(given).is_dir():
        raise Refusal(f"--keystore: {given}: no such folder; launch_scripts/make_keystore {given} makes it")
    if given and not keystore.is_current(given):
        raise Refusal(f"--keystore: {given}: was made for other topics than the programs have now; make a new one with "
                      "launch_scripts/make_keystore")
    return pathlib.Path(given).resolve() if given else OWN_KEYSTORE if secure else None


def parse_dds(text):
    """One vendor for all, or node=vendor pairs; whatever is not named runs Fast DDS."""
    if "=" not in text:
        check_vendor(text)
        return {process: text for process in NODES.values()}
    chosen = {process: "fast" for process in NODES.values()}
    for pair in text.split(","):
        node, _, vendor = pair.partition("=")
        if node not in NODES:
            raise Refusal(f"--dds: unknown node '{node}', expected {', '.join(NODES)}")
        check_vendor(vendor)
        chosen[NODES[node]] = vendor
    return chosen


def check_vendor(vendor):
    if vendor not in VENDORS:
        raise Refusal(f"--dds: unknown vendor '{vendor}', expected {' or '.join(VENDORS)}")


def name_vendors(options):
    """A table of hosts may name them, node by node."""
    for host in options.hosts.hosts:
        options.dds.update({name: node.dds for name, node in host.nodes.items() if node.dds})


def parse_device(text):
    kind, _, file = text.partition(":")
    if kind == "trace" and file:
        return "trace", existing(file, "--device trace")
    if text in ("virtual", "mouse", "none"):
        return text, None
    raise Refusal(f"--device: found '{text}', expected virtual, mouse, none or trace:FILE")


def has_display():
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def check_values(options):
    if options.device == "mouse" and options.frames:
        raise Refusal("--frames: a mouse has no frames: its tip is where the pointer is, and it has a clutch by nature; expected another "
                      "--device, or none of both")
    if options.device == "mouse" and options.headless:
        raise Refusal("--device mouse needs a window to point at; run it without --headless")
    if options.device == "mouse" and not has_display() and not options.hosts and not options.prepare_only:
        raise Refusal("--device mouse needs a display, and neither DISPLAY nor WAYLAND_DISPLAY is set")
    if options.seconds is not None and not options.seconds > 0:
        raise Refusal(f"--seconds: found {options.seconds:g}, expected more than 0")
    if options.scale is not None and not options.scale > 0:
        raise Refusal(f"--scale: found {options.scale:g}, expected more than 0")
    if options.rate_hz is not None and not 50 <= options.rate_hz <= 10000:
        raise Refusal(f"--rate-hz: found {options.rate_hz:g}, expected 50 to 10000")
    if options.domain is not None and not 0 <= options.domain <= LAST_DOMAIN:
        raise Refusal(f"--domain: found {options.domain}, expected 0 to {LAST_DOMAIN}")
    if options.record is not None and not 1 <= options.record <= 120:
        raise Refusal(f"--record: found {options.record:g}, expected 1 to 120 pictures a second")
    if options.ui_scale is not None and not 0.5 <= options.ui_scale <= 4:
        raise Refusal(f"--ui-scale: found {options.ui_scale:g}, expected 0.5 to 4")
    if (options.scale or options.fixed) and not options.organ:
        raise Refusal("--scale and --fixed describe the mesh of --organ, which is missing")
    if options.split and options.hosts:
        raise Refusal("--split shares out one machine's processors; --hosts has several machines")
    if options.split and len(os.sched_getaffinity(0)) < 2:
        raise Refusal("--split paper needs two processors, found one")
