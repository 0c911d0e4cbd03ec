"""Precomputed files, kept by what they are made of."""
import contextlib
import errno
import fcntl
import hashlib
import os
import pathlib
import shutil
import time

from .errors import Refusal
from .options import REPOSITORY
from .telling import tell

PATIENCE_S = 2.0  # anything longer gets a line of progress
POLL_S = 0.1
KEPT_BYTES = 8 << 30  # of the most recently used; a liver of 26,000 nodes takes 3 GB
NOT_OURS = (errno.EACCES, errno.EPERM, errno.EROFS)  # a cache of another user, or on a read-only disk
IN_USE_S = 24 * 3600  # a session of today may start a node again, which needs its files


def digest(*parts):
    """Of texts and of files' contents; a file that is not there counts as empty (organ_build says what is wrong)."""
    total = hashlib.sha256()
    for part in parts:
        if isinstance(part, pathlib.Path):
            content = part.read_bytes() if part.is_file() else b""
        else:
            content = str(part).encode()
        total.update(hashlib.sha256(content).digest())
    return total.hexdigest()[:20]


class Cache:
    """Files under build/cache (or $OMENTUM_CACHE), one folder for each digest of all that a file depends on."""

    def __init__(self):
        self.root = pathlib.Path(os.environ.get("OMENTUM_CACHE") or REPOSITORY / "build" / "cache").resolve()
        try:
            self.root.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise self.refusal(error) from error

    def get(self, name, inputs, make):
        """The file `name` made of `inputs` (texts and files); make(path) writes it when it is not there.

        One launcher at a time makes files. The name belongs to the key: two organs of the same inputs are two files.
        A cache that may only be read serves what it holds, without a lock. Raises Refusal when it does not hold it.
        """
        folder = self.root / digest(name, *inputs)
        file = folder / name
        try:
            with self.locked(name):
                if not file.exists():
                    self.make(folder, name, make)
                with contextlib.suppress(PermissionError):  # another user's, who keeps it in use himself
                    os.utime(folder)
                self.prune()
        except OSError as error:
            if error.errno not in NOT_OURS:
                raise
            if not os.access(file, os.R_OK):
                raise self.refusal(error) from error
        return file

    def refusal(self, error):
        return Refusal(f"the cache {self.root} cannot be written ({error.strerror}); OMENTUM_CACHE=FOLDER names another one")

    @staticmethod
    def make(folder, name, make):
        part = folder / "part"
        shutil.rmtree(part, ignore_errors=True)  # of a launcher that was ended
        part.mkdir(parents=True)
        # made under its own name (an organ is called after its file), then moved: never half a file
        make(part / name)
        (part / name).rename(folder / name)
        part.rmdir()

    @contextlib.contextmanager
    def locked(self, what):
        begin, told = time.monotonic(), False
        with open(self.root / "lock", "a+", encoding="utf-8") as lock:
            while not try_lock(lock):
                if not told and time.monotonic() - begin > PATIENCE_S:
                    lock.seek(0)
                    tell(f"run: waiting for another session: {lock.read().strip() or 'it has the cache'}")
                    told = True
                time.sleep(POLL_S)
            lock.truncate(0)
            lock.write(f"process {os.getpid()} makes {what}\n")
            lock.flush()
            yield

    def prune(self):
        """Forgets what was not used for longest, down to KEPT_BYTES."""
        kept = 0
        folders = [folder for folder in self.root.iterdir() if folder.is_dir()]
        for folder in sorted(folders, key=lambda folder: folder.stat().st_mtime, reverse=True):
            kept += sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
            if kept > KEPT_BYTES and time.time() - folder.stat().st_mtime > IN_USE_S:
                shutil.rmtree(folder, ignore_errors=True)


def try_lock(file):
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
