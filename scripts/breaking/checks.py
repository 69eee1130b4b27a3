"""What the campaigns of scripts/break* compare."""

import hashlib
import os


def state(folder):
    """A hash of every file under a folder, by its path; links and folders by their kind."""
    found = {}
    for path in sorted(folder.rglob("*")):
        key = str(path.relative_to(folder))
        if path.is_symlink():
            found[key] = "link " + os.readlink(path)
        else:
            found[key] = "folder" if path.is_dir() else hashlib.sha256(path.read_bytes()).hexdigest()
    return found
