"""Single keys from a terminal, without Enter."""
import os
import select
import sys
import termios
import time
import tty


def in_foreground(stream):
    """Whether keys typed there are meant for us: not so for a job in the background, or another's terminal."""
    try:
        return stream.isatty() and os.tcgetpgrp(stream.fileno()) == os.getpgrp()
    except OSError:
        return False


class Keys:
    """While it is open, keys arrive one by one; elsewhere than in a foreground terminal none ever does."""

    def __init__(self):
        self.saved = None

    def __enter__(self):
        if in_foreground(sys.stdin):
            self.saved = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin, termios.TCSADRAIN)  # keeps what was typed already
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
