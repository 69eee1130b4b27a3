"""What goes wrong around a program that writes: a full disk, a folder that may not be written to, a sudden end."""

import contextlib
import os
import subprocess
import sys

ALONE = "DEPTHMOCAP_BREAKING_ALONE"  # set where mounts are this process' own


def see_own_mounts():
    """Starts the script again where its mounts are its own and end with it; False where this computer allows none."""
    if ALONE in os.environ:
        return True
    unshare = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--mount", "--map-root-user"]
    if subprocess.run([*unshare, "true"], capture_output=True, check=False).returncode != 0:
        return False
    os.environ[ALONE] = "1"
    os.execvp("unshare", [*unshare, sys.executable, *sys.argv])


@contextlib.contextmanager
def small_disk(folder, size_kb):
    """`folder` is a disk of that size, in memory."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size_kb}k", "tmpfs", folder], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)


@contextlib.contextmanager
def read_only(folder):
    """Nothing under `folder` can be written."""
    subprocess.run(["mount", "--bind", folder, folder], check=True)
    subprocess.run(["mount", "-o", "remount,bind,ro", folder], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)


def temporaries(folder):
    return [p.name for p in folder.iterdir() if ".tmp" in p.name or p.name.endswith(".partial")]
