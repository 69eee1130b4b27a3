"""The blog's skeleton: places of its joints, and an actor file of ours with its bone lengths."""
import json
import pickle

import numpy as np

METRES = 0.0254 / 0.45  # of a length in CMU's BVH files
# CMU's names in the blog's skeleton, by those of the ASF files.
CMU = {"root": "Hips", "lowerback": "LowerBack", "upperback": "Spine", "thorax": "Spine1", "lowerneck": "Neck",
       "upperneck": "Neck1", "head": "Head"}
SIDE = {"hipjoint": "{0}HipJoint", "femur": "{1}UpLeg", "tibia": "{1}Leg", "foot": "{1}Foot", "toes": "{1}ToeBase",
        "clavicle": "{1}Shoulder", "humerus": "{1}Arm", "radius": "{1}ForeArm", "wrist": "{1}Hand",
        "hand": "{1}FingerBase", "fingers": "{1}HandIndex1", "thumb": "{0}Thumb"}
for side, words in (("l", ("L", "Left")), ("r", ("R", "Right"))):
    CMU.update({side + bone: name.format(*words) for bone, name in SIDE.items()})
# Our joints that the blog's skeleton has; its hands are wrists, its feet ankles.
OURS = {"pelvis": "Hips", "spine": "Spine", "neck": "Neck1", "head": "Head"}
for side in ("left", "right"):
    OURS.update({f"{side}_{ours}": side.capitalize() + theirs for ours, theirs in {
        "shoulder": "Arm", "elbow": "ForeArm", "wrist": "Hand", "hip": "UpLeg", "knee": "Leg", "ankle": "Foot",
        "toe": "ToeBase"}.items()})
JOINTS = list(OURS)
TARGETS = ["head", "left_wrist", "right_wrist", "left_ankle", "right_ankle", "pelvis"]  # its six controllers
Z_UP = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # p_theirs = Z_UP @ p_ours: Blender's import of y-up files


class Skeleton:
    def __init__(self, clone):
        with open(clone / "data" / "skeleton.pt", "rb") as file:
            content = pickle.load(file)
        self.index = content["name_to_id"]
        table = np.array(content["kintree_table"])
        self.parents = {int(child): int(parent) for parent, child in table.T}
        self.rest = []  # places of joints at rest [m], y up
        frames = []
        for i, J in enumerate(np.array(content["J"])):
            frames.append(J if self.parents[i] < 0 else frames[self.parents[i]] @ J)
            self.rest.append(METRES * Z_UP.T @ frames[i][:3, 3])

    def joints(self, rotations):
        """Places [m] of JOINTS of a pose, y up, the pelvis where it is at rest."""
        local = {self.index[CMU[name]]: R for name, R in rotations.items()}
        points, turns = [], []
        for i, rest in enumerate(self.rest):
            parent = self.parents[i]
            points.append(rest if parent < 0 else points[parent] + turns[parent] @ (rest - self.rest[parent]))
            turns.append(local[i] if parent < 0 else turns[parent] @ local[i])
        return self.ours(points)

    def ours(self, points):
        """JOINTS of all its joints."""
        return np.array([points[self.index[OURS[joint]]] for joint in JOINTS])

    def actor(self, path):
        """Writes an actor file with these bone lengths."""
        rest = dict(zip(JOINTS, self.ours(self.rest)))

        def limb(a, b):
            return float(np.mean([np.linalg.norm(rest[f"{s}_{a}"] - rest[f"{s}_{b}"]) for s in ("left", "right")]))

        def below(upper, lower):
            return float(np.mean([rest[upper][1] - rest[f"{s}_{lower}"][1] for s in ("left", "right")]))
        lengths = {"upper_arm": limb("shoulder", "elbow"), "lower_arm": limb("elbow", "wrist"),
                   "upper_leg": limb("hip", "knee"), "lower_leg": limb("knee", "ankle"), "foot": limb("ankle", "toe"),
                   "shoulder_width": float(np.linalg.norm(rest["left_shoulder"] - rest["right_shoulder"])),
                   "hip_width": float(np.linalg.norm(rest["left_hip"] - rest["right_hip"])),
                   "torso": float(rest["neck"][1] - rest["pelvis"][1]),
                   "neck_to_head": float(np.linalg.norm(rest["head"] - rest["neck"])),
                   "spine": float(rest["spine"][1] - rest["pelvis"][1]),
                   "hip_drop": below("pelvis", "hip"), "shoulder_drop": below("neck", "shoulder")}
        stature = 1.17 * lengths["lower_leg"] + lengths["upper_leg"] + lengths["hip_drop"] + lengths["torso"] + 1.7 * lengths["neck_to_head"]
        path.write_text(json.dumps({"format": "depthmocap-actor", "version": 1, "stature_m": stature, "bone_lengths_m": lengths}))
        return path
