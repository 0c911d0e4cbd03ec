"""A DDS domain claimed on the network: omentum_domain listens for some seconds, then holds it."""
import ctypes
import signal
import subprocess

from .errors import Refusal
from .processes import PR_SET_PDEATHSIG, STOP_PATIENCE_S


def end_with_launcher():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


class NetworkClaim:
    """Listens, which takes up to three seconds. `rival`: "used by WHOM", or nothing, and then the domain is held."""

    def __init__(self, program, number):
        print(f"run: looking for other sessions in DDS domain {number} of the network", flush=True)
        self.process = subprocess.Popen([str(program), "--domain", str(number)], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0,
                                        preexec_fn=end_with_launcher)
        said = self.process.stdout.readline().strip()
        self.rival = None if said == "free" else said
        if said == "free":
            return
        error = self.process.communicate()[1].strip().splitlines()
        if not said:
            raise Refusal(error[-1] if error else f"{program} ended without an answer")

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.communicate(timeout=STOP_PATIENCE_S)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.communicate()
