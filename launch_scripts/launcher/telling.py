"""What the scripts tell a person on standard output."""
import os
import signal
import sys
import threading

TURN = threading.Lock()


def tell(text):
    """One line or several, unmixed with another thread's: print() writes a text and its line's end apart. Where it cannot be written
    (a full disk), this and what follows goes nowhere: no session ends for it. Where nobody reads any more (`run | head`), that is a
    closed terminal besides: SIGHUP."""
    with TURN:
        try:
            print(text, flush=True)
            return
        except OSError as error:
            is_closed = isinstance(error, BrokenPipeError)
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, sys.stdout.fileno())  # which takes what is left in the buffer, too
            os.close(nowhere)
    if is_closed:
        signal.raise_signal(signal.SIGHUP)
