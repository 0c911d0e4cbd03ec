"""The machines of a session: one, or those of a table of hosts. What the programs need is brought to them, and what they
wrote comes back."""
import pathlib
import tomllib
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait

from . import machine_advice, packages
from .errors import Refusal
from .host import Here
from .remote_host import Elsewhere, rewritten
from .telling import tell

CONTROLS = ("omentum_domain", "omentum_session")  # run where haptic_node does
SHARED_KEYS = ("identity_ca.pem", "permissions_ca.pem", "governance.p7s")
ROLE_KEYS = ("cert.pem", "key.pem", "permissions.p7s")


def environment_of(table, spec):
    """What tells transport/ its way about the network, and the host's own variables."""
    peers = table.peers_of(spec)
    return {"OMENTUM_DDS_INTERFACE": spec.interface or spec.address,
            **({"OMENTUM_DDS_PEERS": ",".join(peers)} if peers else {}), **spec.environment}


class Hosts:
    """`table` None: all runs on this machine. Raises Refusal where a machine cannot be reached."""

    def __init__(self, table=None):
        self.table, self.here, self.machines = table, Here(), {}
        try:
            for spec in table.hosts if table else ():
                make = Here if spec.here else Elsewhere
                self.machines[spec.name] = make(spec=spec, environment=environment_of(table, spec))
            at_once(lambda host: host.meet(), self.machines.values(), or_none=True)
            if table:
                refuse_one_machine_twice(table.file, list(self.machines.values()))
        except BaseException:
            self.close()
            raise

    # who runs what
    def of(self, node):
        return self.machines[self.table.spec_of(node).name] if self.table else self.here

    def has(self, node):
        return self.table is None or self.table.spec_of(node) is not None

    def options_of(self, node):
        """What the table has this node told."""
        return self.table.spec_of(node).nodes[node].options if self.table else []

    def control(self):
        """The machine on which a person's commands and the claim to a domain run."""
        return self.of("haptic_node")

    def others(self):
        return [host for host in self.machines.values() if isinstance(host, Elsewhere)]

    def programs_of(self, host):
        return [*host.spec.nodes, *(CONTROLS if host is self.control() else ())]

    def said(self):
        """Who runs where, in a line."""
        places = [f"{host.name} {host.spec.address}: {', '.join(host.spec.nodes)}" for host in self.machines.values() if host.spec.nodes]
        return ["; ".join(places)] if places else []

    # bringing
    def bring(self, options, scene):
        """Programs, organs, the scene and keys, to the machines that need them."""
        at_once(lambda host: self.bring_to(host, options, scene), self.others(), or_none=True)

    def bring_to(self, host, options, scene):
        files = [(options.programs / name, f"bin/{name}") for name in self.programs_of(host)]
        organs = [(file, f"organs/{number}/{file.name}") for number, file in enumerate(organ_files(scene, host.spec.nodes))]
        if "virtual_device" in host.spec.nodes:
            files += [(file, f"{kind}/{file.name}") for kind, file in (("traces", options.trace), ("frames", options.frames)) if file]
        host.bring(files + organs)
        for name in self.programs_of(host):
            require_runnable(host, options.programs / name)
        places = {str(file): host.files[str(file)] for file, _ in organs}
        host.put(rewritten(scene.read_text(encoding="utf-8"), places).encode(), "scene.toml")
        host.files[str(scene)] = str(host.session / "scene.toml")
        if options.keystore:
            self.bring_keys(host, options)

    def bring_keys(self, host, options):
        """Of the roles that the machine plays, with their vendor, and no others'."""
        roles = {name: options.dds[name] for name in host.spec.nodes}
        if host is self.control():
            roles["omentum_session"] = options.dds["haptic_node"]
        names = [*SHARED_KEYS, *(f"{vendor}/{role}/{file}" for role, vendor in roles.items() for file in ROLE_KEYS)]
        for name in names:
            host.put((options.keystore / name).read_bytes(), f"keys/{name}")
        host.files[str(options.keystore)] = str(host.session / "keys")

    # checking
    def advice(self, domain, on_network=True):
        """What a person should change on which machine, a line each; none where all is well, nor for what nodes say themselves."""
        if not self.table:
            facts = self.here.facts
            return machine_advice.of_processors(facts) + (machine_advice.of_network(facts) if on_network else [])
        lines = [f"{host.name}: {line}" for host in self.machines.values() for line in self.advice_of(host)]
        return lines + self.blocked(domain)

    def advice_of(self, host):
        facts, hand = host.facts, {"haptic_node", "virtual_device"} & host.spec.nodes.keys()
        return [*machine_advice.of_interface(facts, host.spec.address, self.table.multicast),
                *machine_advice.of_clock(host.clock_apart_s, host.round_trip_s / 2),
                *(machine_advice.of_realtime(facts) if hand else ()),
                *machine_advice.of_buffers(facts), *machine_advice.of_processors(facts)]

    def blocked(self, domain):
        """What datagrams do not pass between which machines."""
        machines, ports = self.machines.values(), {}
        places = {host.name: host.spec.address for host in machines}

        def ask(host):
            return host.probe(domain, {name: [places[name], ports[name]] for name in places if name != host.name})

        try:
            for host in machines:
                ports[host.name] = host.echo_on(domain)
            heard = dict(zip(places, at_once(ask, machines)))
        except (Refusal, OSError) as error:
            return [f"the network was not looked at: {error}"]
        finally:
            for host in machines:
                if host.name in ports:
                    host.echo_off()
        return machine_advice.of_reach(heard, ports, domain, self.table.multicast)

    def figures(self):
        """What the report says of each machine of a table; of one that is lost, what was known of it."""
        return {host.name: {"address": host.spec.address, "nodes": list(host.spec.nodes), "cores": host.facts["cores"],
                            "kernel": host.facts["kernel"], "clock_apart_s": round(host.clock_apart_s, 3),
                            "steal_share": round(share_of(host), 5)}
                for host in self.machines.values()}

    # the end
    def gather(self):
        for host in self.others():
            try:
                host.gather()
                host.forget()
            except Refusal as refusal:
                tell(f"run: {refusal}; what it wrote stays there")

    def close(self):
        for host in self.machines.values():
            host.close()


def at_once(do, hosts, or_none=False):
    """do(host) of all of them, each over its own link; raises what one of them raised. `or_none`: the links of the others are then
    given up, which may be in the middle of gigabytes; so they are when somebody interrupts."""
    hosts, pool = list(hosts), ThreadPoolExecutor()
    try:
        futures = [pool.submit(do, host) for host in hosts]
        wait(futures, return_when=FIRST_EXCEPTION)
        for future in futures:
            if future.done():
                future.result()
        return [future.result() for future in futures]
    except BaseException:
        if or_none:
            for host in hosts:
                host.abandon()
        raise
    finally:
        pool.shutdown()


def refuse_one_machine_twice(file, machines):
    """By whatever addresses: its ports, and so its DDS domains, are the same ones, which each of both would find in use."""
    places = [host.facts["place"] for host in machines]
    for number, place in enumerate(places):
        if place and place in places[:number]:
            other = places.index(place)
            raise Refusal(f"{file}: hosts[{number}].address: found '{machines[number].spec.address}', the machine of hosts[{other}] "
                          f"('{machines[other].spec.address}') again, expected one [[hosts]] for each machine, with all of its nodes")


def require_runnable(host, program):
    """Refuses with the program's own last words where it lacks a library or the processor lacks an instruction; `program`: here."""
    process = host.popen([host.file(program), "--help"], captured=True)
    said = process.communicate()[1].strip().splitlines()
    if process.returncode == 0:
        return
    why = said[-1] if said else f"{program} ended with code {process.returncode}"
    needed = packages.needed_by(program) if "shared librar" in why else []
    raise Refusal(f"{host.name}: {why}" + (f" (there, as root: apt-get install {' '.join(needed)})" if needed else ""))


def share_of(host):
    try:
        return host.steal_share()
    except Refusal:
        return 0.0


def organ_files(scene, nodes):
    """The files of a prepared scene that `nodes` read: organs of all but a device, scenery of what draws."""
    content = tomllib.loads(scene.read_text(encoding="utf-8"))
    organs = content.get("organs", []) if set(nodes) - {"virtual_device"} else []
    scenery = content.get("scenery", []) if "render_node" in nodes else []
    named = [one.get("file") for one in organs] + [one.get("file") or one.get("mesh") for one in scenery]
    return [pathlib.Path(file) for file in dict.fromkeys(named) if file]
