"""Where an entry runs: an ordinary folder, one that cannot be written, a full disk, another user's eyes."""

import contextlib
import os
import shutil
import subprocess
from pathlib import Path


def may_mount():
    return os.geteuid() == 0 and shutil.which("mount") is not None


def _mount(*arguments):
    return subprocess.run(["mount", *arguments], capture_output=True).returncode == 0


@contextlib.contextmanager
def prepared(entry, folder):
    """(folder to work in, words before the command, why it cannot be done or None)"""
    if entry.place == "nobody":
        # root may write everywhere; for others read-only folders are just that.
        problem = None if os.geteuid() != 0 or shutil.which("setpriv") else "needs setpriv"
        prefix = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.geteuid() == 0 else []
        yield folder, prefix, problem
        return
    if entry.place.startswith("tmpfs"):
        size = entry.place.partition(" ")[2]
        if not may_mount() or not _mount("-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)):
            yield folder, [], "needs the right to mount"
            return
        try:
            yield folder, [], None
        finally:
            subprocess.run(["umount", str(folder)], check=False)
        return
    if entry.place == "prlimit 0" and "TSAN_OPTIONS" in os.environ:
        yield folder, [], "the thread sanitizer itself writes a file as it starts"
        return
    if entry.place.startswith("prlimit"):
        yield folder, ["prlimit", f"--fsize={entry.place.partition(' ')[2]}"], None
        return
    yield folder, [], None


@contextlib.contextmanager
def as_wanted(entry, folder):
    """The last touch, after the files are laid out."""
    if entry.place == "nobody":
        locked = Path(folder) / "locked"
        if locked.exists():
            locked.chmod(0o555)
        for secret in folder.rglob("secret*"):
            secret.chmod(0o000)
    yield
