"""Imports the result of a recording at its own rate: BVH, glTF, or poses and joints as CSV."""
import builtins
import contextlib
import json
import struct
from pathlib import Path

import bpy
import numpy
from bpy_extras.io_utils import ImportHelper

from . import armature as armatures
from .motion_files import FileError, read_motion

NEAR_RATE = 0.005  # share by which a whole rate may miss the file's


def rate_of(times_s):
    """Frames a second as Blender has them: (fps, fps_base) with the rate fps / fps_base."""
    if len(times_s) < 2:
        return 30, 1.0
    rate = (len(times_s) - 1) / (times_s[-1] - times_s[0])
    whole = max(1, round(rate))
    return whole, 1.0 if abs(whole - rate) < NEAR_RATE * rate else whole / rate


def set_rate(scene, times_s):
    scene.render.fps, scene.render.fps_base = rate_of(times_s)


def gltf_times(path):
    """The times of the animation in a .glb file [s]."""
    data = path.read_bytes()
    size, = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20:20 + size])
    animations = document.get("animations")
    if not animations:
        raise FileError(f"{path.name} has no animation")
    accessor = document["accessors"][animations[0]["samplers"][0]["input"]]
    return [i * (accessor["max"][0] - accessor["min"][0]) / max(1, accessor["count"] - 1) for i in range(accessor["count"])]


@contextlib.contextmanager
def old_numpy_names():
    """Debian's Blender 3.4 has a newer NumPy than its glTF importer expects."""
    missing = not hasattr(numpy, "bool")
    if missing:
        numpy.bool = builtins.bool
    try:
        yield
    finally:
        if missing:
            del numpy.bool


def import_gltf(scene, path):
    try:
        times_s = gltf_times(path)
    except (OSError, ValueError, KeyError, IndexError, struct.error) as error:
        raise FileError(f"{path.name} is damaged or no binary glTF ({error})") from error
    set_rate(scene, times_s)  # Blender's importer scales times by the scene's rate
    with old_numpy_names():
        bpy.ops.import_scene.gltf(filepath=str(path))
    return scene.frame_start + len(times_s) - 1


def import_motion(context, path, joints, person):
    """The armature with the file's motion as its action."""
    scene = context.scene
    motion = read_motion(path, joints, person)
    set_rate(scene, motion.times_s)
    armature = armatures.build(context, motion.rig, path.stem)
    fps = scene.render.fps / scene.render.fps_base
    frames = [scene.frame_start + fps * (time - motion.times_s[0]) for time in motion.times_s]
    frames = [round(frame) if abs(frame - round(frame)) < 1e-3 else frame for frame in frames]
    armatures.animate(armature, motion.rig, motion.poses, frames, path.stem)
    scene.depthmocap.source = armature
    return frames[-1]


class DEPTHMOCAP_OT_import(bpy.types.Operator, ImportHelper):
    bl_idname = "depthmocap.import_motion"
    bl_label = "Import result"
    bl_description = "Imports what depthmocap replay wrote: BVH, glTF, or a pose file with its joints file"
    bl_options = {"REGISTER", "UNDO"}

    filter_glob: bpy.props.StringProperty(default="*.bvh;*.glb;*.csv", options={"HIDDEN"})
    joints: bpy.props.StringProperty(
        name="Joints file", subtype="FILE_PATH", description="Of the same run as a pose file; default: joints.csv beside it")
    person: bpy.props.IntProperty(name="Person", default=1, min=1, max=6, description="Of files of several people")

    def execute(self, context):
        path = Path(bpy.path.abspath(self.filepath))
        try:
            if path.suffix.lower() == ".glb":
                last = import_gltf(context.scene, path)
            else:
                last = import_motion(context, path, bpy.path.abspath(self.joints), self.person)
        except (FileError, RuntimeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.scene.frame_end = max(context.scene.frame_start, round(last))
        return {"FINISHED"}


def register():
    bpy.utils.register_class(DEPTHMOCAP_OT_import)


def unregister():
    bpy.utils.unregister_class(DEPTHMOCAP_OT_import)
