"""Characters to retarget to: armatures with the names, units, axes and rest poses of other programs."""
from math import radians

import bpy
from mathutils import Matrix, Vector

# [m], z up, facing -y, of one side (+x is the left): arms hang by 45 degrees, legs are a little apart.
CENTRE = [("Hips", None, (0, 0.01, 0.98)), ("Spine", "Hips", (0, 0.02, 1.08)), ("Spine1", "Spine", (0, 0.025, 1.2)),
          ("Spine2", "Spine1", (0, 0.02, 1.33)), ("Neck", "Spine2", (0, 0.03, 1.5)), ("Head", "Neck", (0, 0.01, 1.6))]
SIDE = [("Shoulder", "Spine2", (0.04, 0.01, 1.44)), ("Arm", "Shoulder", (0.17, 0.04, 1.43)), ("ForeArm", "Arm", (0.36, 0.05, 1.24)),
        ("Hand", "ForeArm", (0.52, 0.0, 1.06)), ("UpLeg", "Hips", (0.095, 0.01, 0.92)), ("Leg", "UpLeg", (0.12, 0.0, 0.5)),
        ("Foot", "Leg", (0.14, 0.03, 0.09)), ("ToeBase", "Foot", (0.15, -0.11, 0.02))]
ENDS = {"Head": (0, 0, 0.2), "Hand": (0.06, 0, -0.06), "ToeBase": (0, -0.07, 0)}


def places(scale):
    """Bone to (parent, head) [m] of the whole character."""
    bones = {name: (parent, scale * Vector(head)) for name, parent, head in CENTRE}
    for side, sign in (("Left", 1), ("Right", -1)):
        for name, parent, head in SIDE:
            of_side = parent in [bone for bone, _, _ in SIDE]
            bones[side + name] = (side + parent if of_side else parent, scale * Vector((sign * head[0], *head[1:])))
    return bones


def character(name, rename, scale=1.0, unit=1.0, axes=None, roll=0.0):
    """An armature: `rename` gives each bone its name, `unit` [m] is that of its bones, `axes` turns it in the world."""
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(armature)
    matrix = (axes or Matrix.Identity(3)).to_4x4() @ Matrix.Scale(unit, 4)
    armature.matrix_world = matrix
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    bones = places(scale)
    for bone, (parent, head) in bones.items():
        edit = data.edit_bones.new(rename(bone))
        children = [place for child, (of, place) in bones.items() if of == bone]
        end = next((Vector(e) for suffix, e in ENDS.items() if bone.endswith(suffix)), None)
        tail = head + scale * end if end else min(children, key=lambda place: abs(place.x))
        edit.head, edit.tail = matrix.inverted() @ head, matrix.inverted() @ tail
        edit.roll = roll
        edit.parent = data.edit_bones[rename(parent)] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    return armature


def mixamo():
    """As FBX files come in: y up in centimetres, turned and scaled by the object, larger than our body."""
    return character("Mixamo", lambda bone: f"mixamorig:{bone}", scale=1.12, unit=0.01, axes=Matrix.Rotation(radians(90), 3, "X"), roll=0.4)


VRM_NAMES = {"Spine1": "Chest", "Spine2": "UpperChest", "Arm": "UpperArm", "ForeArm": "LowerArm", "UpLeg": "UpperLeg", "Leg": "LowerLeg"}


def vrm():
    """Small, as VRoid's are, with Euler angles."""
    def rename(bone):
        side = "L" if bone.startswith("Left") else "R" if bone.startswith("Right") else "C"
        bare = bone.removeprefix("Left").removeprefix("Right")
        return f"J_Bip_{side}_{VRM_NAMES.get(bare, bare)}"
    armature = character("VRM", rename, scale=0.85, roll=-1.0)
    for bone in armature.pose.bones:
        bone.rotation_mode = "XYZ"
    return armature


def rigify():
    """The rig that Blender's own Rigify generates from its human."""
    bpy.ops.preferences.addon_enable(module="rigify")
    bpy.ops.object.armature_human_metarig_add()
    metarig = bpy.context.object
    before = set(bpy.data.objects)
    bpy.ops.pose.rigify_generate()
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE" and thing not in before and thing != metarig)
