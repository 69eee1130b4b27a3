"""Runs inside Blender: imports a BVH or glTF file, writes each joint's world position for each frame as CSV.

blender --background --factory-startup --python scripts/blender_joints.py -- MOTION OUT.csv [PICTURE.png]

Columns: frame, then <bone>_x, <bone>_y, <bone>_z for each bone's head and, named <bone>.tail, its tail [Blender's unit].
Blender's world is z up; a figure that faces the viewer of our y-up world faces -y there.
"""
import builtins
import csv
import math
import sys
from pathlib import Path

import bpy
import numpy
from mathutils import Vector

# Debian 12 ships Blender 3.4 with Python 3.11 and NumPy 1.24, which no longer have what its importers use.
plain_open = builtins.open
builtins.open = lambda file, mode="r", *rest, **named: plain_open(file, mode.replace("U", ""), *rest, **named)
if "bool" not in numpy.__dict__:
    numpy.bool = bool


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.suffix == ".bvh":
        bpy.ops.import_anim.bvh(filepath=str(path))
    else:
        # Frames of Blender as frames of the file: its importer scales times by the scene's rate.
        bpy.context.scene.render.fps = 30
        bpy.ops.import_scene.gltf(filepath=str(path))
    return next(o for o in bpy.data.objects if o.type == "ARMATURE")


def write_joints(armature, out):
    scene = bpy.context.scene
    first, last = (round(f) for f in armature.animation_data.action.frame_range)
    bones = armature.pose.bones
    with plain_open(out, "w", newline="") as file:
        table = csv.writer(file)
        names = [b.name + end for b in bones for end in ("", ".tail")]
        table.writerow(["frame"] + [f"{name}_{axis}" for name in names for axis in "xyz"])
        for frame in range(first, last + 1):
            scene.frame_set(frame)
            row = [frame - first]
            for bone in bones:
                for point in (bone.head, bone.tail):
                    row += [f"{value:.6f}" for value in armature.matrix_world @ point]
            table.writerow(row)


def render(armature, picture):
    """The figure of the middle frame, seen from where it is looked at in our world (+z there, -y here)."""
    scene = bpy.context.scene
    first, last = armature.animation_data.action.frame_range
    scene.frame_set(round(first + 0.5 * (last - first)))
    centre = armature.matrix_world @ armature.pose.bones["Hips"].head
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = centre + Vector((1.2, -3.4, 0.4))
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.rotation_euler = (math.radians(40), 0, math.radians(25))
    sun.data.energy = 3
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 24
    scene.cycles.use_denoising = False  # Debian builds it without
    scene.render.resolution_x, scene.render.resolution_y = 480, 560
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    armature = load(Path(arguments[0]).resolve())
    write_joints(armature, arguments[1])
    if len(arguments) > 2:
        render(armature, str(Path(arguments[2]).resolve()))


main()
