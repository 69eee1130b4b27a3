"""Reads what depthmocap writes of a recording: BVH, and joints with poses as CSV. Knows nothing of Blender but its vectors."""
import csv
import re
from dataclasses import dataclass
from math import radians
from pathlib import Path

import numpy
from mathutils import Matrix, Quaternion, Vector

from .rig import Pose, Rig


class FileError(Exception):
    """What to tell the user."""


@dataclass
class Motion:
    rig: Rig
    poses: list
    times_s: list


def read_motion(path, joints_path="", person=1):
    """The Motion in a .bvh file, or in a pose file and its joints file."""
    path = Path(path)
    try:
        if path.suffix.lower() == ".bvh":
            return read_bvh(path)
        return read_tables(path, joints_path, person)
    except OSError as error:
        raise FileError(f"{path.name}: {error.strerror or error}") from error
    except (ValueError, IndexError, KeyError, StopIteration) as error:
        raise FileError(f"{path.name} is damaged or no file of depthmocap ({error})") from error


# BVH


@dataclass
class Channels:
    bone: str
    names: list  # "Xposition", "Zrotation", ... in the order of the rows


def read_bvh(path):
    words = iter(path.read_text(encoding="utf-8", errors="replace").split())
    rig, channels = read_hierarchy(words)
    for expected in ("Frames:", None, "Frame", "Time:"):
        word = next(words)
        if expected is None:
            count = int(word)
        elif word != expected:
            raise ValueError(f"{expected} is missing")
    frame_s = float(next(words))
    numbers = [float(word) for word in words]
    width = sum(len(each.names) for each in channels)
    if frame_s <= 0 or len(numbers) != count * width or count == 0:
        raise ValueError(f"{count} rows of {width} numbers are announced")
    scale = unit_of(rig)
    for table in (rig.offsets, rig.tips):
        for bone in table:
            table[bone] = scale * table[bone]
    poses = [pose_of(rig, channels, numbers[row * width:(row + 1) * width], scale) for row in range(count)]
    root = next(iter(rig.parents))
    if rig.offsets[root].length == 0:  # hips that rest on the floor
        rig.offsets[root] = Vector((0, -lowest(rig), 0))
    return Motion(rig, poses, [row * frame_s for row in range(count)])


def read_hierarchy(words):
    rig, channels, stack, name = Rig({}, {}), [], [], None
    for word in words:
        if word in ("ROOT", "JOINT"):
            name = next(words)
            rig.parents[name] = stack[-1] if stack else None
        elif word == "End":
            next(words)
            name = None
        elif word == "{":
            stack.append(name)
        elif word == "}":
            stack.pop()
        elif word == "OFFSET":
            offset = Vector([float(next(words)) for _ in range(3)])
            if stack[-1] is None:
                rig.tips[stack[-2]] = offset
            else:
                rig.offsets[stack[-1]] = offset
        elif word == "CHANNELS":
            channels.append(Channels(stack[-1], [next(words) for _ in range(int(next(words)))]))
        elif word == "MOTION":
            return rig, channels
        elif word != "HIERARCHY":
            raise ValueError(f"{word} stands where it should not")
    raise ValueError("MOTION is missing")


def lowest(rig):
    low, places = 0.0, {}
    for bone, parent in rig.parents.items():
        places[bone] = rig.offsets[bone] + (places[parent] if parent else Vector())
        low = min(low, places[bone].y)
    return low


def unit_of(rig):
    """Metres in the file's unit: a person is higher than 3 units only in centimetres."""
    return 0.01 if -lowest(rig) > 3 else 1.0


def pose_of(rig, channels, row, scale):
    pose, at = Pose({}, {}), 0
    for each in channels:
        turn, moved = Matrix.Identity(3), None
        for name in each.names:
            value, at = row[at], at + 1
            axis = "XYZ".index(name[0])
            if name.endswith("rotation"):
                turn = turn @ Matrix.Rotation(radians(value), 3, name[0])
            else:
                moved = moved or Vector(rig.offsets[each.bone])
                moved[axis] = scale * value
        pose.rotations[each.bone] = turn.to_quaternion()
        if moved is not None:
            pose.offsets[each.bone] = moved
    return pose


# CSV

# Our bone: its name in pose files, its parent, and the kind of its degrees of freedom (libtracker/include/depthmocap/pose.h).
BONES = {
    "Hips": ("root", None, "heading"), "Spine": ("upperback", "Hips", "twist_y"), "Neck": ("neck", "Spine", "swing"),
    "Head": ("head", "Neck", "swing"),
    "LeftShoulder": ("lclavicle", "Spine", "swing"), "LeftArm": ("lhumerus", "LeftShoulder", "twist_x"),
    "LeftForeArm": ("lradius", "LeftArm", "swing"), "RightShoulder": ("rclavicle", "Spine", "swing"),
    "RightArm": ("rhumerus", "RightShoulder", "twist_x"), "RightForeArm": ("rradius", "RightArm", "swing"),
    "LeftUpLeg": ("lfemur", "Hips", "twist_y"), "LeftLeg": ("ltibia", "LeftUpLeg", "swing"), "LeftFoot": ("lfoot", "LeftLeg", "swing"),
    "RightUpLeg": ("rfemur", "Hips", "twist_y"), "RightLeg": ("rtibia", "RightUpLeg", "swing"), "RightFoot": ("rfoot", "RightLeg", "swing"),
}
# Joints and the bones, from the hips on, whose offsets add up to them; the last may be a tip that does not turn.
JOINT_CHAINS = {
    "spine": ["Hips", "Spine"], "neck": ["Spine", "Neck"], "head": ["Neck", "Head", "HeadCentre"],
    "left_shoulder": ["Spine", "LeftShoulder", "LeftArm"], "left_elbow": ["LeftArm", "LeftForeArm"], "left_wrist": ["LeftForeArm", "LeftHand"],
    "right_shoulder": ["Spine", "RightShoulder", "RightArm"], "right_elbow": ["RightArm", "RightForeArm"],
    "right_wrist": ["RightForeArm", "RightHand"],
    "left_hip": ["Hips", "LeftUpLeg"], "left_knee": ["LeftUpLeg", "LeftLeg"], "left_ankle": ["LeftLeg", "LeftFoot"],
    "left_toe": ["LeftFoot", "LeftToeBase"],
    "right_hip": ["Hips", "RightUpLeg"], "right_knee": ["RightUpLeg", "RightLeg"], "right_ankle": ["RightLeg", "RightFoot"],
    "right_toe": ["RightFoot", "RightToeBase"],
}
JOINT_OF = {"Hips": "pelvis", "Spine": "spine", "Neck": "neck", "LeftArm": "left_shoulder", "LeftForeArm": "left_elbow",
            "RightArm": "right_shoulder", "RightForeArm": "right_elbow", "LeftUpLeg": "left_hip", "LeftLeg": "left_knee",
            "LeftFoot": "left_ankle", "RightUpLeg": "right_hip", "RightLeg": "right_knee", "RightFoot": "right_ankle"}


def read_tables(path, joints_path, person):
    rows, axes = read_table(path, person)
    if not rows or "root_tx" not in rows[0]:
        raise FileError(f"{path.name} has no poses: choose a file of --pose, or of ik")
    if "pelvis_x" in rows[0]:  # of `ik`: joints and poses in one file, both in the world
        joint_rows, axes = rows, Matrix.Identity(3)
    else:
        joint_rows = read_joints(path, joints_path, person)
    key = "frame" if "frame" in rows[0] else "pose_id"
    joints_at = {row[key]: row for row in joint_rows if row.get("pelvis_x")}
    pairs = [(row, joints_at[row[key]]) for row in rows if row[key] in joints_at]
    if not pairs:
        raise FileError(f"{path.name} and its joints file have no frame in common")
    poses = [Pose(turns_of(row), {"Hips": Vector([float(row[f"root_t{axis}"]) for axis in "xyz"])}) for row, _ in pairs]
    offsets = fitted_offsets(poses, [{name: axes @ point(row, name) for name in [*JOINT_CHAINS, "pelvis"]} for _, row in pairs])
    parents = {bone: parent for bone, (_, parent, _) in BONES.items()}
    for side in ("Left", "Right"):
        parents[f"{side}Hand"], parents[f"{side}ToeBase"] = f"{side}ForeArm", f"{side}Foot"
    rig = Rig(parents, {bone: offsets[bone] for bone in parents if bone != "Hips"}, {"Head": 2 * offsets["HeadCentre"]})
    rig.offsets = {"Hips": Vector(), **rig.offsets}
    rig.offsets["Hips"] = Vector((0, -lowest(rig), 0))
    return Motion(rig, poses, [float(row["time_s"]) for row, _ in pairs])


def read_table(path, person):
    """Rows as dictionaries, of one person, and the turn (Matrix 3 x 3) from the camera's axes to the world."""
    axes, lines = Matrix(((1, 0, 0), (0, -1, 0), (0, 0, -1))), []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            if lines:
                raise FileError(f"{path.name}: the camera was turned in between, which cannot be imported")
            axes = camera_axes(line, axes)
        else:
            lines.append(line)
    return [row for row in csv.DictReader(lines) if row.get("person") in (None, str(person))], axes


def camera_axes(comment, default):
    """Of a pose file's comment, p_camera = (a x + b y + c z, ...): the turn from the camera to the world."""
    found = re.search(r"p_camera = \(([^)]*)\)", comment)
    if not found:
        return default
    rows = []
    for text in found[1].split(","):
        terms = {axis: sign + number for sign, number, axis in re.findall(r"([+-]?)\s*([0-9.]*)\s*([xyz])", text)}
        rows.append([float(terms[a] + "1" if terms[a] in ("", "+", "-") else terms[a]) if a in terms else 0.0 for a in "xyz"])
    return Matrix(rows).transposed()


def read_joints(path, joints_path, person):
    joints_path = Path(joints_path) if joints_path else path.with_name("joints.csv")
    if not joints_path.is_file():
        raise FileError(f"{path.name} has no lengths: choose the joints file of the same run")
    rows, _ = read_table(joints_path, person)
    if not rows or "pelvis_x" not in rows[0]:
        raise FileError(f"{joints_path.name} is no joints file")
    return rows


def point(row, joint):
    return Vector([float(row[f"{joint}_{axis}"]) for axis in "xyz"])


def rotation_vector(x, y, z):
    w = Vector((x, y, z))
    return Quaternion(w.normalized(), w.length) if w.length > 0 else Quaternion()


def turns_of(row):
    """Bone to Quaternion in its parent, by the swings and twists of a pose file's row."""
    turns = {}
    for bone, (name, _, kind) in BONES.items():
        x, y, z = (float(row.get(f"{name}_r{axis}") or 0) for axis in "xyz")
        if kind == "heading":
            turns[bone] = rotation_vector(0, y, 0) @ rotation_vector(x, 0, z)
        elif kind == "twist_y":
            turns[bone] = rotation_vector(x, 0, z) @ rotation_vector(0, y, 0)
        elif kind == "twist_x":
            turns[bone] = rotation_vector(0, y, z) @ rotation_vector(x, 0, 0)
        else:
            turns[bone] = rotation_vector(x, y, z)
    return turns


def fitted_offsets(poses, joints):
    """Bone to Vector [m]: the offsets that lead to the joints of all frames, by least squares."""
    frames = []
    for pose in poses:
        turns = {}
        for bone, (_, parent, _) in BONES.items():
            local = pose.rotations[bone].to_matrix()
            turns[bone] = turns[parent] @ local if parent else local
        frames.append(turns)
    offsets = {}
    for joint, chain in JOINT_CHAINS.items():
        # joint - joint of the chain's first bone = sum of turn of the bone before * offset
        A = numpy.array([numpy.hstack([numpy.array(turns[bone]) for bone in chain[:-1]]) for turns in frames])
        b = numpy.array([list(each[joint] - each[JOINT_OF[chain[0]]]) for each in joints])
        solved, *_ = numpy.linalg.lstsq(A.reshape(-1, 3 * (len(chain) - 1)), b.reshape(-1), rcond=1e-6)
        for bone, offset in zip(chain[1:], solved.reshape(-1, 3)):
            offsets[bone] = Vector(offset)
    return offsets
