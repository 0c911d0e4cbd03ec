"""A DDS domain that no other session uses, on this machine and, where the session speaks to a network, there."""
import pathlib
import re
import socket

from .errors import Refusal
from .host import Here
from .network_claim import NetworkClaim
from .options import FIRST_DOMAIN, LAST_FREE_DOMAIN
from .telling import tell

UDP = pathlib.Path("/proc/net/udp")


def has_participant(number, listing=UDP):
    """Whether a program of this machine is in the domain, whoever made or started it: each has the port on which the
    domain's announcements come."""
    port = 7400 + 250 * number
    try:
        return re.search(rf"^ *\d+: [0-9A-F]+:{port:04X} ", listing.read_text(encoding="ascii"), re.MULTILINE) is not None
    except OSError:
        return False


def claim_here(number, may_join=False):
    """A socket that holds the domain's number for the launchers of this machine; None when it is in use here and must
    not be joined. An abstract socket leaves nothing behind."""
    held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        held.bind(f"\0omentum-domain-{number}")
    except OSError:
        if not may_join:
            held.close()
            return None
    if not may_join and has_participant(number):
        held.close()
        return None
    return held


class Domain:
    """Holds a domain's number for as long as the process lives: on each machine of the session, and
    on a network by a process that tells other launchers."""

    def __init__(self, wanted=None, claim_program=None, hosts=(), host=Here()):
        """claim_program: omentum_domain, for a session on a network, which runs on `host`; `hosts`: the other machines."""
        self.socket, self.program, self.network, self.hosts, self.host = None, claim_program, None, hosts, host
        if wanted is not None:
            # taken already: a person who names a domain may well want to join another session
            self.claim(wanted, may_join=True)
            self.number = wanted
            if claim_program:
                self.claim_on_network(wanted)
            return
        for number in range(FIRST_DOMAIN, LAST_FREE_DOMAIN + 1):
            if self.claim(number) and (not claim_program or self.claim_on_network(number)):
                self.number = number
                return
        raise Refusal(f"all DDS domains from {FIRST_DOMAIN} to {LAST_FREE_DOMAIN} are in use; --domain N takes one anyway")

    def claim(self, number, may_join=False):
        """Whether nobody else on these machines had it."""
        held = claim_here(number, may_join)
        if held is None:
            return False
        if self.socket:
            self.socket.close()  # of a number that was in use on the network
        self.socket = held
        return all(host.claim(number, may_join) for host in self.hosts)

    def claim_on_network(self, number):
        """Whether nobody else on the network had it; says who has."""
        self.network = NetworkClaim(self.program, number, self.host)
        if self.network.rival:
            tell(f"run: DDS domain {number} is {self.network.rival}")
        return not self.network.rival

    def release(self):
        """Lets others have it: after the session's last process ended."""
        if self.network:
            self.network.end()
        if self.socket:
            self.socket.close()
