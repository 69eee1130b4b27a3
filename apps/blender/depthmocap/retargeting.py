"""Retargeting in the panel: a character follows our armature, or takes its action over."""
import bpy

from .retarget import Retarget, RetargetError


class Follower:
    """The one pair that follows live; None where there is none."""
    current = None


def follow(context, source):
    """After our armature was posed: the character too, if it follows this one."""
    if Follower.current is None or Follower.current.source_name != source.name:
        return
    try:
        context.view_layer.update()
        Follower.current.apply()
    except ReferenceError:  # the character was deleted
        Follower.current = None


def chosen(context):
    settings = context.scene.depthmocap
    if settings.source is None or settings.target is None:
        raise RetargetError("Choose the armatures to take from and to give to")
    return Retarget(context, settings.source, settings.target, settings.preset)


class DEPTHMOCAP_OT_retarget(bpy.types.Operator):
    bl_idname = "depthmocap.retarget"
    bl_label = "Bake action"
    bl_description = "Keys the character for every frame of our armature's action, or of this frame where it has none"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            pair = chosen(context)
        except RetargetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        scene, now = context.scene, context.scene.frame_current
        animation = pair.source.animation_data
        if animation is None or animation.action is None:
            pair.apply()
            pair.key(now)
            return {"FINISHED"}
        first, last = (round(frame) for frame in animation.action.frame_range)
        context.window_manager.progress_begin(first, last + 1)
        for frame in range(first, last + 1):
            scene.frame_set(frame)
            pair.apply()
            pair.key(frame)
            context.window_manager.progress_update(frame)
        context.window_manager.progress_end()
        scene.frame_set(now)
        self.report({"INFO"}, f"{last - first + 1} frames keyed")
        return {"FINISHED"}


class DEPTHMOCAP_OT_follow(bpy.types.Operator):
    bl_idname = "depthmocap.follow"
    bl_label = "Follow"
    bl_description = "Lets the character follow our armature while it is driven live or by handles; again: ends that"

    def execute(self, context):
        if Follower.current is not None:
            Follower.current = None
            return {"FINISHED"}
        try:
            Follower.current = chosen(context)
            Follower.current.apply()
        except RetargetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = (DEPTHMOCAP_OT_retarget, DEPTHMOCAP_OT_follow)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    Follower.current = None
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
