"""Videos of the pictures that render_node recorded."""
import pathlib
import shlex
import shutil
import subprocess

from .telling import tell

PICTURE = "[0-9]" * 6 + "*.png"
FOLDERS = ("video", "video_[0-9]*")


def clear(out):
    """What an earlier session recorded into that folder: its numbered pictures and its videos, and nothing else."""
    for pattern in FOLDERS:
        for folder in out.glob(pattern):
            if not folder.is_dir() or folder.is_symlink():
                continue
            for picture in folder.glob(PICTURE):
                picture.unlink()
            if not any(folder.iterdir()):
                folder.rmdir()
        for file in out.glob(pattern + ".mp4"):
            file.unlink()


def command(video):
    """Of a video in report.json: a player shows each picture as long as it was seen. Sides become even: most players know
    colours at half the resolution only."""
    folder = pathlib.Path(video["folder"])
    return ["ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{video['fps']:g}", "-i", str(folder / "%06d.png"),
            "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p", f"{folder}.mp4"]


def make(video):
    """Says what became of it. A video that cannot be made is no failure of the session: its pictures are there."""
    words = command(video)
    said = f"run: {video['seconds']:.1f} s of video: {video['pictures']} pictures in {video['folder']}"
    if video["repeated"]:
        said += f", {video['repeated']} of them repeated because frames came later"
    if video["dropped"]:
        said += f" ({video['dropped']} were dropped: pictures came faster than they could be written)"
    tell(said)
    if not shutil.which(words[0]):
        tell(f"run: ffmpeg is not installed; with it: {shlex.join(words)}")
        return
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        tell(f"run: {words[-1]}")
    else:
        reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        tell(f"run: {words[-1]} was not made: {reason}; the command: {shlex.join(words)}")


def make_all(videos):
    for video in videos:
        if video["pictures"]:
            make(video)
