"""What a machine gives to a session, read from the system itself; machine_advice.py says what of it should be changed."""
import fcntl
import os
import pathlib
import platform
import socket
import struct
import subprocess

BOOT = pathlib.Path("/proc/sys/kernel/random/boot_id")
NETWORK = "/proc/self/ns/net"
RMEM_MAX = pathlib.Path("/proc/sys/net/core/rmem_max")
GOVERNORS = pathlib.Path("/sys/devices/system/cpu")
SIOCGIFADDR, SIOCGIFFLAGS = 0x8915, 0x8913
IFF_UP, IFF_LOOPBACK, IFF_MULTICAST = 0x1, 0x8, 0x1000


def gather(wanted_interface=None):
    """One dictionary of plain values; `wanted_interface`: the name or address that a person gave, if he did."""
    return {
        "place": place(), "host": socket.gethostname(), "kernel": platform.release(), "cores": len(os.sched_getaffinity(0)),
        "rmem_max": number_in(RMEM_MAX),
        "may_be_realtime": may_be_realtime(),
        "governors": governors(),
        "interfaces": interfaces(),
        "interface": wanted_interface,
    }


def place():
    """The same for two programs whose ports are the same: of one machine, in one network of it (a container has its own)."""
    try:
        return [BOOT.read_text(encoding="ascii").strip(), os.readlink(NETWORK)]
    except OSError:
        return None


def number_in(file):
    try:
        return int(file.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return None


def may_be_realtime():
    """Whether a program may take SCHED_FIFO: asked of the kernel by one that does nothing."""
    try:
        return subprocess.run(["chrt", "-f", "1", "true"], stdin=subprocess.DEVNULL, capture_output=True, check=False).returncode == 0
    except OSError:
        return True  # nobody knows: haptic_node says so itself


def governors(folder=GOVERNORS):
    """How the processors choose their frequency; empty where the machine does not say."""
    found = set()
    for file in folder.glob("cpu[0-9]*/cpufreq/scaling_governor"):
        try:
            found.add(file.read_text(encoding="ascii").strip())
        except OSError:
            pass
    return sorted(found)


def interfaces():
    """name -> address, and whether it is up, the loopback, and has multicast."""
    found = {}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        for _, name in socket.if_nameindex():
            request = struct.pack("256s", name.encode()[:15])
            try:
                flags = struct.unpack_from("H", fcntl.ioctl(asking, SIOCGIFFLAGS, request), 16)[0]
                address = socket.inet_ntoa(fcntl.ioctl(asking, SIOCGIFADDR, request)[20:24])
            except OSError:
                continue  # without an IPv4 address, DDS does not use it
            found[name] = {"address": address, "up": bool(flags & IFF_UP), "loopback": bool(flags & IFF_LOOPBACK),
                           "multicast": bool(flags & IFF_MULTICAST)}
    return found
