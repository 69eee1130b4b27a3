"""CMU's ASF and AMC files: for each of 31 joints its rotation in its parent's frame, all frames parallel in the rest pose, as in
the BVH files that CMU's motions are mostly used in."""
import dataclasses
import re

import numpy as np

METRES = 0.0254 / 0.45  # of a length in CMU's files


@dataclasses.dataclass
class Bone:
    name: str
    axis: np.ndarray  # 3x3, from the bone's own frame to the parallel ones
    end_m: np.ndarray  # from the bone's joint, at rest
    dofs: list
    parent: int = -1  # index of a joint; -1 of the root


def about(axis, angles):
    """Rotations (..., 3, 3) by angles [rad] about x, y or z."""
    i, j = [(1, 2), (2, 0), (0, 1)]["xyz".index(axis)]
    c, s = np.cos(angles), np.sin(angles)
    R = np.zeros((*np.shape(angles), 3, 3))
    R[..., :, :] = np.eye(3)
    R[..., i, i], R[..., i, j], R[..., j, i], R[..., j, j] = c, -s, s, c
    return R


def rotation(angles_deg, axes):
    """About the first axis first."""
    R = np.eye(3)
    for axis, angle in zip(axes, np.moveaxis(np.radians(angles_deg), -1, 0)):
        R = about(axis, angle) @ R
    return R


def euler_zyx(R):
    """Angles (z, y, x) [rad] with R = Rz Ry Rx."""
    return np.stack([np.arctan2(R[..., 1, 0], R[..., 0, 0]),
                     np.arcsin(np.clip(-R[..., 2, 0], -1, 1)),
                     np.arctan2(R[..., 2, 1], R[..., 2, 2])], axis=-1)


def read_asf(path):
    """Joints, parents first; the root is the first."""
    text = path.read_text()
    bones = [Bone("root", np.eye(3), np.zeros(3), [f"t{a}" for a in "xyz"] + [f"r{a}" for a in "xyz"])]
    for block in re.findall(r"begin\s+(id.*?)\bend\b", text, flags=re.DOTALL):
        words = {line.split()[0]: line.split()[1:] for line in block.splitlines() if line.split()}
        direction = np.array(words["direction"], float)
        bones.append(Bone(words["name"][0], rotation(np.array(words["axis"][:3], float), "xyz"),
                          METRES * float(words["length"][0]) * direction / np.linalg.norm(direction), words.get("dof", [])))
    index = {bone.name: i for i, bone in enumerate(bones)}
    for line in text.split(":hierarchy")[1].splitlines():
        names = line.split()
        if names and names[0] in index:
            for child in names[1:]:
                bones[index[child]].parent = index[names[0]]
    order = sorted(range(len(bones)), key=lambda i: depth(bones, i))
    place = {old: new for new, old in enumerate(order)}
    return [dataclasses.replace(bones[i], parent=place.get(bones[i].parent, -1)) for i in order]


def depth(bones, i):
    return 0 if bones[i].parent < 0 else 1 + depth(bones, bones[i].parent)


def read_amc(path, bones):
    """Rotations (frames, 31, 3, 3) of the joints."""
    values = {bone.name: [] for bone in bones}
    for line in path.read_text().splitlines():
        name, *numbers = line.split() or [""]
        if name in values:
            values[name].append(numbers)
    frames = len(values["root"])
    result = np.tile(np.eye(3), (frames, len(bones), 1, 1))
    for i, bone in enumerate(bones):
        dofs = [k for k, dof in enumerate(bone.dofs) if dof[0] == "r"]
        if not dofs:
            continue
        angles = np.array(values[bone.name], float)[:, dofs]
        result[:, i] = bone.axis @ rotation(angles, [bone.dofs[k][1] for k in dofs]) @ bone.axis.T
    return result


def without_heading(R):
    """Rotations of the root that face +z."""
    return about("y", -np.arctan2(R[..., 0, 2], R[..., 2, 2])) @ R
