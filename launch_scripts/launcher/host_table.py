"""HOSTS.toml: the machines of a session, how the launcher gets there, and which nodes run on which (docs/machines.md)."""
import ipaddress
import pathlib
import re
import tomllib
from dataclasses import dataclass, field

from .errors import Refusal

NODES = ("haptic_node", "deform_node", "render_node", "virtual_device")
NEEDED = NODES[:3]
VENDORS = ("fast", "cyclone")
# a network that is gone for a minute is taken for gone
SSH_OPTIONS = ("-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "-o", "ServerAliveInterval=15", "-o", "ServerAliveCountMax=4")
DIRECTORY = "~/.cache/omentum"
OURS = ("--scene", "--dds", "--domain", "--profile", "--secure", "--report", "--log", "--out", "--journal", "--headless")


@dataclass
class NodeSpec:
    dds: str = None  # None: as --dds says
    options: list = field(default_factory=list)


@dataclass
class HostSpec:
    """A machine of the table."""
    name: str
    address: str
    user: str = None
    directory: str = DIRECTORY
    here: bool = False
    reach: list = None  # in place of ssh
    interface: str = None
    peers: list = None
    environment: dict = field(default_factory=dict)
    nodes: dict = field(default_factory=dict)  # process -> NodeSpec

    def way_there(self):
        """The words that run a line of shell there. No question is ever asked: nobody could answer it."""
        if self.reach:
            return self.reach
        return ["ssh", *SSH_OPTIONS, *(["-l", self.user] if self.user else []), self.address]


@dataclass
class HostTable:
    file: pathlib.Path
    multicast: bool
    hosts: list

    def spec_of(self, node):
        """The machine that has the node, or None."""
        return next((host for host in self.hosts if node in host.nodes), None)

    def peers_of(self, host):
        """The addresses that it is told beside the multicast group. Its own, too: two of its programs meet by them, or by
        multicast."""
        if host.peers is not None or self.multicast:
            return host.peers or []
        return [one.address for one in self.hosts]


class Section:
    """A table of the file, whose keys are taken one by one; what nobody takes is no key."""

    def __init__(self, file, place, values):
        self.file, self.place = file, place
        if not isinstance(values, dict):
            raise self.refusal("", f"found {shown(values)}, expected a table")
        self.left = dict(values)

    def refusal(self, key, what):
        return Refusal(f"{self.file}: {'.'.join(filter(None, (self.place, key)))}: {what}")

    def take(self, key, fits, expected, default=None, required=False):
        if key not in self.left:
            if required:
                raise self.refusal(key, f"missing, expected {expected}")
            return default
        value = self.left.pop(key)
        if not fits(value):
            raise self.refusal(key, f"found {shown(value)}, expected {expected}")
        return value

    def end(self, known):
        for key in self.left:
            raise self.refusal(key, f"unknown, expected {', '.join(known)}")


def shown(value):
    return f"'{value}'" if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)


def is_text(value):
    return isinstance(value, str) and bool(value) and "\0" not in value


def is_flag(value):
    return isinstance(value, bool)


def is_name(value):
    return isinstance(value, str) and re.fullmatch(r"[A-Za-z0-9][\w.-]{0,31}", value) is not None


def is_address(value):
    try:
        address = ipaddress.IPv4Address(value if isinstance(value, str) else "")
        return not (address.is_unspecified or address.is_multicast or address.is_reserved)
    except ValueError:
        return False


def are_addresses(value):
    return isinstance(value, list) and all(map(is_address, value))


def are_words(value):
    return isinstance(value, list) and all(map(is_text, value))


def are_variables(value):
    return isinstance(value, dict) and all(is_text(name) and "=" not in name and isinstance(text, str) and "\0" not in text
                                           for name, text in value.items())


def read_node(section):
    node = NodeSpec(section.take("dds", lambda value: value in VENDORS, " or ".join(VENDORS)),
                    section.take("options", are_words, "a list of words", default=[]))
    for word in node.options:
        if word.partition("=")[0] in OURS:
            raise section.refusal("options", f"found {word}, which the launcher gives itself")
    section.end(("dds", "options"))
    return node


def read_host(section):
    host = HostSpec(
        name=section.take("name", is_name, "a name of letters, digits, _ . and -, at most 32", required=True),
        address=section.take("address", is_address, "an IPv4 address, at which the other machines reach it", required=True),
        user=section.take("user", is_name, "a user's name"),
        directory=section.take("directory", is_text, "a folder there", default=DIRECTORY),
        here=section.take("here", is_flag, "true or false", default=False),
        reach=section.take("reach", lambda value: are_words(value) and value, "a list of words, a command that runs a line of shell there"),
        interface=section.take("interface", is_text, "the name or address of a network interface"),
        peers=section.take("peers", are_addresses, "a list of IPv4 addresses"),
        environment=section.take("environment", are_variables, "a table of texts, and names without =", default={}))
    for key, given in (("user", host.user), ("reach", host.reach)):
        if host.here and given:
            raise section.refusal(key, "the launcher's own machine (here = true) has none")
    nodes = section.take("nodes", lambda value: isinstance(value, dict), f"tables of {', '.join(NODES)}", default={})
    for name, values in nodes.items():
        if name not in NODES:
            raise section.refusal(f"nodes.{name}", f"unknown, expected {', '.join(NODES)}")
        host.nodes[name] = read_node(Section(section.file, f"{section.place}.nodes.{name}", values))
    section.end([name for name in HostSpec.__dataclass_fields__])
    return host


def check_together(file, hosts):
    def twice(key, values):
        for number, value in enumerate(values):
            if value in values[:number]:
                raise Refusal(f"{file}: hosts[{number}].{key}: found '{value}' again, expected another one for each host")

    twice("name", [host.name for host in hosts])
    twice("address", [host.address for host in hosts])
    for node in NODES:
        having = [number for number, host in enumerate(hosts) if node in host.nodes]
        if len(having) > 1:
            raise Refusal(f"{file}: hosts[{having[1]}].nodes.{node}: hosts[{having[0]}] has it already, expected one machine for it")
        if not having and node in NEEDED:
            raise Refusal(f"{file}: hosts: no machine has {node}, expected [hosts.nodes.{node}] in one of them")
    here = [number for number, host in enumerate(hosts) if host.here]
    if len(here) > 1:
        raise Refusal(f"{file}: hosts[{here[1]}].here: hosts[{here[0]}] is the launcher's own machine already")


def read(file):
    """Raises Refusal: "FILE: hosts[1].address: found ..., expected ..."."""
    file = pathlib.Path(file)
    try:
        content = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise Refusal(f"{file}: {error.strerror}") from error
    except ValueError as error:  # of TOML, or of letters
        raise Refusal(f"{file}: {error}") from error
    root = Section(file, "", content)
    multicast = root.take("multicast", is_flag, "true or false", default=True)
    tables = root.take("hosts", lambda value: isinstance(value, list) and value, "[[hosts]], a table for each machine", required=True)
    root.end(("multicast", "hosts"))
    hosts = [read_host(Section(file, f"hosts[{number}]", values)) for number, values in enumerate(tables)]
    check_together(file, hosts)
    return HostTable(file, multicast, hosts)
