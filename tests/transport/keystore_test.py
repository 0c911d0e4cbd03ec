#!/usr/bin/env python3
"""What launch_scripts/make_keystore writes, and refuses. Leaves the key stores that security_test runs with.

Usage: keystore_test.py MAKE_KEYSTORE FOLDER      FOLDER/ours, of all programs and a device, and FOLDER/theirs
"""
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import unittest.mock

MAKE, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(MAKE.parent))
from launcher import keystore  # noqa: E402
DEVICE = "an_arm"


def make(*arguments, **more):
    return subprocess.run([sys.executable, MAKE, *map(str, arguments)], capture_output=True, text=True, check=False, **more)


def setUpModule():
    shutil.rmtree(FOLDER, ignore_errors=True)
    for name in ("ours", "theirs"):
        done = make(FOLDER / name, "--device", DEVICE)
        assert done.returncode == 0, done.stderr


def der_subject(certificate):
    """The bytes of the subject's name, as OpenSSL finds them: the second sequence of five in the certificate's first one."""
    said = subprocess.run(["openssl", "asn1parse", "-in", certificate], capture_output=True, text=True, check=True).stdout
    fields = [line.replace(":", " ").replace("=", " ").split() for line in said.splitlines()]
    # issuer, validity and subject are sequences of depth 2, after the signature's algorithm
    places = [int(words[0]) for words in fields if words[words.index("d") + 1] == "2" and "SEQUENCE" in words]
    done = subprocess.run(["openssl", "asn1parse", "-in", certificate, "-strparse", str(places[3]), "-noout", "-out", "-"],
                          capture_output=True, check=True)
    return done.stdout


class Keystore(unittest.TestCase):
    def test_one_that_was_made_for_other_topics_is_known(self):
        self.assertTrue(keystore.is_current(FOLDER / "ours"))
        with unittest.mock.patch.dict(keystore.ROLES, {"omentum_domain": ("node_status", "")}):
            self.assertFalse(keystore.is_current(FOLDER / "ours"))
        self.assertFalse(keystore.is_current(FOLDER / "none"))

    def test_every_key_is_its_owners_alone(self):
        keys = [*(FOLDER / "ours").rglob("key.pem"), *(FOLDER / "ours" / "authority").glob("*.key")]
        self.assertGreater(len(keys), 10)
        for key in keys:
            self.assertEqual(key.stat().st_mode & 0o077, 0, key)

    def test_cyclone_begins_every_handshake_with_fast(self):
        certificates = list((FOLDER / "ours").glob("*/*/cert.pem"))
        self.assertGreater(len(certificates), 10)
        for certificate in certificates:
            # the bit that decides is the second of a GUID, after one that is always set
            bit = hashlib.sha256(der_subject(certificate)).digest()[0] >> 7
            self.assertEqual(bit, 0 if certificate.parts[-3] == "cyclone" else 1, certificate)

    def test_signed_documents_are_of_our_authority(self):
        for document in (FOLDER / "ours").rglob("*.p7s"):
            for store, code in (("ours", 0), ("theirs", 4)):
                done = subprocess.run(["openssl", "smime", "-verify", "-in", document, "-CAfile",
                                       FOLDER / store / "permissions_ca.pem"], capture_output=True, check=False)
                self.assertEqual(done.returncode, code, document)

    def check_refused(self, *arguments, about, **more):
        done = make(*arguments, **more)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(about, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_refuses_what_is_wrong_and_leaves_nothing(self):
        before = sorted(FOLDER.iterdir())
        self.check_refused(FOLDER / "ours", about="ours: exists")
        self.check_refused(FOLDER / "new", "--device", "../up", about="--device ../up")
        self.check_refused(FOLDER / "new", "--device", "haptic_node", about="--device haptic_node")
        self.check_refused(FOLDER / "new", "--days", "0", about="--days 0")
        self.check_refused(FOLDER / "new", about="openssl is not installed", env={**os.environ, "PATH": ""})
        self.assertEqual(sorted(FOLDER.iterdir()), before)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
