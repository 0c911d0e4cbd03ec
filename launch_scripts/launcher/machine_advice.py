"""What a person should change on a machine of a session, in one line each; nothing where all is well."""

SOCKET_BUFFER_BYTES = 4 * 1024 * 1024  # transport/settings.h
CLOCKS_APART_S = 1.0  # NTP keeps them within some milliseconds


def of_processors(facts):
    slow = [name for name in facts["governors"] if name == "powersave"]
    if slow:
        return ["the processors save power (governor powersave), so that ticks come late; as root: "
                "cpupower frequency-set -g performance"]
    return []


def of_realtime(facts):
    if facts["may_be_realtime"]:
        return []
    return ["no real-time priority for this user: 'USER - rtprio 60' and 'USER - memlock unlimited' in "
            "/etc/security/limits.conf, and a new login"]


def of_buffers(facts):
    if facts["rmem_max"] is None or facts["rmem_max"] >= SOCKET_BUFFER_BYTES:
        return []
    return [f"net.core.rmem_max is {facts['rmem_max']} bytes, so that organ states are lost; as root: "
            f"sysctl -w net.core.rmem_max={SOCKET_BUFFER_BYTES} (to keep it: a file in /etc/sysctl.d)"]


def chosen_interface(facts, address=None):
    """(name, what is known of it) of the interface that was named, or has the address; None where there is none."""
    wanted = [word for word in (facts["interface"], address) if word]
    for name, one in facts["interfaces"].items():
        if wanted and wanted[0] in (name, one["address"]):
            return name, one
    return None


def of_interface(facts, address, needs_multicast=True):
    """`address`: at which the other machines reach it."""
    known = ", ".join(f"{name} {one['address']}" for name, one in facts["interfaces"].items()) or "none"
    found = chosen_interface(facts, address)
    if found is None:
        return [f"no interface is called or has {facts['interface'] or address}; there are: {known}"]
    name, one = found
    if one["address"] != address:
        return [f"interface {name} has the address {one['address']}, and the others are told {address}; there are: {known}"]
    if not one["up"]:
        return [f"interface {name} is down; as root: ip link set {name} up"]
    if needs_multicast and not one["multicast"]:
        return [f"interface {name} has no multicast; as root: ip link set {name} multicast on; or 'multicast = false' in the "
                "table of hosts"]
    return []


def of_network(facts):
    """On a network without a table of hosts: some interface must do."""
    outward = {name: one for name, one in facts["interfaces"].items() if not one["loopback"] and one["up"]}
    if not outward:
        return ["no interface but the loopback is up: no other machine can be reached"]
    if not any(one["multicast"] for one in outward.values()):
        return [f"no interface has multicast ({', '.join(outward)}): OMENTUM_DDS_PEERS=ADDRESS,ADDRESS names the other machines"]
    return []


def of_clock(apart_s, uncertain_s):
    """`apart_s`: how far ahead of the launcher's the machine's clock is."""
    if abs(apart_s) - uncertain_s < CLOCKS_APART_S:
        return []
    word = "ahead of" if apart_s > 0 else "behind"
    return [f"its clock is {abs(apart_s):.1f} s {word} this machine's (timedatectl set-ntp true): no force or picture minds, but keys "
            "may count as not yet valid, and of two equal nodes the one with the slow clock passes for the older"]


def of_reach(heard_by, ports_of, domain, needs_multicast=True):
    """What is blocked between machines. heard_by: name of who asked -> name of who answered -> ways (reach.py); ports_of: name ->
    the ports at which that machine answers."""
    lines = []
    for asker, answers in heard_by.items():
        for name, ways in answers.items():
            silent = [port for port in ports_of[name] if str(port) not in ways]
            if silent:
                which = "at any port" if len(silent) == len(ports_of[name]) else f"at {', '.join(map(str, silent))}"
                lines.append(f"{asker} does not reach {name} by UDP {which}: a firewall there, or no route; DDS domain {domain} needs "
                             f"UDP {7400 + 250 * domain} to {7649 + 250 * domain}, and with Cyclone DDS 32768 to 60999, from the "
                             "other machines")
            elif needs_multicast and "multicast" not in ways:
                lines.append(f"{name} does not hear {asker}'s multicast (239.255.0.1, UDP {7400 + 250 * domain}): a firewall, or a "
                             "switch or WLAN that keeps it back; or 'multicast = false' in the table of hosts")
    return lines
