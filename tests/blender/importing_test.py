"""Results of a recording in every form: each joint in every frame, and the recording's rate."""
import csv
import tempfile
import unittest
from pathlib import Path

import bpy
import support
from mathutils import Vector

NEAR_MM = 1.0
WALK = support.ROOT / "recordings/walk"


class Importing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        support.run_program("replay", WALK, "--joints", cls.path / "joints.csv", "--pose", cls.path / "pose.csv",
                            "--bvh", cls.path / "walk.bvh", "--gltf", cls.path / "walk.glb", "--origin", "camera")
        # As live: the body is fitted while it is tracked.
        (cls.path / "growing").mkdir()
        support.run_program("replay", WALK, "--passes", "1", "--joints", cls.path / "growing/joints.csv", "--pose",
                            cls.path / "growing/pose.csv", "--bvh", cls.path / "growing/walk.bvh", "--origin", "camera",
                            "--bvh-moving")
        cls.rows, cls.growing_rows = (cls.rows_of(cls.path / name) for name in ("joints.csv", "growing/joints.csv"))

    @staticmethod
    def rows_of(path):
        with open(path, newline="") as file:
            return [row for row in csv.DictReader(file) if row["state"] != "lost"]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.scene = support.fresh_scene()
        self.scene.render.fps = 24  # Blender's own; the recording has 30

    def import_file(self, name):
        self.assertEqual(bpy.ops.depthmocap.import_motion(filepath=str(self.path / name)), {"FINISHED"})
        self.assertEqual((self.scene.render.fps, self.scene.render.fps_base), (30, 1))
        return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")

    def farthest(self, armature, joints_of=support.joints_of):
        worst, start = 0.0, self.scene.frame_start
        for row in self.rows:
            self.scene.frame_set(start + round(30 * (float(row["time_s"]) - float(self.rows[0]["time_s"]))))
            camera = {joint: [float(row[f"{joint}_{axis}"]) for axis in "xyz"] for joint in joints_of(armature)}
            expected = {joint: Vector((x, -y, -z)) for joint, (x, y, z) in camera.items()}
            worst = max(worst, support.farthest_mm(joints_of(armature), expected))
        print(f"import: {len(self.rows)} frames, joints at most {worst:.3f} mm from the joints file")
        return worst

    def test_bvh(self):
        self.assertLess(self.farthest(self.import_file("walk.bvh")), NEAR_MM)

    def test_poses_with_joints(self):
        self.assertLess(self.farthest(self.import_file("pose.csv")), NEAR_MM)

    def test_bvh_of_a_body_that_grows(self):
        def joints(armature):  # the crown is a bone of its own in a file whose bones move
            places = support.joints_of(armature)
            from depthmocap.armature import place_of
            places["head"] = (place_of(armature, "Head") + place_of(armature, "HeadTop_End")) / 2
            return places
        # Its size is that of each frame, its proportions are those of the last one.
        self.rows = self.growing_rows
        self.assertLess(self.farthest(self.import_file("growing/walk.bvh"), joints), 20)

    def test_poses_of_a_body_that_grows(self):
        # Its mean is imported.
        self.rows = self.growing_rows
        armature = self.import_file("growing/pose.csv")
        self.scene.frame_set(self.scene.frame_end)
        self.assertLess(self.farthest(armature), 30)

    def test_poses_with_joints_of_one_size(self):
        import shutil
        (self.path / "truth").mkdir()
        for name in ("joints.csv", "pose.csv"):
            shutil.copy(WALK / "truth" / name, self.path / "truth" / name)
        self.rows = self.rows_of(self.path / "truth/joints.csv")
        self.assertLess(self.farthest(self.import_file("truth/pose.csv")), NEAR_MM)

    def test_gltf(self):
        armature = self.import_file("walk.glb")
        first, last = armature.animation_data.action.frame_range
        self.assertEqual(round(last - first), len(self.rows) - 1)

    def test_what_is_no_result_is_said(self):
        for name, text, said in (("a.bvh", "HIERARCHY\nROOT a\n{\n", "MOTION is missing"), ("b.csv", "x,y\n1,2\n", "no poses"),
                                 ("c.glb", "glTF", "damaged"), ("d.bvh", None, "No such file"),
                                 ("e.csv", "frame,time_s,root_tx\n0,0,0\n", "no frame in common|damaged")):
            if text is not None:
                (self.path / name).write_text(text)
            with self.assertRaisesRegex(RuntimeError, said):
                bpy.ops.depthmocap.import_motion(filepath=str(self.path / name))


support.main()
