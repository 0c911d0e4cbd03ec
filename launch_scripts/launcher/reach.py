"""Whether datagrams of a DDS domain pass between two machines: one answers on the domain's ports, the others ask.

Ports by RTPS 2.2, 9.6.1.1: 7400 + 250 DOMAIN for multicast discovery, from 10 above it two for each participant.
"""
import select
import socket
import threading
import time

GROUP = "239.255.0.1"  # of DDS discovery
MULTICAST = "multicast"  # a way to be reached, beside ports
ASK, ANSWER = b"omentum-echo?", b"omentum-echo!"
ATTEMPTS, ATTEMPT_S = 4, 0.25  # a lossy network may lose a few


def discovery_port(domain):
    return 7400 + 250 * domain


def participant_ports(domain):
    """Of the first participant of a machine."""
    return [discovery_port(domain) + 10, discovery_port(domain) + 11]


def multicast_socket(domain, address):
    """Hears the domain's announcements on the interface that has `address`."""
    heard = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    heard.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    heard.bind((GROUP, discovery_port(domain)))
    heard.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(GROUP) + socket.inet_aton(address))
    return heard


class Echo:
    """Answers who asks, on a thread of its own, until it is closed. `ports`: at which it does, beside multicast: those of the
    domain that nobody else has, and one that the system chose, as Cyclone DDS has it choose."""

    def __init__(self, name, domain, address):
        self.name, self.ports = name, []
        self.sockets = {multicast_socket(domain, address): MULTICAST}
        for port in (*participant_ports(domain), 0):
            unicast = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            try:
                unicast.bind((address, port))
            except OSError:
                unicast.close()
                continue
            self.ports.append(unicast.getsockname()[1])
            self.sockets[unicast] = str(self.ports[-1])
        self.ending = threading.Event()
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        while not self.ending.is_set():
            for ready in select.select(list(self.sockets), [], [], 0.05)[0]:
                asked, sender = ready.recvfrom(2048)
                if asked == ASK:
                    ready.sendto(b" ".join((ANSWER, self.sockets[ready].encode(), self.name.encode())), sender)

    def close(self):
        self.ending.set()
        self.thread.join()
        for one in self.sockets:
            one.close()


def probe(domain, address, others):
    """What each of `others` (name -> [address, ports]) answers to this machine: name -> ways, "multicast" or a port's number."""
    heard = {name: set() for name in others}
    everything = {name: {MULTICAST, *map(str, ports)} for name, (_, ports) in others.items()}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        asking.bind((address, 0))
        asking.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(address))
        for _ in range(ATTEMPTS):
            send_to(asking, (GROUP, discovery_port(domain)))
            for other, ports in others.values():
                for port in ports:
                    send_to(asking, (other, port))
            end = time.monotonic() + ATTEMPT_S
            while (left := end - time.monotonic()) > 0 and heard != everything:
                if select.select([asking], [], [], left)[0]:
                    take(asking, heard)
    return {name: sorted(ways) for name, ways in heard.items()}


def send_to(asking, place):
    try:
        asking.sendto(ASK, place)
    except OSError:
        pass  # no route, or a firewall's own refusal: no answer comes


def take(asking, heard):
    try:
        answer = asking.recv(2048).split(b" ", 2)
    except OSError:
        return  # a port that nobody has said so
    if len(answer) == 3 and answer[0] == ANSWER and answer[2].decode(errors="replace") in heard:
        heard[answer[2].decode()].add(answer[1].decode(errors="replace"))
