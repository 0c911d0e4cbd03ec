"""What the scripts tell a person on standard output."""
import os
import signal
import sys
import threading

TURN = threading.Lock()


def tell(text):
    """One line or several, unmixed with another thread's: print() writes a text and its line's end apart. Where nobody reads any
    more (`launch_scripts/run | head`), that is a closed terminal: SIGHUP, and what is still told goes nowhere."""
    with TURN:
        try:
            print(text, flush=True)
            return
        except BrokenPipeError:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, sys.stdout.fileno())  # which takes what is left in the buffer, too
            os.close(nowhere)
    signal.raise_signal(signal.SIGHUP)
