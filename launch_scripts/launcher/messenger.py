"""A person's commands to the running nodes."""
from .host import Here
from .telling import tell

SAID = {"reset": "run: reset", "clear-fault": "run: fault cleared", "record": "run: told to record, or to end it"}
PAUSE = {"paused": "run: paused (p goes on)", "goes on": "run: goes on"}


class Messenger:
    """Sends one command after the other in the background (finding the nodes takes up to some seconds) and tells what
    became of it, when it did: of a pause, what haptic_node says."""

    def __init__(self, program, arguments, host=Here()):
        """`host`: the machine on which `program` runs, one of the session's network."""
        self.program, self.arguments, self.host = str(program), arguments, host
        self.waiting = []  # (word, nodes to wait for, what to do afterwards, whether success is not told)
        self.process = None

    def send(self, word, nodes, then=None, quiet=False):
        self.waiting.append((word, nodes, then, quiet))

    def poll(self):
        """Call it often. Prints, and starts the next one."""
        if self.process and self.process.poll() is not None:
            self.finish()
        if self.waiting and not self.process:
            word, nodes = self.waiting[0][:2]
            self.process = self.host.popen([self.program, word, *self.arguments, "--nodes", str(nodes)], captured=True)

    def finish(self):
        out, err = self.process.communicate()
        word, _, then, quiet = self.waiting.pop(0)
        if self.process.returncode == 0:
            if not quiet:
                tell(SAID.get(word) or PAUSE.get(out.strip(), out.strip()))
        else:
            tell(f"run: {word} failed: {(err.strip().splitlines() or ['no reason given'])[-1]}")
        self.process = None
        if then:
            then()

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.communicate()
