#!/usr/bin/env python3
"""The launcher's machines: the table of hosts, what is brought there and back, and that nothing outlives who started it."""
import pathlib
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher import domain, host_table, hosts, options, packages, remote_host, session  # noqa: E402 (the launcher is no installed package)
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

    def test_without_multicast_each_machine_is_told_of_all_itself_included(self):
        for text, peers in ((TABLE, []), ("multicast = false\n" + TABLE, ["10.0.0.1", "10.0.0.2"])):
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
        self.refused(TABLE.replace("10.0.0.2", "0.0.0.0"), "hosts[1].address: found '0.0.0.0', expected an IPv4 address")
        self.refused(TABLE.replace("10.0.0.2", "239.255.0.1"), "hosts[1].address: found '239.255.0.1'")
        self.refused(TABLE.replace('user =', 'environment = {"A=B" = "x"}\nuser ='), "hosts[1].environment: found")
        self.refused(TABLE.replace('user =', 'environment = {A = "x\\u0000"}\nuser ='), "hosts[1].environment: found")
        self.refused(TABLE.replace('"500"', '"\\u0000"'), "hosts[0].nodes.haptic_node.options: found")
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

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.shared = cls.reached(pathlib.Path(folder.name))
        cls.addClassCleanup(cls.shared.close)

    @staticmethod
    def reached(directory):
        made = remote_host.Elsewhere(host_table.HostSpec("other", "127.0.0.1", directory=str(directory), reach=["sh", "-c"]),
                                     {"OMENTUM_WORD": "hello"})
        made.meet()
        return made

    def machine(self):
        """One of the test's own."""
        made = self.reached(self.folder / "there")
        self.addCleanup(made.close)
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
        there, home = self.shared, self.folder / "report.json"
        there.bring([(self.program('trap "echo over; exit 7" TERM; echo "$OMENTUM_WORD" >"$1"; while :; do sleep 0.01; done'), "bin/one")])
        written = pathlib.Path(there.result(home))
        process = there.popen([there.file(self.folder / "program"), str(written)], captured=True)
        self.wait_for(lambda: written.exists() and written.read_text(), "the program did not write")
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGUSR2)  # which the shell dies of
        self.assertEqual(process.wait(PATIENCE_S), -signal.SIGUSR2)
        there.fetch(home)
        self.assertEqual(home.read_text(), "hello\n", "before the session ends, where it is asked for")
        home.unlink()
        self.assertEqual(there.home(str(written)), str(home))
        self.assertEqual(there.home(str(written / "video")), str(home / "video"))
        self.assertEqual(there.home("/elsewhere"), "/elsewhere")
        there.gather()
        self.assertEqual(home.read_text(), "hello\n")

    def test_what_a_program_says_is_the_callers(self):
        there = self.shared
        process = there.popen(["sh", "-c", "echo one; echo two; echo three >&2; exit 3"], captured=True)
        self.assertEqual(process.stdout.readline(), "one\n")
        self.assertEqual(process.communicate(PATIENCE_S), ("two\n", "three\n"))
        self.assertEqual(process.returncode, 3)

    def test_a_program_that_cannot_start_is_a_refusal_and_the_machine_goes_on(self):
        there = self.shared
        with self.assertRaisesRegex(Refusal, "other: no_such_program: No such file"):
            there.popen(["no_such_program"])
        self.assertEqual(there.popen(["true"]).wait(PATIENCE_S), 0)

    def test_a_program_that_lacks_a_library_there_is_told_with_what_to_install(self):
        there = self.shared
        there.bring([(self.program("echo 'error while loading shared libraries: libx.so.1' >&2; exit 127"), "bin/two")])
        with mock.patch.object(hosts.packages, "needed_by", lambda _: ["libx1"]):
            with self.assertRaisesRegex(Refusal, r"other: error while loading .* \(there, as root: apt-get install libx1\)"):
                hosts.require_runnable(there, self.folder / "program")

    @unittest.skipUnless(shutil.which("dpkg-query") and shutil.which("objdump"), "no Debian, or no binutils")
    def test_packages_are_those_of_the_libraries_that_a_program_names(self):
        self.assertIn("libselinux1", packages.needed_by(pathlib.Path(shutil.which("sed")).resolve()))
        self.assertEqual(packages.needed_by(self.program("true")), [])

    def test_one_machine_by_two_addresses_is_refused_with_its_place(self):
        text = TABLE.replace('user = "omentum"', f"directory = '{self.folder}/there'\nreach = ['sh', '-c']")
        table = host_table.read(self.file("hosts.toml", text.replace('address = "10.0.0.1"', 'address = "10.0.0.1"\nhere = true')))
        with self.assertRaises(Refusal) as caught:
            hosts.Hosts(table)
        self.assertIn(r"hosts.toml: hosts[1].address: found '10.0.0.2', the machine of hosts[0] ('10.0.0.1') again, expected one [[hosts]]",
                      str(caught.exception))

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

    def test_a_session_that_wrote_nothing_leaves_nothing_and_one_that_nobody_came_for_stays(self):
        idle, busy = self.machine(), self.machine()
        idle.put(b"name = 1", "scene.toml")
        busy.popen(["sh", "-c", 'echo written >"$0"', busy.result(self.folder / "report.json")]).wait(PATIENCE_S)
        for one in (idle, busy):
            one.close()
        self.assertFalse(pathlib.Path(idle.session).exists())
        self.assertTrue(pathlib.Path(busy.results[str(self.folder / "report.json")]).exists())

    def test_who_brings_gigabytes_stops_when_another_machine_refuses(self):
        class Slow:
            def __init__(self):
                self.abandoned = threading.Event()
                self.abandon = self.abandoned.set

        def bring(host):
            if host is hosts_asked[0]:
                raise Refusal("no room")
            self.assertTrue(host.abandoned.wait(PATIENCE_S))

        hosts_asked = [Slow(), Slow()]
        with self.assertRaisesRegex(Refusal, "no room"):
            hosts.at_once(bring, hosts_asked, or_none=True)
        self.assertEqual(hosts.at_once(lambda one: hosts_asked.index(one), hosts_asked), [0, 1])

    def test_a_machine_that_is_abandoned_ends_what_is_asked_of_it(self):
        there = self.machine()
        big = self.folder / "big"
        with open(big, "wb") as file:
            file.truncate(8 << 30)  # takes no room here, and seconds to read
        threading.Timer(0.05, there.abandon).start()
        with open(big, "rb") as content, self.assertRaisesRegex(Refusal, "other cannot be reached"):
            there.link.ask("put", content, name="big", mode=0o600, bytes=8 << 30)
        self.wait_for(lambda: not pathlib.Path(there.session).exists(), "the agent stays")

    def test_a_window_that_is_closed_there_ends_the_session(self):
        report = self.folder / "render_node.json"
        there = self.shared
        there.popen(["sh", "-c", 'echo "{\\"closed\\": true}" >"$0"', there.result(report)]).wait(PATIENCE_S)
        node = mock.Mock(exit=0, starts=1, report=report, host=there)
        node.name = "render_node"
        watching = session.Session.__new__(session.Session)
        watching.options, watching.restarts, watching.stopping = mock.Mock(restart=False), {}, False
        with mock.patch("builtins.print"):
            watching.ended(node, elapsed=20.0)
        self.assertTrue(watching.stopping)

    def test_a_domain_that_is_held_there_is_held_for_others(self):
        first, second = self.shared, self.machine()
        number = next(n for n in range(90, 100) if not domain.has_participant(n))  # sessions beside this test take low ones
        self.assertTrue(first.claim(number, may_join=False))
        self.assertFalse(second.claim(number, may_join=False))
        self.assertTrue(second.claim(number, may_join=True))

    def test_a_scene_names_its_files_as_they_are_called_there(self):
        text = "file = '/a/liver.h5'\nmesh = \"/a/liver.h5.msh\"\n"
        self.assertEqual(remote_host.rewritten(text, {"/a/liver.h5": "/b/c.h5"}), 'file = "/b/c.h5"\nmesh = "/a/liver.h5.msh"\n')


if __name__ == "__main__":
    unittest.main()
