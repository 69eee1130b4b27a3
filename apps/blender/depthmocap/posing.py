"""Pose by handles: empties that are dragged; depthmocap serve says how the whole body follows."""
import time

import bpy
from bpy.app.handlers import persistent
from mathutils import Quaternion, Vector

from . import armature as armatures
from . import retargeting
from .ik_client import IkClient, IkConnection, ServerError
from .live import redraw
from .rig import Pose, Rig, to_blender, to_ours

JOINTS = ("head", "pelvis", "left_wrist", "right_wrist", "left_ankle", "right_ankle")
JOINT = "depthmocap_joint"  # of a handle: the joint that it holds
PINNED = "depthmocap_pinned"  # of a handle: whether it stays while others are dragged
POSE = "depthmocap_pose"  # of an armature: the answer's pose, from which the next solve goes on; undo brings it back

TICK_S = 1 / 60
MOVED_M = 1e-5  # a handle that moves less stands
DRAG_ENDS_S = 0.3  # without movement
PIN_WEIGHT = 10.0  # of a pinned joint against the dragged one: feet stay where a hand is pulled too far
LOWERED_M = 0.01  # by which a new body's knees give way
# Degrees of freedom by their place in a pose [rad]: hips, knees and feet that are bent for a start.
KNEES_BENT = {24: -0.15, 27: -0.15, 30: 0.3, 31: 0.3, 32: -0.15, 34: -0.15}
FREE_WEIGHT = 0.05  # of a joint that nobody holds: it follows, but does not wander


def handles_of(armature):
    return [child for child in armature.children if JOINT in child]


def place(handle):
    """Vector [m], Blender's: in the armature, of which a handle is a child. Unlike its matrix it is never late."""
    return handle.location.copy()


def request_of(settings, armature, dragged):
    """The body of POST /ik. `dragged`: names of handles."""
    targets, weights = {}, {}
    for handle in handles_of(armature):
        joint = handle[JOINT]
        targets[joint] = list(to_ours(place(handle)))
        if handle[PINNED]:
            weights[joint] = PIN_WEIGHT
        elif handle.name not in dragged:
            weights[joint] = FREE_WEIGHT
    request = {"targets": targets, "weights": weights, "prior": settings.prior, "prior_weight_m": settings.prior_weight_m,
               "bones": "gltf"}
    if POSE in armature:
        request["start"] = list(armature[POSE])
    return request


def pose_of(answer):
    bones = answer["bones"]
    turns = {name: Quaternion((bone["rotation"][3], *bone["rotation"][:3])) for name, bone in bones.items()}
    return Pose(turns, {name: Vector(bone["translation"]) for name, bone in bones.items()})


def rig_of(answer):
    """The rig of an answer: bones that carry skin alone, and the crown, are no bones of the armature."""
    pose, bones = pose_of(answer), answer["bones"]
    names = [name for name in bones if not name.endswith("Untwisted") and name != "HeadTop_End"]
    parents = {}
    while len(parents) < len(names):  # parents first
        for name in names:
            if name not in parents and (bones[name].get("parent") is None or bones[name]["parent"] in parents):
                parents[name] = bones[name].get("parent")
    offsets = {name: pose.offsets[name] for name in parents}
    low = sum(offsets[name].y for name in ("LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"))
    offsets["Hips"] = Vector((0, -low, 0))
    return Rig(parents, offsets, {"Head": pose.offsets["HeadTop_End"]})


def apply(armature, answer, held=()):
    """Shows an answer; handles but those of these names go to their joints."""
    armature[POSE] = answer["pose"]
    armatures.show(armature, armatures.rig_of(armature), pose_of(answer))
    for handle in handles_of(armature):
        if handle.name not in held and not handle[PINNED]:
            handle.location = to_blender(answer["joints"][handle[JOINT]])


def key(context, armature):
    for bone in armature.pose.bones:
        bone.keyframe_insert("rotation_quaternion", frame=context.scene.frame_current)
    armature.pose.bones["Hips"].keyframe_insert("location", frame=context.scene.frame_current)


class Posing:
    """The one session: watches the handles of one armature. None where there is none."""
    current = None

    def __init__(self, url, armature):
        self.client = IkClient(url)
        self.armature_name = armature.name
        self.dragged = set()
        self.moved_s = 0.0
        self.is_dragging = False
        self.look()

    def armature(self):
        armature = bpy.data.objects.get(self.armature_name)
        return armature if armatures.is_ours(armature) else None

    def look(self):
        """Takes the handles where they are for where they belong."""
        self.places = {handle.name: place(handle) for handle in handles_of(self.armature())}

    def tick(self, context):
        armature = self.armature()
        if armature is None:
            return
        moved = {h.name for h in handles_of(armature) if (place(h) - self.places.get(h.name, place(h))).length > MOVED_M}
        if moved:
            self.drag(context, armature, moved)
        taken = self.client.take()
        if taken is not None:
            apply(armature, taken[1], self.dragged)
            retargeting.follow(context, armature)
        self.look()
        if self.is_dragging and time.monotonic() - self.moved_s > DRAG_ENDS_S and self.client.is_idle():
            self.is_dragging = False
            self.finish(context, armature)

    def drag(self, context, armature, moved):
        if not self.is_dragging:
            self.dragged = set()
        self.dragged |= moved
        self.is_dragging = True
        self.moved_s = time.monotonic()
        self.client.submit(request_of(context.scene.depthmocap, armature, self.dragged))

    def finish(self, context, armature):
        """The last answer is part of what undo takes back."""
        if context.scene.depthmocap.auto_key:
            key(context, armature)
        if bpy.ops.ed.undo_push.poll():
            bpy.ops.ed.undo_push(message="Pose by handles")


def tick():
    if Posing.current is None:
        return None
    try:
        Posing.current.tick(bpy.context)
    except ReferenceError:
        pass  # a file was loaded or undo came in between; the next tick looks anew
    redraw()
    return TICK_S


@persistent
def after_undo(*_):
    """Undo moves handles together with the pose: nothing is to be asked for."""
    if Posing.current is not None and Posing.current.armature() is not None:
        Posing.current.is_dragging = False
        Posing.current.client.take()
        Posing.current.look()


def start(context, armature):
    stop()
    Posing.current = Posing(context.scene.depthmocap.server, armature)
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, persistent=True)


def stop():
    if Posing.current is not None:
        Posing.current.client.end()
        Posing.current = None


def relaxed(answer):
    """The request that bends the knees of a T-pose a little: from straight legs no solve finds which way they bend."""
    start = list(answer["pose"])
    for dof, angle in KNEES_BENT.items():
        start[dof] = angle
    targets = {}
    for joint, (x, y, z) in answer["joints"].items():
        targets[joint] = [x, y if joint.endswith(("_ankle", "_toe")) else y - LOWERED_M, z]
        if joint.endswith("_knee"):
            del targets[joint]
    return {"targets": targets, "prior": "none", "start": start, "bones": "gltf"}


def add_handle(context, armature, joint, at):
    handle = bpy.data.objects.new(f"{armature.name} {joint}", None)
    handle.empty_display_type, handle.empty_display_size = "SPHERE", 0.06
    handle.show_in_front = True
    handle.parent = armature
    handle.location = at
    handle[JOINT], handle[PINNED] = joint, joint.endswith("_ankle")
    context.collection.objects.link(handle)


class DEPTHMOCAP_OT_add_body(bpy.types.Operator):
    bl_idname = "depthmocap.add_body"
    bl_label = "Add body with handles"
    bl_description = "An armature of the server's body in a T-pose, and handles for wrists, ankles, head and pelvis"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            connection = IkConnection(context.scene.depthmocap.server)
            rig = rig_of(connection.ask({"targets": {"pelvis": [0, 0, 0]}, "prior": "none", "bones": "gltf"}))
            height = list(rig.offsets["Hips"])
            answer = connection.ask({"targets": {"pelvis": height}, "prior": "none", "bones": "gltf"})
            answer = connection.ask(relaxed(answer))
            connection.close()
        except ServerError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        armature = armatures.build(context, rig, "Body")
        for joint in JOINTS:
            add_handle(context, armature, joint, to_blender(answer["joints"][joint]))
        apply(armature, answer)
        context.view_layer.update()
        context.scene.depthmocap.source = armature
        start(context, armature)
        return {"FINISHED"}


class DEPTHMOCAP_OT_pose_start(bpy.types.Operator):
    bl_idname = "depthmocap.pose_start"
    bl_label = "Follow handles"
    bl_description = "Lets the body of the active armature or handle follow its handles"

    @classmethod
    def poll(cls, context):
        return body_of(context.object) is not None

    def execute(self, context):
        try:
            start(context, body_of(context.object))
        except ServerError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class DEPTHMOCAP_OT_pose_stop(bpy.types.Operator):
    bl_idname = "depthmocap.pose_stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context):
        return Posing.current is not None

    def execute(self, context):
        stop()
        return {"FINISHED"}


class DEPTHMOCAP_OT_pin(bpy.types.Operator):
    bl_idname = "depthmocap.pin"
    bl_label = "Pin"
    bl_description = "Pins the selected handles where they are, or lets them go"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return any(JOINT in thing for thing in context.selected_objects)

    def execute(self, context):
        handles = [thing for thing in context.selected_objects if JOINT in thing]
        pinned = not all(handle[PINNED] for handle in handles)
        for handle in handles:
            handle[PINNED] = pinned
        return {"FINISHED"}


class DEPTHMOCAP_OT_key_pose(bpy.types.Operator):
    bl_idname = "depthmocap.key_pose"
    bl_label = "Key pose"
    bl_description = "Inserts keys for the whole body at the current frame"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return body_of(context.object) is not None

    def execute(self, context):
        key(context, body_of(context.object))
        return {"FINISHED"}


def body_of(thing):
    """The armature with handles that a thing is or belongs to, or None."""
    if thing is not None and JOINT in thing:
        thing = thing.parent
    return thing if armatures.is_ours(thing) and handles_of(thing) else None


CLASSES = (DEPTHMOCAP_OT_add_body, DEPTHMOCAP_OT_pose_start, DEPTHMOCAP_OT_pose_stop, DEPTHMOCAP_OT_pin, DEPTHMOCAP_OT_key_pose)
UNDO = (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post, bpy.app.handlers.load_post)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    for handlers in UNDO:
        handlers.append(after_undo)


def unregister():
    stop()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    for handlers in UNDO:
        handlers.remove(after_undo)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
