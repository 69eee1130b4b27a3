"""Retargeting onto the armatures of other programs: hands and feet where ours are, in lengths of the character's limbs."""
import tempfile
import unittest
from pathlib import Path

import bpy
import characters
import support

NEAR_M = 0.02
EVERY = 5  # frames of which one is measured
BOXING = support.ROOT / "recordings/boxing"


class Retarget(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.bvh = Path(cls.folder.name) / "boxing.bvh"
        support.run_program("replay", BOXING, "--bvh", cls.bvh)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.scene = support.fresh_scene()
        bpy.ops.depthmocap.import_motion(filepath=str(self.bvh))
        self.source = self.scene.depthmocap.source

    def bake(self, target, preset):
        self.scene.depthmocap.target, self.scene.depthmocap.preset = target, preset
        self.assertEqual(bpy.ops.depthmocap.retarget(), {"FINISHED"})

    def check(self, target, names):
        """`names`: the target's bones of a shoulder, a hand, a hip and a foot, with {side} for each side."""
        worst = {"hands": 0.0, "feet": 0.0}
        for side, theirs in (("Left", names["Left"]), ("Right", names["Right"])):
            ours = [f"{side}{bone}" for bone in ("Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot")]
            rest = {bone: self.source.data.bones[bone].head_local.copy() for bone in ours}
            their_rest = [target.matrix_world @ target.data.bones[bone].head_local for bone in theirs]
            arm, leg = (sum((their_rest[i + 1] - their_rest[i]).length for i in (k, k + 1)) /
                        sum((rest[ours[i + 1]] - rest[ours[i]]).length for i in (k, k + 1)) for k in (0, 3))
            for frame in range(self.scene.frame_start, self.scene.frame_end + 1, EVERY):
                self.scene.frame_set(frame)
                bones = {bone: self.source.pose.bones[bone].head.copy() for bone in ours}
                places = [target.matrix_world @ target.pose.bones[bone].head for bone in theirs]
                hand = places[0] + arm * (bones[ours[2]] - bones[ours[0]])
                foot = leg * bones[ours[5]]
                foot.z += their_rest[5].z - leg * rest[ours[5]].z
                worst["hands"] = max(worst["hands"], (places[2] - hand).length)
                worst["feet"] = max(worst["feet"], (places[5] - foot).length)
        print(f"retarget to {target.name}: " + ", ".join(f"{what} at most {1000 * value:.1f} mm off" for what, value in worst.items()))
        for what, value in worst.items():
            self.assertLess(value, NEAR_M, what)

    def test_mixamo(self):
        target = characters.mixamo()
        self.bake(target, "Mixamo")
        self.check(target, {side: [f"mixamorig:{side}{bone}" for bone in ("Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot")]
                            for side in ("Left", "Right")})

    def test_vrm(self):
        target = characters.vrm()
        self.bake(target, "VRM")
        limb = ("UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot")
        self.check(target, {side: [f"J_Bip_{side[0]}_{bone}" for bone in limb] for side in ("Left", "Right")})

    def test_rigify(self):
        try:
            target = characters.rigify()
        except (RuntimeError, AttributeError, ModuleNotFoundError) as error:
            self.skipTest(f"this Blender has no Rigify: {error}")
        self.bake(target, "Rigify")
        # What the mesh follows, not the controls.
        limb = ("upper_arm", "forearm", "hand", "thigh", "shin", "foot")
        self.check(target, {side: [f"DEF-{bone}.{side[0]}" for bone in limb] for side in ("Left", "Right")})

    def test_a_rest_pose_gives_our_t_pose(self):
        target = characters.mixamo()
        self.source.animation_data_clear()
        for bone in self.source.pose.bones:
            bone.rotation_quaternion, bone.location = (1, 0, 0, 0), (0, 0, 0)
        bpy.context.view_layer.update()
        self.bake(target, "Mixamo")
        bpy.context.view_layer.update()
        heads = {bone: target.matrix_world @ target.pose.bones[f"mixamorig:{bone}"].head for bone in ("LeftArm", "LeftForeArm", "LeftHand")}
        along = heads["LeftHand"] - heads["LeftArm"]
        self.assertLess(abs(along.z) + abs(along.y), 0.03)
        self.assertGreater(along.x, 0.5)

    def test_a_wrong_armature_is_said(self):
        self.scene.depthmocap.target = self.source
        self.scene.depthmocap.preset = "VRM"
        with self.assertRaisesRegex(RuntimeError, "has no bone J_Bip_C_Hips: is it a VRM armature"):
            bpy.ops.depthmocap.retarget()


support.main()
