"""Messages between the launcher and its agent on another machine: a line of JSON each, and bytes that follow it."""
import json

CHUNK_BYTES = 1 << 20
SHOWN_BYTES = 60  # of what is no message


class Foreign(ValueError):
    """A line that no end of a link wrote."""


def write(stream, message, payload=b""):
    """`payload`: bytes, or a file of which message["bytes"] are sent. One thread at a time."""
    if isinstance(payload, bytes):
        stream.write(json.dumps({**message, "bytes": len(payload)}).encode() + b"\n" + payload)
    else:
        stream.write(json.dumps(message).encode() + b"\n")
        for part in parts(payload, message["bytes"]):
            stream.write(part)
    stream.flush()


def read(stream):
    """The next message, whose bytes are still to be read; None at the end, a torn line included. Raises Foreign."""
    line = stream.readline()
    if not line.endswith(b"\n"):
        return None
    try:
        message = json.loads(line)
    except ValueError:
        message = None
    if not isinstance(message, dict):
        raise Foreign(f"found '{line[:SHOWN_BYTES].decode(errors='replace').strip()}'")
    return message


def parts(stream, count):
    """`count` bytes in pieces. Raises EOFError where they end before."""
    while count > 0:
        part = stream.read(min(count, CHUNK_BYTES))
        if not part:
            raise EOFError(f"{count} bytes are missing")
        count -= len(part)
        yield part
