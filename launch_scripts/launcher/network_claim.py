"""A DDS domain claimed on the network: omentum_domain listens for some seconds, then holds it."""
import subprocess

from .errors import Refusal
from .host import Here
from .processes import STOP_PATIENCE_S
from .telling import tell


class NetworkClaim:
    """Listens, which takes up to three seconds. `rival`: "used by WHOM", or nothing, and then the domain is held."""

    def __init__(self, program, number, host=Here()):
        """`host`: the machine on which `program` listens."""
        tell(f"run: looking for other sessions in DDS domain {number} of the network")
        self.process = host.popen([str(program), "--domain", str(number)], captured=True)
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
