"""A DDS domain that no other session uses, on this machine and, where the session speaks to a network, there."""
import socket

from .errors import Refusal
from .network_claim import NetworkClaim
from .options import FIRST_DOMAIN, LAST_FREE_DOMAIN


class Domain:
    """Holds a domain's number for as long as the process lives: an abstract socket, which leaves nothing behind, and on
    a network a process that tells other launchers."""

    def __init__(self, wanted=None, claim_program=None):
        """claim_program: omentum_domain, for a session on a network."""
        self.socket, self.program, self.network = None, claim_program, None
        if wanted is not None:
            # taken already: a person who names a domain may well want to join another session
            self.claim(wanted)
            self.number = wanted
            if claim_program:
                self.claim_on_network(wanted)
            return
        for number in range(FIRST_DOMAIN, LAST_FREE_DOMAIN + 1):
            if self.claim(number) and (not claim_program or self.claim_on_network(number)):
                self.number = number
                return
        raise Refusal(f"all DDS domains from {FIRST_DOMAIN} to {LAST_FREE_DOMAIN} are in use; --domain N takes one anyway")

    def claim(self, number):
        """Whether nobody else on this machine had it."""
        held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            held.bind(f"\0omentum-domain-{number}")
        except OSError:
            held.close()
            return False
        if self.socket:
            self.socket.close()  # of a number that was in use on the network
        self.socket = held
        return True

    def claim_on_network(self, number):
        """Whether nobody else on the network had it; says who has."""
        self.network = NetworkClaim(self.program, number)
        if self.network.rival:
            print(f"run: DDS domain {number} is {self.network.rival}", flush=True)
        return not self.network.rival

    def release(self):
        """Lets others have it: after the session's last process ended."""
        if self.network:
            self.network.end()
        if self.socket:
            self.socket.close()
