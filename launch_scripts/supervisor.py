#!/usr/bin/env python3
"""Prepares and runs one session; launch_scripts/run calls it when everything is built."""
import signal
import sys

from launcher import options, organs
from launcher.errors import Refusal
from launcher.session import Session


def interrupt(*_):
    raise KeyboardInterrupt


def run(arguments):
    chosen = options.parse(arguments)
    if chosen.check_only:
        return 0
    signal.signal(signal.SIGTERM, interrupt)
    scene, name = organs.prepare(chosen)
    if chosen.prepare_only:
        print(f"run: {scene}")
        return 0
    session = Session(chosen, scene, name)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: session.stop())
    return session.run()


def main():
    try:
        return run(sys.argv[1:])
    except Refusal as refusal:
        print(f"run: {refusal}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"run: {error.filename or 'the system'}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("run: ended before the session began", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
