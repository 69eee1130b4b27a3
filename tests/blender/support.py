"""What the tests share that run inside Blender: the add-on, the server, figures."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["DEPTHMOCAP_PROGRAM"]
SERVER = os.environ.get("DEPTHMOCAP_SERVER", "")


def fresh_scene():
    """An empty file with the add-on switched on, as its zip was installed."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if "depthmocap" not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module="depthmocap")
    bpy.context.scene.depthmocap.server = SERVER
    return bpy.context.scene


def run_program(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True)


def ask(request):
    from depthmocap.ik_client import IkConnection
    connection = IkConnection(SERVER)
    answer = connection.ask(request)
    connection.close()
    return answer


def joints_of(armature):
    """Our joints of a posed armature by name [m], y up: bones' heads, and half way up the head."""
    from depthmocap.armature import place_of
    from depthmocap.rig import to_ours
    bones = {
        "pelvis": "Hips", "spine": "Spine", "neck": "Neck",
        "left_shoulder": "LeftArm", "left_elbow": "LeftForeArm", "left_wrist": "LeftHand",
        "right_shoulder": "RightArm", "right_elbow": "RightForeArm", "right_wrist": "RightHand",
        "left_hip": "LeftUpLeg", "left_knee": "LeftLeg", "left_ankle": "LeftFoot", "left_toe": "LeftToeBase",
        "right_hip": "RightUpLeg", "right_knee": "RightLeg", "right_ankle": "RightFoot", "right_toe": "RightToeBase"}
    bpy.context.view_layer.update()
    joints = {joint: place_of(armature, bone) for joint, bone in bones.items()}
    head = armature.pose.bones["Head"]
    joints["head"] = to_ours((head.head + head.tail) / 2)
    return joints


def farthest_mm(joints, expected):
    """The largest distance between joints of the same name, in millimetres."""
    from mathutils import Vector
    return 1000 * max((place - Vector(expected[joint])).length for joint, place in joints.items())


def main():
    """Runs the tests of the calling file; Blender's exit code says whether they passed."""
    program = unittest.main(module="__main__", argv=["blender"], verbosity=2, exit=False)
    sys.stdout.flush()
    sys.stderr.flush()
    if not program.result.wasSuccessful() or program.result.testsRun == 0:
        os._exit(1)
