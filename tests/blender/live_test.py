"""The live stream: a recording sent by VMC drives an armature and is recorded; silence and damage are survived."""
import csv
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import bpy
import support
from mathutils import Vector

NEAR_MM = 1.0
WALK = support.ROOT / "recordings/walk"


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Live(unittest.TestCase):
    def setUp(self):
        self.scene = support.fresh_scene()
        self.scene.depthmocap.vmc_port = free_port()
        self.assertEqual(bpy.ops.depthmocap.live_start(), {"FINISHED"})

    def tearDown(self):
        from depthmocap import live
        live.stop()

    def test_a_recording_drives_the_armature_and_becomes_an_action(self):
        from depthmocap.live import Live
        self.scene.render.fps = 30
        with tempfile.TemporaryDirectory() as folder:
            joints = Path(folder) / "joints.csv"
            bpy.ops.depthmocap.record()
            sender = subprocess.Popen([support.PROGRAM, "replay", WALK, "--vmc", f"127.0.0.1:{self.scene.depthmocap.vmc_port}",
                                       "--joints", joints], stderr=subprocess.DEVNULL)
            while sender.poll() is None:
                Live.current.tick(bpy.context)
                time.sleep(1 / 60)
            time.sleep(0.2)
            Live.current.tick(bpy.context)
            rows = [row for row in csv.DictReader(joints.open()) if row["state"] != "lost"]
        self.assertIn("Receiving", Live.current.receiver.state())
        bpy.ops.depthmocap.record()
        armature = Live.current.armature()
        first, last = armature.animation_data.action.frame_range
        self.assertAlmostEqual(last - first, 30 * (float(rows[-1]["time_s"]) - float(rows[0]["time_s"])), delta=0.01)
        worst = 0.0
        for row in rows[::10]:
            frame = first + 30 * (float(row["time_s"]) - float(rows[0]["time_s"]))
            self.scene.frame_set(int(frame), subframe=frame - int(frame))
            worst = max(worst, support.farthest_mm(*self.relative(row, support.joints_of(armature))))
        print(f"live: {len(rows)} frames, joints at most {worst:.3f} mm from the joints file")
        self.assertLess(worst, NEAR_MM)

    @staticmethod
    def relative(row, joints):
        """Both about the pelvis: the stream puts the origin on the floor. The head of the stream has no centre."""
        camera = {joint: Vector([float(row[f"{joint}_{axis}"]) for axis in "xyz"]) for joint in joints if joint != "head"}
        world = {joint: Vector((p.x, -p.y, -p.z)) for joint, p in camera.items()}
        return ({joint: joints[joint] - joints["pelvis"] for joint in world},
                {joint: p - world["pelvis"] for joint, p in world.items()})

    def test_silence_is_said(self):
        from depthmocap.live import Live
        self.assertIn("Waiting for a stream", Live.current.receiver.state())
        Live.current.receiver.last_packet_s = time.monotonic() - 3
        self.assertIn("Connection lost", Live.current.receiver.state())

    def test_damaged_packets_are_passed_over(self):
        from depthmocap.live import Live
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for packet in (b"", b"\0", b"#bundle\0", b"#bundle\0" + b"\0" * 8 + b"\xff" * 40, b"/VMC/Ext/Bone/Pos\0\0\0,sfffffff\0\0\0",
                           b"#bundle\0" + b"\0" * 8 + b"\0\0\x7f\xff", b"/VMC/Ext/T\0\0,s\0\0abc\0", b"\xff" * 1000):
                sender.sendto(packet, ("127.0.0.1", self.scene.depthmocap.vmc_port))
        time.sleep(0.3)
        Live.current.tick(bpy.context)
        self.assertTrue(Live.current.receiver.thread.is_alive())
        self.assertIsNone(Live.current.armature())

    def test_a_port_in_use_is_said(self):
        from depthmocap import live
        live.Live.current, first = None, live.Live.current
        try:
            with self.assertRaisesRegex(RuntimeError, "cannot be listened on"):
                bpy.ops.depthmocap.live_start()
        finally:
            live.Live.current = first


support.main()
