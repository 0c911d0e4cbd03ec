"""A DDS domain that no other session on this machine uses."""
import socket

from .errors import Refusal
from .options import FIRST_DOMAIN, LAST_FREE_DOMAIN


class Domain:
    """Holds a domain's number for as long as the process lives: an abstract socket, which leaves nothing behind."""

    def __init__(self, wanted=None):
        self.socket = None
        if wanted is not None:
            self.number = wanted  # asked for by a person, who may well want to join another session
            return
        for number in range(FIRST_DOMAIN, LAST_FREE_DOMAIN + 1):
            held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
            try:
                held.bind(f"\0omentum-domain-{number}")
            except OSError:
                held.close()
                continue
            self.socket, self.number = held, number
            return
        raise Refusal(f"all DDS domains from {FIRST_DOMAIN} to {LAST_FREE_DOMAIN} are in use; --domain N takes one anyway")
