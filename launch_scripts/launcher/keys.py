"""Single keys from a terminal, without Enter."""
import os
import select
import sys
import termios
import time
import tty


class Keys:
    """While it is open, keys arrive one by one; elsewhere than in a foreground terminal none ever does."""

    def __init__(self):
        self.saved = None

    def __enter__(self):
        if sys.stdin.isatty() and os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp():
            self.saved = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin)
        return self

    def __exit__(self, *_):
        if self.saved:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self.saved)

    def wait(self, seconds):
        """A key, or None after `seconds`."""
        if not self.saved:
            time.sleep(seconds)
            return None
        ready, _, _ = select.select([sys.stdin], [], [], seconds)
        return os.read(sys.stdin.fileno(), 1).decode(errors="replace") if ready else None
