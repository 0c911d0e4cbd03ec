#!/usr/bin/env python3
"""What the launcher makes of machines that lack something, lie, or die, and what it leaves on them."""
import os
import pathlib
import signal
import stat
import sys
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import machines_test  # noqa: E402 (has the machines)

from launcher import agent, host_table, hosts, options, remote_host  # noqa: E402 (the launcher is no installed package)
from launcher.errors import Refusal  # noqa: E402

PATIENCE_S = machines_test.PATIENCE_S


class Faults(machines_test.WithFolder):
    reached = staticmethod(machines_test.Elsewhere.reached)
    machine = machines_test.Elsewhere.machine
    program = machines_test.Elsewhere.program

    def test_what_a_login_prints_is_told_where_the_agent_should_speak(self):
        spec = host_table.HostSpec("other", "127.0.0.1", reach=["sh", "-c", "echo Welcome; sleep 0.1"])
        with self.assertRaisesRegex(Refusal, "other cannot be reached: found 'Welcome' .* must print nothing"):
            remote_host.Elsewhere(spec, {}).meet()

    def test_who_tells_a_program_to_end_waits_for_no_answer(self):
        there = self.machine()  # cut off, it gives none for a minute, and the hand on another machine is told after it
        process = there.popen(["sleep", str(PATIENCE_S)])
        with mock.patch.object(there.link, "ask", side_effect=AssertionError("waits")):
            process.send_signal(signal.SIGUSR2)  # a node blocks SIGTERM until it listens
        self.assertEqual(process.wait(PATIENCE_S), -signal.SIGUSR2)
        self.assertEqual(there.popen(["sh", "-c", "exit 3"]).wait(PATIENCE_S), 3, "answers and questions are still in step")

    def test_a_directory_that_cannot_be_had_is_named_in_plain_words(self):
        for directory, why in ((self.file("taken", ""), "taken/files: Not a directory"), ("~no_such_user/x", "~no_such_user/x: ")):
            spec = host_table.HostSpec("other", "127.0.0.1", directory=str(directory), reach=["sh", "-c"])
            with self.assertRaisesRegex(Refusal, f"^other cannot be reached: [^ ]*{why}"):
                remote_host.Elsewhere(spec, {}).meet()

    def test_an_agent_that_is_killed_leaves_no_modules(self):
        temporary = self.folder / "tmp"
        temporary.mkdir()
        with mock.patch.dict("os.environ", TMPDIR=str(temporary)):
            there = self.machine()
            self.wait_for(lambda: not list(temporary.iterdir()), "an agent that runs has its modules in memory")
            there.link.process.kill()

    def test_a_machine_cannot_write_beside_what_was_asked_of_it(self):
        there, home = self.machine(), self.folder / "home"
        home.mkdir()
        there.result(home)
        ask = there.link.ask
        for name in ("../stolen", "/stolen"):
            listed = f"{there.results[str(home)].removeprefix(str(there.session) + '/')}/{name}" if name[0] == "." else name
            with mock.patch.object(there.link, "ask", lambda do, **what: {"files": [listed]} if do == "list" else ask(do, **what)):
                with self.assertRaisesRegex(Refusal, "other: .*stolen"):
                    there.fetch(home)
        self.assertFalse((self.folder / "stolen").exists())

    def test_a_file_that_cannot_be_kept_leaves_no_part_and_the_machine_goes_on(self):
        there = self.machine()
        there.put(b"a file", "taken")
        with self.assertRaisesRegex(Refusal, "taken"):
            there.put(b"{" * 100000, "taken/under")
        with self.assertRaisesRegex(Refusal, "arrived with the hash"):
            there.link.ask("put", b"other", digest="0" * 64, mode=0o600)
        self.assertEqual(there.popen(["true"]).wait(PATIENCE_S), 0)
        self.assertEqual(list((self.folder / "there" / "files").iterdir()), [])

    def test_a_directory_of_another_user_is_refused(self):
        with mock.patch.object(agent.os, "geteuid", lambda: os.getuid() + 1), self.assertRaisesRegex(Refusal, "belongs to another user"):
            agent.require_own(self.folder)
        agent.require_own(self.folder)

    def test_only_its_user_writes_where_programs_are_kept(self):
        old = os.umask(0)
        self.addCleanup(os.umask, old)
        self.machine()
        self.assertEqual(stat.S_IMODE((self.folder / "there" / "files").stat().st_mode) & 0o022, 0)

    def test_how_devices_stand_is_brought_to_the_machine_that_has_the_device(self):
        frames = self.file("frames.toml", "[[devices]]\ntool = 0\n")
        there = self.machine()
        there.spec = host_table.HostSpec("other", "127.0.0.1", nodes={"virtual_device": host_table.NodeSpec()})
        chosen = options.Options(programs=self.folder, frames=frames)
        self.program("exit 0").rename(self.folder / "virtual_device")
        made = hosts.Hosts()
        with mock.patch.object(made, "control", lambda: None):
            made.bring_to(there, chosen, self.file("scene.toml", ""))
        self.assertEqual(pathlib.Path(there.file(frames)).read_text(), frames.read_text())
        self.assertNotEqual(there.file(frames), str(frames))


if __name__ == "__main__":
    unittest.main()
