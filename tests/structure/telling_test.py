"""launch_scripts/launcher/telling.py: what the scripts say, and to whom."""
import concurrent.futures
import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "launch_scripts"
sys.path.insert(0, str(SCRIPTS))
from launcher.telling import tell  # noqa: E402 (the launcher is no installed package)

SPEAKER = "import sys; from launcher.telling import tell; tell('one'); tell('two'); sys.exit(7)"


def exit_code_of_a_speaker_to(listener):
    return subprocess.run([sys.executable, "-B", "-c", SPEAKER], cwd=SCRIPTS, stdout=listener, check=False).returncode


class TellingTest(unittest.TestCase):
    def test_what_two_tell_at_once_is_not_mixed(self):
        class Slow(io.StringIO):
            def write(self, text):
                super().write(text)
                time.sleep(1e-3)  # the other's turn
        told = [f"room/{name}.cpp\n{name}: error" for name in "ab" * 5]
        with contextlib.redirect_stdout(Slow()) as out, concurrent.futures.ThreadPoolExecutor(2) as pool:
            list(pool.map(tell, told))
        self.assertEqual(sorted(out.getvalue().splitlines()), sorted("\n".join(told).splitlines()))

    def test_a_full_disk_ends_nobody(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.assertEqual(exit_code_of_a_speaker_to(full), 7)

    def test_a_pipe_that_nobody_reads_is_a_closed_terminal(self):
        read, write = os.pipe()
        os.close(read)
        self.assertEqual(exit_code_of_a_speaker_to(write), -signal.SIGHUP)
        os.close(write)


if __name__ == "__main__":
    unittest.main()
