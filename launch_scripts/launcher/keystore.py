"""A key store for DDS Security: who may join a session, and what each of them may say and hear.

    KEYSTORE/identity_ca.pem, permissions_ca.pem, governance.p7s    of all machines
    KEYSTORE/VENDOR/ROLE/cert.pem, key.pem, permissions.p7s         of the machines that play the role
    KEYSTORE/authority/                                             the keys that sign: of no machine in a session
    KEYSTORE/rights                                                 a hash of what all roles may, for is_current

A role is the name with which a program joins. transport/keystore.h reads what is written here.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from .errors import Refusal

# role -> (topics that it may write, topics that it may read); what the programs do is in their readers and writers
ROLES = {
    "haptic_node": ("tool_force contact node_status",
                    "tool_pose device_info local_model session_command scene_info node_status"),
    "deform_node": ("scene_info topology organ_state organ_stress touching_pairs local_model node_status",
                    "contact tool_pose tool_force device_info session_command scene_info node_status"),
    "render_node": ("pointer_ray session_command node_status",
                    "contact tool_pose device_info tool_force organ_state organ_stress touching_pairs topology scene_info session_command "
                    "node_status"),
    "virtual_device": ("tool_pose device_info node_status",
                       "tool_force pointer_ray session_command scene_info node_status"),
    "omentum_session": ("session_command", "node_status"),
    "ros_bridge": ("session_command", "tool_pose tool_force node_status"),
    "omentum_domain": ("node_status", "node_status"),
}
DEVICE = ("tool_pose device_info", "tool_force")  # of a maker's own bridge
VENDORS = ("fast", "cyclone")
LAST_DOMAIN = 230
VALID_DAYS = 3650
ROLE_NAME = re.compile(r"[A-Za-z][\w-]{0,31}")

DOMAINS = f"<domains><id_range><min>0</min><max>{LAST_DOMAIN}</max></id_range></domains>"
# data_protection_kind: what both vendors can do together; the other kinds encrypt the samples, too
GOVERNANCE = f"""<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
  {DOMAINS}
  <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
  <enable_join_access_control>true</enable_join_access_control>
  <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
  <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
  <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
  <topic_access_rules><topic_rule>
    <topic_expression>*</topic_expression>
    <enable_discovery_protection>true</enable_discovery_protection>
    <enable_liveliness_protection>true</enable_liveliness_protection>
    <enable_read_access_control>true</enable_read_access_control>
    <enable_write_access_control>true</enable_write_access_control>
    <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
    <data_protection_kind>NONE</data_protection_kind>
  </topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
"""


def hash_of_rights():
    return hashlib.sha256(repr((GOVERNANCE, sorted(ROLES.items()), DEVICE)).encode()).hexdigest() + "\n"


def is_current(folder):
    """Whether a key store gives each role what its program writes and reads today."""
    try:
        return (pathlib.Path(folder) / "rights").read_text(encoding="ascii") == hash_of_rights()
    except (OSError, UnicodeDecodeError):
        return False


def permissions(subject, rights, first, last):
    """The document of one identity. `first`, `last`: when it begins and ends to be valid, as in XML."""
    def topics(words):
        return "<topics>" + "".join(f"<topic>omentum/*/{word}</topic>" for word in words.split()) + "</topics>"

    writes, reads = rights
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="{subject}">
  <subject_name>CN={subject}</subject_name>
  <validity><not_before>{first}</not_before><not_after>{last}</not_after></validity>
  <allow_rule>
    {DOMAINS}
    <publish>{topics(writes)}</publish>
    <subscribe>{topics(reads)}</subscribe>
  </allow_rule>
  <default>DENY</default>
</grant></permissions></dds>
"""


def name_in_der(common_name):
    """The X.501 name that has a common name only, as it is in a certificate."""
    def tagged(tag, *contents):
        content = b"".join(contents)
        return bytes([tag, len(content)]) + content

    common_name_oid = bytes([0x55, 0x04, 0x03])
    return tagged(0x30, tagged(0x31, tagged(0x30, tagged(0x06, common_name_oid), tagged(0x0C, common_name.encode()))))


def subject_of(vendor, role):
    """A common name whose bearers let Cyclone begin the handshake: of two participants the one with the lower GUID begins,
    both vendors take its first bits from the hash of the name, and Fast DDS cannot begin one with Cyclone."""
    wanted = 0 if vendor == "cyclone" else 1
    for suffix in range(1, 1000):
        name = f"{role}.{vendor}.{suffix}"
        if hashlib.sha256(name_in_der(name)).digest()[0] >> 7 == wanted:
            return name
    raise AssertionError("a hash with one bit given is found within a thousand names")


def openssl(*arguments):
    done = subprocess.run(["openssl", *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise Refusal(f"openssl {arguments[0]} failed: {(done.stderr.strip().splitlines() or ['no reason given'])[-1]}")
    return done.stdout


class Authority:
    """A key that signs, and its certificate."""

    def __init__(self, folder, name, days):
        self.certificate, self.key, self.days = folder / f"{name}_ca.pem", folder / f"{name}_ca.key", days
        new_key(self.key)
        openssl("req", "-x509", "-new", "-sha256", "-key", self.key, "-subj", f"/CN=Omentum {name} authority",
                "-days", days, "-out", self.certificate)

    def certify(self, subject, key, certificate):
        request = certificate.with_suffix(".csr")
        openssl("req", "-new", "-sha256", "-key", key, "-subj", f"/CN={subject}", "-out", request)
        openssl("x509", "-req", "-sha256", "-in", request, "-CA", self.certificate, "-CAkey", self.key, "-CAcreateserial",
                "-days", self.days, "-out", certificate)
        request.unlink()
        lines = certificate.read_text(encoding="ascii").splitlines()
        if name_in_der(subject) not in base64.b64decode("".join(line for line in lines if not line.startswith("-"))):
            raise Refusal(f"{certificate}: openssl wrote the subject in another way than expected: CN={subject}")

    def sign(self, text, signed):
        plain = signed.with_suffix(".xml")
        plain.write_text(text, encoding="utf-8")
        openssl("smime", "-sign", "-in", plain, "-text", "-out", signed, "-signer", self.certificate, "-inkey", self.key)
        plain.unlink()

    def dates(self):
        """When its certificate begins and ends to be valid, as XML writes dates."""
        said = openssl("x509", "-in", self.certificate, "-noout", "-startdate", "-enddate", "-dateopt", "iso_8601")
        return [line.split("=")[1].strip().replace(" ", "T") for line in said.splitlines()]


def new_key(file):
    openssl("ecparam", "-name", "prime256v1", "-genkey", "-noout", "-out", file)
    file.chmod(0o600)


def check_devices(devices):
    for name in devices:
        if not ROLE_NAME.fullmatch(name):
            raise Refusal(f"--device {name}: expected a name of letters, digits, _ and -, at most 32")
        if name in ROLES:
            raise Refusal(f"--device {name}: that is the name of a program of Omentum")


def write_into(folder, devices, days):
    authority = folder / "authority"
    authority.mkdir(mode=0o700)
    identity, permission = Authority(authority, "identity", days), Authority(authority, "permissions", days)
    for one in (identity, permission):
        shutil.copyfile(one.certificate, folder / one.certificate.name)
    permission.sign(GOVERNANCE, folder / "governance.p7s")
    first, last = permission.dates()
    for role, rights in {**ROLES, **dict.fromkeys(devices, DEVICE)}.items():
        for vendor in VENDORS:
            own = folder / vendor / role
            own.mkdir(parents=True, mode=0o755)
            subject = subject_of(vendor, role)
            new_key(own / "key.pem")
            identity.certify(subject, own / "key.pem", own / "cert.pem")
            permission.sign(permissions(subject, rights, first, last), own / "permissions.p7s")
    (folder / "rights").write_text(hash_of_rights(), encoding="ascii")


def make(folder, devices=(), days=VALID_DAYS):
    """A key store that is there whole or not at all. Raises Refusal."""
    folder = pathlib.Path(folder)
    check_devices(devices)
    if not shutil.which("openssl"):
        raise Refusal("openssl is not installed; launch_scripts/setup installs it")
    if folder.exists():
        raise Refusal(f"{folder}: exists; a key store is made anew under another name, or after that one is removed")
    folder.parent.mkdir(parents=True, exist_ok=True)
    before = os.umask(0o077)  # no key is ever readable by others, not even while it is made
    try:
        with tempfile.TemporaryDirectory(prefix=".keystore-", dir=folder.parent) as work:
            made = pathlib.Path(work) / "keystore"
            made.mkdir()
            write_into(made, devices, days)
            made.rename(folder)
    finally:
        os.umask(before)
