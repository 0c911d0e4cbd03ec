#!/usr/bin/env python3
"""A session on a network takes a domain that nobody on this machine and nobody on the network uses."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "launch_scripts"))
from launcher import domain, errors  # noqa: E402 (the launcher is no installed package)


class Claims(unittest.TestCase):
    """With a stand-in for omentum_domain."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="omentum-test-")
        self.addCleanup(folder.cleanup)
        self.program = pathlib.Path(folder.name) / "omentum_domain"
        first = domain.Domain()
        self.free = first.number  # on this machine
        first.release()

    def answer(self, script):
        """What the stand-in does, $2 being the domain."""
        self.program.write_text(f"#!/bin/sh\n{script}\n")
        self.program.chmod(0o700)

    def claim(self, wanted=None):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            claimed = domain.Domain(wanted, self.program)
        self.addCleanup(claimed.release)
        return claimed, said.getvalue()

    def test_a_domain_that_is_used_on_the_network_is_left_to_those_who_use_it(self):
        used = 'echo "used by haptic_node on theatre-2"'
        self.answer(f'[ "$2" = {self.free} ] && {used} || {{ echo free; exec sleep 60; }}')
        claimed, said = self.claim()
        self.assertGreater(claimed.number, self.free)
        self.assertIn(f"DDS domain {self.free} is used by haptic_node on theatre-2", said)
        again = domain.Domain()  # on this machine nobody keeps it
        self.addCleanup(again.release)
        self.assertEqual(again.number, self.free)

    def test_the_claim_is_held_until_it_is_released(self):
        self.answer("echo free; exec sleep 60")
        claimed, _ = self.claim()
        holder = claimed.network.process
        self.assertIsNone(holder.poll())
        claimed.release()
        self.assertIsNotNone(holder.poll())

    def test_a_named_domain_is_joined_whoever_uses_it_and_that_is_said(self):
        self.answer('echo "used by a launcher on theatre-2"')
        claimed, said = self.claim(self.free)
        self.assertEqual(claimed.number, self.free)
        self.assertIn("used by a launcher on theatre-2", said)

    def test_a_refusal_is_handed_on(self):
        self.answer('echo "omentum_domain: Cyclone DDS refused domain" >&2; exit 2')
        with self.assertRaisesRegex(errors.Refusal, "Cyclone DDS refused domain"):
            self.claim()


if __name__ == "__main__":
    unittest.main()
