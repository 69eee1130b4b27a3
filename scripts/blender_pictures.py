"""Runs inside Blender: draws docs/figures/blender-handles.jpg and blender-retarget.jpg with the add-on and a real server.

tests/blender/run.py scripts/blender_pictures.py
"""
import math
import sys
import tempfile
import time
from pathlib import Path

import bpy
from mathutils import Vector

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/blender"))
import characters  # noqa: E402
import support  # noqa: E402

FIGURES = ROOT / "docs/figures"
STEP_M = 1.25  # between figures


def material(name, colour):
    found = bpy.data.materials.get(name)
    if found is None:
        found = bpy.data.materials.new(name)
        found.use_nodes = True
        found.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*colour, 1)
        found.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.6
    return found


def ball(at, radius, look):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=radius, location=at)
    bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(look)


def limb(start, end, radius, look):
    along = end - start
    bpy.ops.mesh.primitive_cone_add(vertices=20, radius1=radius, radius2=0.8 * radius, depth=along.length, location=(start + end) / 2)
    thing = bpy.context.object
    thing.rotation_euler = along.to_track_quat("Z", "Y").to_euler()
    bpy.ops.object.shade_smooth()
    thing.data.materials.append(look)
    ball(start, 1.02 * radius, look)


def draw_figure(armature, at, look, chain=None):
    """Every bone as it is posed now, as a limb; `chain`: names of the bones that are drawn."""
    bpy.context.view_layer.update()
    for bone in armature.pose.bones:
        if chain is not None and bone.name not in chain:
            continue
        start, end = armature.matrix_world @ bone.head, armature.matrix_world @ bone.tail
        radius = 0.17 * (end - start).length
        radius = min(max(radius, 0.035), 0.07)
        if bone.name.endswith(("Head", "DEF-spine.006")):
            ball(at + (start + end) / 2, 0.6 * (end - start).length, look)
        else:
            limb(at + start, at + end, radius, look)


def render(name, figures, height=0.95, distance=9.0, width=900):
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=40)
    bpy.context.object.data.materials.append(material("floor", (0.22, 0.23, 0.25)))
    centre = Vector((0.5 * STEP_M * (figures - 1), 0, height))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = centre + Vector((0.6, -distance, 0.5))
    camera.rotation_euler = (centre - Vector((0, 0, 0.15)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.rotation_euler = (math.radians(40), 0, math.radians(25))
    sun.data.energy, sun.data.angle = 2.2, 0.2
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.55, 0.62, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 12
    scene.cycles.use_denoising = False  # Debian builds it without
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = width, 360
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 85
    scene.render.filepath = str(FIGURES / name)
    bpy.ops.render.render(write_still=True)


def drag(handle, by):
    from depthmocap.posing import Posing
    for _ in range(20):
        handle.location += Vector(by) / 20
        bpy.context.view_layer.update()
        Posing.current.tick(bpy.context)
        time.sleep(1 / 60)
    while Posing.current.is_dragging:
        bpy.context.view_layer.update()
        Posing.current.tick(bpy.context)
        time.sleep(1 / 60)


def draw_handles():
    from depthmocap.posing import JOINT, PINNED, handles_of
    scene = support.fresh_scene()
    bpy.ops.depthmocap.add_body()
    body = scene.depthmocap.source
    handles = {handle[JOINT]: handle for handle in handles_of(body)}
    looks = {"body": material("body", (0.62, 0.66, 0.72)), True: material("pinned", (0.9, 0.25, 0.15)),
             False: material("free", (0.95, 0.75, 0.1)), "dragged": material("dragged", (0.1, 0.5, 0.95))}
    drags = [(None, None), ("left_wrist", (-0.45, -0.35, -0.35)), ("right_wrist", (0.3, -0.1, 0.42)), ("pelvis", (0, 0.12, -0.36)),
             ("left_ankle", (0.12, -0.32, 0.25))]
    for i, (joint, by) in enumerate(drags):
        if joint is not None:
            handles[joint][PINNED] = False
            drag(handles[joint], by)
        at = Vector((STEP_M * i, 0, 0))
        draw_figure(body, at, looks["body"])
        for name, handle in handles.items():
            look = looks["dragged"] if name == joint else looks[bool(handle[PINNED])]
            ball(at + handle.matrix_world.to_translation() + Vector((0, -0.03, 0)), 0.075, look)
    bpy.ops.depthmocap.pose_stop()
    render("blender-handles.jpg", len(drags), height=0.95)


def draw_retarget():
    scene = support.fresh_scene()
    with tempfile.TemporaryDirectory() as folder:
        bvh = Path(folder) / "boxing.bvh"
        support.run_program("replay", ROOT / "recordings/boxing", "--bvh", bvh)
        bpy.ops.depthmocap.import_motion(filepath=str(bvh))
    source = scene.depthmocap.source
    pairs = [("Mixamo", characters.mixamo()), ("VRM", characters.vrm()), ("Rigify", characters.rigify())]
    for preset, target in pairs:
        scene.depthmocap.target, scene.depthmocap.preset = target, preset
        bpy.ops.depthmocap.retarget()
    scene.frame_set(scene.frame_start + (scene.frame_end - scene.frame_start) // 2)
    draw_figure(source, Vector(), material("ours", (0.62, 0.66, 0.72)))
    colours = {"Mixamo": (0.85, 0.5, 0.25), "VRM": (0.45, 0.65, 0.35), "Rigify": (0.4, 0.5, 0.8)}
    for i, (preset, target) in enumerate(pairs):
        chain = None
        if preset == "Rigify":  # of its hundreds of bones those of trunk and limbs
            parts = ("DEF-spine", "DEF-shoulder", "DEF-upper_arm", "DEF-forearm", "DEF-hand", "DEF-thigh", "DEF-shin", "DEF-foot", "DEF-toe")
            chain = {bone.name for bone in target.pose.bones if bone.name.startswith(parts)}
        draw_figure(target, Vector((STEP_M * (i + 1), 0, 0)), material(preset, colours[preset]), chain)
    for thing in (source, *(target for _, target in pairs)):
        thing.hide_render = True
    render("blender-retarget.jpg", len(pairs) + 1, height=0.95)


draw_handles()
draw_retarget()
