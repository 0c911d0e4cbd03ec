#!/usr/bin/env python3
"""The launcher's machines: the table of hosts, what is brought there and back, and that nothing outlives who started it."""
import pathlib
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher import domain, host_table, hosts, machine_advice, options, packages, reach, remote_host  # noqa: E402 (the launcher is no installed package)
from launcher.errors import Refusal  # noqa: E402

PATIENCE_S = 20
TABLE = """
[[hosts]]
name = "theatre"
address = "10.0.0.1"
  [hosts.nodes.haptic_node]
  options = ["--rate-hz", "500"]
[[hosts]]
name = "cluster"
address = "10.0.0.2"
user = "omentum"
  [hosts.nodes.deform_node]
  dds = "cyclone"
  [hosts.nodes.render_node]
"""


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text, mode=0o644):
        path = self.folder / name
        path.write_text(text)
        path.chmod(mode)
        return path

    def wait_for(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.01)


class Tables(WithFolder):
    def read(self, text):
        return host_table.read(self.file("hosts.toml", text))

    def refused(self, text, about):
        with self.assertRaises(Refusal) as caught:
            self.read(text)
        self.assertIn("hosts.toml: ", str(caught.exception))
        self.assertIn(about, str(caught.exception))

    def test_says_which_machine_has_which_node(self):
        table = self.read(TABLE)
        self.assertEqual(table.spec_of("deform_node").name, "cluster")
        self.assertEqual(table.spec_of("haptic_node").nodes["haptic_node"].options, ["--rate-hz", "500"])
        self.assertIsNone(table.spec_of("virtual_device"))
        self.assertEqual(table.spec_of("render_node").way_there()[-3:], ["-l", "omentum", "10.0.0.2"])

    def test_without_multicast_each_machine_is_told_of_the_others(self):
        for text, peers in ((TABLE, []), ("multicast = false\n" + TABLE, ["10.0.0.2"])):
            table = self.read(text)
            self.assertEqual(table.peers_of(table.hosts[0]), peers)

    def test_the_vendor_of_a_node_is_the_tables_or_else_the_command_lines(self):
        parsed = options.parse(["--dds", "haptic=cyclone,render=cyclone", "--hosts", str(self.file("hosts.toml", TABLE))])
        self.assertEqual([parsed.dds[name] for name in ("haptic_node", "deform_node", "virtual_device")], ["cyclone", "cyclone", "fast"])
        self.assertEqual(parsed.profile, "lan")

    def test_what_is_wrong_is_named_with_its_place_and_what_was_expected(self):
        self.refused("hosts = 3", "hosts: found 3, expected [[hosts]]")
        self.refused("\nhosts = ]\n", "line 2")
        self.refused(TABLE.replace('address = "10.0.0.2"', 'adress = "10.0.0.2"'), "hosts[1].address: missing, expected an IPv4 address")
        self.refused(TABLE.replace('user = ', 'usr = '), "hosts[1].usr: unknown, expected name, address, user")
        self.refused(TABLE.replace("10.0.0.2", "cluster.lab"), "hosts[1].address: found 'cluster.lab', expected an IPv4 address")
        self.refused(TABLE.replace("10.0.0.2", "10.0.0.1"), "hosts[1].address: found '10.0.0.1' again")
        self.refused(TABLE.replace('"cyclone"', '"storm"'), "hosts[1].nodes.deform_node.dds: found 'storm', expected fast or cyclone")
        self.refused(TABLE.replace("deform_node", "deformer"), "hosts[1].nodes.deformer: unknown, expected haptic_node")
        self.refused(TABLE.replace("[hosts.nodes.render_node]", ""), "no machine has render_node")
        self.refused(TABLE + "  [hosts.nodes.haptic_node]\n", "hosts[1].nodes.haptic_node: hosts[0] has it already")
        self.refused(TABLE.replace("--rate-hz", "--domain"), "hosts[0].nodes.haptic_node.options: found --domain, which the launcher gives")
        self.refused(TABLE.replace('user =', 'here = true\nuser ='), "hosts[1].user: the launcher's own machine")
        with self.assertRaisesRegex(Refusal, "missing.toml: No such file"):
            host_table.read(self.folder / "missing.toml")
        told = subprocess.run([REPOSITORY / "launch_scripts" / "launch", self.folder / "missing.toml"], capture_output=True, text=True,
                              check=False)
        self.assertEqual((told.returncode, told.stderr.count("\n")), (2, 1), told.stderr)

    def test_the_example_is_a_table(self):
        table = host_table.read(REPOSITORY / "launch_scripts" / "hosts_example.toml")
        self.assertEqual({node for host in table.hosts for node in host.nodes}, set(host_table.NODES))


class Elsewhere(WithFolder):
    """A machine behind a shell, as ssh is one."""

    def machine(self):
        spec = host_table.HostSpec("other", "127.0.0.1", directory=str(self.folder / "there"), reach=["sh", "-c"])
        made = remote_host.Elsewhere(spec, {"OMENTUM_WORD": "hello"})
        self.addCleanup(made.close)
        made.meet()
        return made

    def program(self, text):
        return self.file("program", f"#!/bin/sh\n{text}\n", mode=0o755)

    def test_what_is_there_is_not_brought_again(self):
        organ = self.file("liver.h5", "tensors")
        first = self.machine()
        first.bring([(organ, "organs/0/liver.h5")])
        kept, = (self.folder / "there" / "files").iterdir()
        inode = kept.stat().st_ino
        second = self.machine()
        second.bring([(organ, "organs/0/liver.h5")])
        self.assertEqual(kept.stat().st_ino, inode)
        self.assertEqual(pathlib.Path(second.file(organ)).read_text(), "tensors")
        self.assertEqual(pathlib.Path(second.file(organ)).name, "liver.h5", "an organ is known by its file's name")
        kept.write_text("tens")  # a disk that was full
        third = self.machine()
        third.bring([(organ, "organs/0/liver.h5")])
        self.assertEqual(pathlib.Path(third.file(organ)).read_text(), "tensors")

    def test_a_program_runs_there_is_told_to_end_and_what_it_wrote_comes_home(self):
        there, home = self.machine(), self.folder / "report.json"
        there.bring([(self.program('trap "echo over; exit 7" TERM; echo "$OMENTUM_WORD" >"$1"; while :; do sleep 0.01; done'), "bin/program")])
        written = pathlib.Path(there.result(home))
        process = there.popen([there.file(self.folder / "program"), str(written)], captured=True)
        self.wait_for(lambda: written.exists() and written.read_text(), "the program did not write")
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGUSR2)  # which the shell dies of
        self.assertEqual(process.wait(PATIENCE_S), -signal.SIGUSR2)
        there.gather()
        self.assertEqual(home.read_text(), "hello\n")

    def test_what_a_program_says_is_the_callers(self):
        there = self.machine()
        process = there.popen(["sh", "-c", "echo one; echo two; echo three >&2; exit 3"], captured=True)
        self.assertEqual(process.stdout.readline(), "one\n")
        self.assertEqual(process.communicate(PATIENCE_S), ("two\n", "three\n"))
        self.assertEqual(process.returncode, 3)

    def test_a_program_that_cannot_start_is_a_refusal_and_the_machine_goes_on(self):
        there = self.machine()
        with self.assertRaisesRegex(Refusal, "other: no_such_program: No such file"):
            there.popen(["no_such_program"])
        self.assertEqual(there.popen(["true"]).wait(PATIENCE_S), 0)

    def test_a_program_that_lacks_a_library_there_is_told_with_what_to_install(self):
        there = self.machine()
        there.bring([(self.program("echo 'error while loading shared libraries: libx.so.1' >&2; exit 127"), "bin/program")])
        with mock.patch.object(hosts.packages, "needed_by", lambda _: ["libx1"]):
            with self.assertRaisesRegex(Refusal, r"other: error while loading .* \(there, as root: apt-get install libx1\)"):
                hosts.require_runnable(there, self.folder / "program")

    @unittest.skipUnless(shutil.which("dpkg-query") and shutil.which("objdump"), "no Debian, or no binutils")
    def test_packages_are_those_of_the_libraries_that_a_program_names(self):
        needed = packages.needed_by(options.programs_folder() / "omentum_session")
        self.assertTrue([name for name in needed if name.startswith("libfastrtps")], needed)
        self.assertEqual(packages.needed_by(self.program("true")), [])

    def test_a_machine_that_cannot_be_reached_is_a_refusal_with_the_reason(self):
        spec = host_table.HostSpec("other", "127.0.0.1", reach=["sh", "-c", "echo Permission denied >&2; exit 255"])
        with self.assertRaisesRegex(Refusal, "other cannot be reached: Permission denied"):
            remote_host.Elsewhere(spec, {}).meet()

    def test_programs_end_and_keys_go_when_the_launcher_is_killed(self):
        launcher = subprocess.Popen([sys.executable, "-B", "-c", f"""
import sys, time
sys.path.insert(0, {str(REPOSITORY / "launch_scripts")!r})
from launcher import host_table, remote_host
there = remote_host.Elsewhere(host_table.HostSpec("other", "127.0.0.1", directory={str(self.folder)!r}, reach=["sh", "-c"]), {{}})
there.meet()
there.put(b"secret", "keys/fast/haptic_node/key.pem")
there.popen(["sh", "-c", "trap 'exit 0' TERM; echo $$ >{self.folder}/pid; while :; do sleep 0.01; done"])
time.sleep({PATIENCE_S})
"""])
        self.addCleanup(launcher.wait)
        self.addCleanup(launcher.kill)
        pid = self.folder / "pid"
        self.wait_for(lambda: pid.exists() and pid.read_text(), "the program did not start")
        key, = (self.folder / "sessions").glob("*/keys/fast/haptic_node/key.pem")
        self.assertEqual(stat.S_IMODE(key.stat().st_mode), 0o600)
        launcher.kill()
        self.wait_for(lambda: not pathlib.Path(f"/proc/{pid.read_text().strip()}").exists(), "the program outlives its launcher")
        self.wait_for(lambda: not key.exists(), "the key stays")

    def test_keys_of_an_agent_that_was_killed_go_with_the_next_one_and_a_living_ones_stay(self):
        living, dead = self.machine(), self.machine()
        for one in (living, dead):
            one.put(b"secret", "keys/key.pem")
        dead.link.process.kill()
        dead.link.process.wait()
        self.machine()
        self.assertTrue(pathlib.Path(living.session / "keys" / "key.pem").exists())
        self.assertFalse(pathlib.Path(dead.session / "keys").exists())

    def test_a_domain_that_is_held_there_is_held_for_others(self):
        first, second = self.machine(), self.machine()
        free = domain.Domain()
        number = free.number
        free.release()
        self.assertTrue(first.claim(number, may_join=False))
        self.assertFalse(second.claim(number, may_join=False))
        self.assertTrue(second.claim(number, may_join=True))

    def test_a_scene_names_its_files_as_they_are_called_there(self):
        text = "file = '/a/liver.h5'\nmesh = \"/a/liver.h5.msh\"\n"
        self.assertEqual(remote_host.rewritten(text, {"/a/liver.h5": "/b/c.h5"}), 'file = "/b/c.h5"\nmesh = "/a/liver.h5.msh"\n')


class Advice(WithFolder):
    def facts(self, **other):
        network = {"lan0": {"address": "10.0.0.1", "up": True, "loopback": False, "multicast": True}}
        return {"rmem_max": 4 << 20, "may_be_realtime": True, "governors": ["performance"], "interfaces": network, "interface": None, **other}

    def of(self, facts, address="10.0.0.1"):
        return [*machine_advice.of_interface(facts, address), *machine_advice.of_realtime(facts),
                *machine_advice.of_buffers(facts), *machine_advice.of_processors(facts)]

    def test_a_machine_as_it_should_be_hears_nothing_and_each_fault_is_one_line(self):
        self.assertEqual(self.of(self.facts()), [])
        bare = {"lan0": {"address": "10.0.0.1", "up": True, "loopback": False, "multicast": False}}
        for other, about in (({"rmem_max": 212992}, "sysctl -w net.core.rmem_max=4194304"), ({"may_be_realtime": False}, "rtprio"),
                             ({"governors": ["powersave"]}, "cpupower"), ({"interfaces": bare}, "multicast on"),
                             ({"interface": "wlan0"}, "no interface is called or has wlan0; there are: lan0 10.0.0.1")):
            line, = self.of(self.facts(**other))
            self.assertIn(about, line)
        self.assertIn("the others are told 10.0.0.9", self.of(self.facts(interface="lan0"), address="10.0.0.9")[0])

    def test_the_buffers_are_those_that_the_nodes_ask_for(self):
        self.assertIn("kSocketBufferBytes = 4 * 1024 * 1024;", (REPOSITORY / "transport" / "settings.h").read_text())
        self.assertEqual(machine_advice.SOCKET_BUFFER_BYTES, 4 * 1024 * 1024)

    def test_clocks_count_as_apart_beyond_what_the_measurement_leaves_open(self):
        self.assertEqual(machine_advice.of_clock(apart_s=0.4, uncertain_s=0.0), [])
        self.assertEqual(machine_advice.of_clock(apart_s=1.4, uncertain_s=0.5), [])
        self.assertIn("2.0 s behind", machine_advice.of_clock(apart_s=-2.0, uncertain_s=0.5)[0])

    def test_ports_that_answer_are_open_and_others_are_named(self):
        number = next(n for n in range(60, 100) if not domain.has_participant(n))
        echo = reach.Echo("other", number, "127.0.0.1")
        try:
            heard = reach.probe(number, "127.0.0.1", {"other": ["127.0.0.1", echo.ports], "absent": ["127.0.0.2", echo.ports[:2]]})
        finally:
            echo.close()
        self.assertEqual(heard["absent"], [])
        self.assertLessEqual(set(reach.participant_ports(number)), set(echo.ports))
        self.assertLessEqual(set(map(str, echo.ports)), set(heard["other"]))
        ports = {"other": echo.ports, "absent": echo.ports[:2]}
        line, = machine_advice.of_reach({"theatre": heard}, ports, number, needs_multicast=False)
        self.assertIn("theatre does not reach absent by UDP at any port", line)
        half, unheard = [str(echo.ports[0])], list(map(str, echo.ports))
        self.assertIn(f"at {echo.ports[1]}, ", machine_advice.of_reach({"theatre": {"other": half}}, ports, number)[0])
        self.assertIn("does not hear theatre's multicast", machine_advice.of_reach({"theatre": {"other": unheard}}, ports, number)[0])

    def test_a_domain_in_which_anybody_is_here_is_not_free(self):
        number = next(n for n in range(60, 100) if not domain.has_participant(n))
        with reach.multicast_socket(number, "127.0.0.1"):  # as each program of the domain has it, launched or not
            self.assertTrue(domain.has_participant(number))
            self.assertIsNone(domain.claim_here(number))
            domain.claim_here(number, may_join=True).close()
        self.assertFalse(domain.has_participant(number))


if __name__ == "__main__":
    unittest.main()
