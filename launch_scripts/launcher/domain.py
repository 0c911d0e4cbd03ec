"""A DDS domain that no other session on this machine uses."""
import socket

from .errors import Refusal
from .options import FIRST_DOMAIN, LAST_FREE_DOMAIN


class Domain:
    """Holds a domain's number for as long as the process lives: an abstract socket, which leaves nothing behind."""

    def __init__(self, wanted=None):
        self.socket = None
        if wanted is not None:
            # taken already: a person who names a domain may well want to join another session
            self.claim(wanted)
            self.number = wanted
            return
        for number in range(FIRST_DOMAIN, LAST_FREE_DOMAIN + 1):
            if self.claim(number):
                self.number = number
                return
        raise Refusal(f"all DDS domains from {FIRST_DOMAIN} to {LAST_FREE_DOMAIN} are in use; --domain N takes one anyway")

    def claim(self, number):
        """Whether nobody else had it."""
        held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            held.bind(f"\0omentum-domain-{number}")
        except OSError:
            held.close()
            return False
        self.socket = held
        return True
