"""Which Debian packages a program needs on a machine that does not build it."""
import os
import re
import subprocess

EVERYWHERE = ("libc6", "libgcc-s1", "libstdc++6")  # of any Debian that has Python


def output_of(*command):
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""


def needed_by(program):
    """Names of the packages of the libraries that it names itself, as they are installed here: apt-get finds what these need.
    Empty where this machine does not tell."""
    named = re.findall(r"NEEDED\s+(\S+)", output_of("objdump", "-p", str(program)))
    places = dict(re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", str(program)), re.MULTILINE))
    # where the file lies, not the link to it; a package may list it with /usr or without
    files = ["*" + os.path.realpath(places[name]).removeprefix("/usr") for name in named if name in places]
    owners = output_of("dpkg-query", "-S", *files) if files else ""
    return sorted({line.split(":")[0] for line in owners.splitlines() if ": /" in line} - set(EVERYWHERE))
