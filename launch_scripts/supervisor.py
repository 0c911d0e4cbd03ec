#!/usr/bin/env python3
"""Prepares and runs one session; launch_scripts/run calls it when everything is built."""
import os
import shutil
import signal
import sys

from launcher import keystore, options, organs
from launcher.errors import Refusal
from launcher.hosts import Hosts
from launcher.session import Session
from launcher.telling import tell


def interrupt(*_):
    raise KeyboardInterrupt


def on_end(handler):
    """A closed terminal (SIGHUP) ends a session as SIGTERM does, unless somebody wants it to go on (nohup)."""
    numbers = [signal.SIGTERM]
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:
        numbers.append(signal.SIGHUP)
    for number in numbers:
        signal.signal(number, handler)


def run(arguments):
    chosen = options.parse(arguments)
    if chosen.check_only:
        return 0
    on_end(interrupt)
    scene, name = organs.prepare(chosen)
    if chosen.prepare_only:
        print(f"run: {scene}")
        return 0
    if chosen.keystore == options.OWN_KEYSTORE and not keystore.is_current(chosen.keystore):
        tell("run: making keys for --secure")
        shutil.rmtree(chosen.keystore, ignore_errors=True)
        keystore.make(chosen.keystore)
    hosts = Hosts(chosen.hosts)
    try:
        hosts.bring(chosen, scene)
        return play(Session(chosen, scene, name, hosts))
    finally:
        hosts.close()


def play(session):
    """Until the session is over, or somebody ends it."""
    def end(number, _):
        if number == signal.SIGHUP:
            sys.stdout = sys.stderr = open(os.devnull, "w", encoding="utf-8")  # nobody reads what is said from here on
        session.stop()

    on_end(end)
    signal.signal(signal.SIGINT, end)
    code = session.run()
    on_end(signal.SIG_IGN)  # the interpreter gives its own handlers up before it is gone
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    return code


def main():
    try:
        # launch_scripts/run holds Ctrl-C back until here, where it is caught
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        code = run(sys.argv[1:])
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # all is done: nothing is left to end
        return code
    except Refusal as refusal:
        print(f"run: {refusal}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"run: {error.filename or 'the system'}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        print("run: ended before the session began", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
