"""Machines of a network for the tests: namespaces, and the hub between them."""
import json
import os
import shutil
import subprocess

HOSTS = ("theatre", "cluster", "gallery")
SKIPPED = 77  # exit code of a test that this machine does not allow


def obstacle():
    """What this machine does not allow, or nothing."""
    if os.geteuid() != 0:
        return "namespaces need root"
    if not shutil.which("ip"):
        return "the program ip is not installed (package iproute2)"
    name = f"omentum-{os.getpid()}-try"
    if subprocess.run(["ip", "netns", "add", name], capture_output=True, check=False).returncode != 0:
        return "ip netns add is not allowed here"
    subprocess.run(["ip", "netns", "del", name], check=True)
    return None if os.access("/dev/net/tun", os.W_OK) else "/dev/net/tun is not there"


class Network:
    """Hosts and the hub between them; gone at the end, with all that runs there."""

    def __init__(self, programs, *hub, hosts=HOSTS):
        self.spaces = {host: f"omentum-{os.getpid()}-{host}" for host in hosts}
        self.addresses = {host: f"10.77.0.{number}" for number, host in enumerate(hosts, 1)}
        for space in self.spaces.values():
            subprocess.run(["ip", "netns", "add", space], check=True)
        ports = [f"{space}={self.addresses[host]}/24" for host, space in self.spaces.items()]
        self.hub = subprocess.Popen([programs / "lossy_hub", *hub, *ports], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        if self.hub.stdout.readline() != b"ready\n":
            self.close()
            raise RuntimeError("no hub")

    def within(self, host):
        """The words that run a command there."""
        return ["ip", "netns", "exec", self.spaces[host]]

    def start(self, host, command):
        return subprocess.Popen([*self.within(host), *map(str, command)], stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def close(self):
        """What passed the hub, as it tells it; {} where it did not work."""
        self.hub.stdin.close()
        told = self.hub.stdout.read()
        self.hub.stdout.close()
        self.hub.wait()
        for space in self.spaces.values():
            subprocess.run(["ip", "netns", "del", space], check=True)
        return json.loads(told) if told else {}
