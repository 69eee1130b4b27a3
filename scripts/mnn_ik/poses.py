"""The experiment's poses: three of five frames of most motions to learn, two to test, and motions that are held out."""
import dataclasses
import pathlib
import re
import sys

import numpy as np

from mnn_ik import motions

LEARNED_OF_FIVE = (0, 2, 4)  # the paper's split: evenly sampled
SKELETON = "02"  # whose bones all poses are put on


@dataclasses.dataclass
class Poses:
    """Angles (n, 93) [rad] and the skeleton: parents (31), ends [m] (31, 3) from each joint to its children."""
    learned: np.ndarray
    frames: np.ndarray  # the other frames of the motions that were learned
    unseen: np.ndarray  # of the motions that were not
    parents: np.ndarray
    ends_m: np.ndarray


def held_out(script):
    """The motions that scripts/measure-ik holds out."""
    return set(re.search(r"held_out=\((.*?)\)", script.read_text()).group(1).split())


def read(data, script, cache):
    """From the data folder; what was read is kept in `cache`."""
    if not cache.exists():
        gather(data, held_out(script), cache)
    return Poses(**np.load(cache))


def gather(data, without, cache):
    folders = sorted(path for path in (data / "cmu").glob("*") if path.is_dir())
    if not folders:
        sys.exit(f"no motions in {data / 'cmu'}: set DEPTHMOCAP_DATA to the folder that has cmu/")
    learned, frames, unseen = [], [], []
    for folder in folders:
        bones = motions.read_asf(folder / f"{folder.name}.asf")
        if folder.name == SKELETON:
            skeleton = bones
        for file in sorted(folder.glob("*.amc")):
            R = motions.read_amc(file, bones)
            R[:, 0] = motions.without_heading(R[:, 0])
            angles = motions.euler_zyx(R).reshape(len(R), -1)
            if file.stem in without:
                unseen.append(angles)
                continue
            chosen = np.isin(np.arange(len(angles)) % 5, LEARNED_OF_FIVE)
            learned.append(angles[chosen])
            frames.append(angles[~chosen])
    cache.parent.mkdir(parents=True, exist_ok=True)
    np.savez(cache, learned=np.concatenate(learned), frames=np.concatenate(frames), unseen=np.concatenate(unseen),
             parents=np.array([bone.parent for bone in skeleton]), ends_m=np.array([bone.end_m for bone in skeleton]))


def data_folder(root, environment):
    return pathlib.Path(environment.get("DEPTHMOCAP_DATA", root.parent / "shared" / "data"))
