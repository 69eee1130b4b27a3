"""Armatures of our bodies: built from a rig, posed, animated."""
import bpy
from mathutils import Vector

from .rig import Rig, bone_pose, heads, tail, to_ours, z_axis

OFFSETS = "depthmocap_offsets"  # of an armature: its rig's offsets, bone by bone, as 3 numbers each [m], ours
SAME_PLACE_M = 1e-5  # a bone that moves less in its parent gets no location keys


def build(context, rig, name):
    """A new armature in its rest pose, active and in object mode."""
    if context.object and context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    context.collection.objects.link(armature)
    context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    places = heads(rig)
    for bone, parent in rig.parents.items():
        edit = data.edit_bones.new(bone)
        edit.head, edit.tail = places[bone], tail(rig, bone, places)
        edit.align_roll(z_axis(edit.tail - edit.head))
        edit.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in armature.pose.bones:
        bone.rotation_mode = "QUATERNION"
    armature[OFFSETS] = {bone: list(offset) for bone, offset in rig.offsets.items()}
    return armature


def is_ours(thing):
    return thing is not None and thing.type == "ARMATURE" and OFFSETS in thing


def rig_of(armature):
    """The rig that an armature was built from."""
    offsets = armature[OFFSETS].to_dict()
    parents = {bone.name: bone.parent.name if bone.parent else None for bone in armature.data.bones}
    return Rig(parents, {bone: Vector(offsets[bone]) for bone in parents})


def show(armature, rig, pose):
    """Poses an armature that was built from this rig; `pose` may name more bones."""
    for bone in armature.pose.bones:
        bone.rotation_quaternion, bone.location = bone_pose(bone.bone.matrix_local, rig, pose, bone.name)


def new_action(armature, name):
    """A new action of the armature: a function from (data path, index) to a new curve in it."""
    action = bpy.data.actions.new(name)
    armature.animation_data_create().action = action
    if hasattr(action, "slots"):  # from 4.4 on
        armature.animation_data.action_slot = action.slots.new(id_type="OBJECT", name=armature.name)
    if hasattr(action, "fcurve_ensure_for_datablock"):
        return action, lambda path, index: action.fcurve_ensure_for_datablock(armature, path, index=index)
    return action, lambda path, index: action.fcurves.new(path, index=index)


def fill(curve, frames, values):
    points = curve.keyframe_points
    points.add(len(frames))
    points.foreach_set("co", [number for pair in zip(frames, values) for number in pair])
    for point in points:
        point.interpolation = "LINEAR"
    curve.update()


def animate(armature, rig, poses, frames, name):
    """Poses at frames (numbers that may be fractions) as a new action of an armature that was built from this rig."""
    action, curve = new_action(armature, name)
    for bone in armature.pose.bones:
        path = f'pose.bones["{bpy.utils.escape_identifier(bone.name)}"]'
        keys = [bone_pose(bone.bone.matrix_local, rig, pose, bone.name) for pose in poses]
        for before, after in zip(keys, keys[1:]):
            if before[0].dot(after[0]) < 0:
                after[0].negate()  # the short way between the two
        for axis in range(4):
            fill(curve(f"{path}.rotation_quaternion", axis), frames, [turn[axis] for turn, _ in keys])
        if any((place - keys[0][1]).length > SAME_PLACE_M for _, place in keys) or keys[0][1].length > SAME_PLACE_M:
            for axis in range(3):
                fill(curve(f"{path}.location", axis), frames, [place[axis] for _, place in keys])
    return action


def place_of(armature, bone):
    """Vector [m], ours: the head of a bone as it is posed now, in the armature."""
    return to_ours(armature.pose.bones[bone].head)
