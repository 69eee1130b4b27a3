"""Pose by handles: against the server's own answers, with undo, pins, and without a server."""
import time
import unittest

import bpy
import support
from mathutils import Vector

NEAR_MM = 1.0


def drag(scene, handle, by, steps=10):
    """Moves a handle in steps, as a hand does, and lets Blender's timer go on until the body stands."""
    from depthmocap.posing import Posing
    for _ in range(steps):
        handle.location = handle.location + Vector(by) / steps
        bpy.context.view_layer.update()
        Posing.current.tick(bpy.context)
        time.sleep(1 / 60)
    settle()


def settle(longest_s=5):
    from depthmocap.posing import Posing
    until = time.monotonic() + longest_s
    while time.monotonic() < until:
        bpy.context.view_layer.update()
        Posing.current.tick(bpy.context)
        if not Posing.current.is_dragging:
            return
        time.sleep(1 / 60)
    raise AssertionError("the drag does not end")


class Posing(unittest.TestCase):
    def setUp(self):
        self.scene = support.fresh_scene()
        self.assertEqual(bpy.ops.depthmocap.add_body(), {"FINISHED"})
        self.body = self.scene.depthmocap.source

    def tearDown(self):
        bpy.ops.depthmocap.pose_stop()

    def handle(self, joint):
        from depthmocap.posing import JOINT, handles_of
        return next(handle for handle in handles_of(self.body) if handle[JOINT] == joint)

    def test_a_new_body_stands_on_the_floor_in_a_t_pose(self):
        joints = support.joints_of(self.body)
        self.assertLess(abs(joints["left_toe"].y), 0.001)
        self.assertLess(abs(joints["left_wrist"].y - joints["left_shoulder"].y), 0.001)
        self.assertGreater(joints["left_wrist"].x, 0.5)
        self.assertEqual(len(self.body.children), 6)

    def test_the_body_is_where_the_server_says(self):
        from depthmocap.posing import POSE, request_of
        wrist = self.handle("left_wrist")
        drag(self.scene, wrist, (-0.2, -0.3, 0.2))
        # The last answer, asked for once more: the same request gives the same pose.
        start = list(self.body[POSE])
        request = request_of(self.scene.depthmocap, self.body, {wrist.name})
        self.assertEqual(request["start"], start)
        answer = support.ask(request)
        from depthmocap.posing import apply
        apply(self.body, answer, {wrist.name})
        self.assertLess(support.farthest_mm(support.joints_of(self.body), answer["joints"]), NEAR_MM)
        self.assertLess((support.joints_of(self.body)["left_wrist"] - Vector(request["targets"]["left_wrist"])).length, 0.02)

    def test_pins_hold_and_free_handles_follow(self):
        ankles = [support.joints_of(self.body)[f"{side}_ankle"] for side in ("left", "right")]
        drag(self.scene, self.handle("pelvis"), (0, 0, -0.25))
        joints = support.joints_of(self.body)
        for side, before in zip(("left", "right"), ankles):
            self.assertLess((joints[f"{side}_ankle"] - before).length, 0.02)
        from depthmocap.rig import to_blender
        for joint in ("head", "left_wrist"):
            self.assertLess((self.handle(joint).location - to_blender(joints[joint])).length, 0.001)
        self.assertLess(joints["head"].y, 1.5)

    def test_keys_are_set_on_demand_and_after_each_drag(self):
        bpy.context.view_layer.objects.active = self.body
        self.scene.frame_set(5)
        self.assertEqual(bpy.ops.depthmocap.key_pose(), {"FINISHED"})
        self.assertEqual(self.body.animation_data.action.frame_range[0], 5)
        self.scene.depthmocap.auto_key = True
        self.scene.frame_set(20)
        drag(self.scene, self.handle("head"), (0, -0.1, -0.05))
        self.assertEqual(self.body.animation_data.action.frame_range[1], 20)

    def test_undo_brings_body_and_handles_back(self):
        from depthmocap.posing import POSE
        if not bpy.ops.ed.undo_push.poll():
            self.skipTest("this Blender has no undo without a screen")
        bpy.ops.ed.undo_push(message="before")
        before, name, wrist = list(self.body[POSE]), self.body.name, self.handle("left_wrist").name
        place = self.handle("left_wrist").location.copy()
        drag(self.scene, self.handle("left_wrist"), (0, -0.3, 0.1))
        self.assertNotEqual(list(bpy.data.objects[name][POSE]), before)
        bpy.ops.ed.undo()
        self.body, self.scene = bpy.data.objects[name], bpy.context.scene
        self.assertEqual(list(self.body[POSE]), before)
        self.assertLess((bpy.data.objects[wrist].location - place).length, 1e-6)
        from depthmocap.posing import Posing
        Posing.current.tick(bpy.context)
        self.assertFalse(Posing.current.is_dragging, "undo asks for nothing")


class Versions(unittest.TestCase):
    def test_add_on_and_program_are_of_one_version(self):
        support.fresh_scene()
        import re
        import depthmocap
        from depthmocap.ik_client import IkConnection
        connection = IkConnection(support.SERVER)
        connection.open()
        self.addCleanup(connection.close)
        manifest = (support.ROOT / "apps/blender/depthmocap/blender_manifest.toml").read_text()
        self.assertEqual(connection.version, ".".join(map(str, depthmocap.bl_info["version"])))
        self.assertEqual(connection.version, re.search(r'^version = "(.*)"', manifest, re.MULTILINE)[1])


class BonesOfTheServer(unittest.TestCase):
    def test_an_armature_of_the_answer_stands_where_the_joints_are(self):
        support.fresh_scene()
        answer = support.ask({"targets": {"left_wrist": [0.4, 1.3, 0.3], "right_ankle": [-0.2, 0.3, 0.2], "head": [0, 1.6, 0.1]},
                              "bones": "blender"})
        data = bpy.data.armatures.new("answer")
        armature = bpy.data.objects.new("answer", data)
        bpy.context.collection.objects.link(armature)
        bpy.context.view_layer.objects.active = armature
        bpy.ops.object.mode_set(mode="EDIT")
        for name, bone in answer["bones"].items():
            edit = data.edit_bones.new(name)
            edit.head, edit.tail = bone["head"], bone["tail"]
            edit.align_roll(Vector(bone["z_axis"]))
        for name, bone in answer["bones"].items():
            data.edit_bones[name].parent = data.edit_bones[bone["parent"]] if "parent" in bone else None
        bpy.ops.object.mode_set(mode="OBJECT")
        for name, bone in answer["bones"].items():
            posed = armature.pose.bones[name]
            posed.rotation_mode = "QUATERNION"
            posed.location, posed.rotation_quaternion = bone["location"], bone["rotation_quaternion"]
        self.assertLess(support.farthest_mm(support.joints_of(armature), answer["joints"]), NEAR_MM)


class WithoutServer(unittest.TestCase):
    def test_a_missing_server_is_said_and_does_not_hang(self):
        scene = support.fresh_scene()
        scene.depthmocap.server = "http://127.0.0.1:9"
        start = time.monotonic()
        with self.assertRaisesRegex(RuntimeError, "There is no server at 127.0.0.1:9"):
            bpy.ops.depthmocap.add_body()
        self.assertLess(time.monotonic() - start, 2)

    def test_a_server_that_goes_is_said_and_comes_back(self):
        from depthmocap.posing import Posing
        support.fresh_scene()
        bpy.ops.depthmocap.add_body()
        good = Posing.current.client.connection.address
        Posing.current.client.connection.close()
        Posing.current.client.connection.address = ("127.0.0.1", 9)
        Posing.current.client.submit({"targets": {"head": [0, 1.6, 0]}})
        time.sleep(0.3)
        self.assertIn("There is no server", Posing.current.client.error)
        Posing.current.client.connection.address = good
        Posing.current.client.submit({"targets": {"head": [0, 1.6, 0]}})
        time.sleep(0.5)
        self.assertEqual(Posing.current.client.error, "")
        bpy.ops.depthmocap.pose_stop()

    def test_another_program_and_an_old_server_are_told_apart(self):
        import http.server
        import threading
        from depthmocap.ik_client import IkConnection, ServerError
        for body, said in (('{"status":"ok"}', "version unknown"), ('{"status":"ok","version":"0.1.9"}', "version 0.1.9"),
                           ("<p>", "is another program there")):
            class Old(http.server.BaseHTTPRequestHandler):
                def do_GET(self, body=body):
                    self.send_response(200)
                    self.end_headers()
                    self.wfile.write(body.encode())

                def log_message(self, *_):
                    pass
            server = http.server.HTTPServer(("127.0.0.1", 0), Old)
            threading.Thread(target=server.serve_forever, daemon=True).start()
            with self.assertRaisesRegex(ServerError, said):
                IkConnection(f"http://127.0.0.1:{server.server_port}").ask({})
            server.shutdown()

    def test_a_server_that_says_nothing_is_given_up(self):
        import socket
        from depthmocap.ik_client import IkConnection, ServerError
        with socket.create_server(("127.0.0.1", 0)) as silent:
            start = time.monotonic()
            with self.assertRaisesRegex(ServerError, "does not answer within 1 s"):
                IkConnection(f"127.0.0.1:{silent.getsockname()[1]}").ask({})
            self.assertLess(time.monotonic() - start, 3)


support.main()
