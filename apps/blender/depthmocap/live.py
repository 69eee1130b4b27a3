"""The stream of a running depthmocap drives an armature and is recorded to an action."""
import bpy

from . import armature as armatures
from . import retargeting
from .vmc import VmcReceiver, rig_of

TICK_S = 1 / 60


class Live:
    """The one stream; None where there is none."""
    current = None

    def __init__(self, address, port):
        self.receiver = VmcReceiver(address, port)
        self.armature_name = ""
        self.rig = None
        self.recorded = None  # frames since recording began, or None

    def armature(self):
        return bpy.data.objects.get(self.armature_name)

    def show(self, context, frames):
        """Poses the armature by the newest of some frames; builds it with the first."""
        if self.armature() is None:
            self.rig = rig_of(frames[0])
            self.armature_name = armatures.build(context, self.rig, "Live").name
            context.scene.depthmocap.source = self.armature()
        armatures.show(self.armature(), self.rig, frames[-1].pose)

    def tick(self, context):
        frames = self.receiver.take()
        if not frames:
            return
        if self.recorded is not None:
            self.recorded.extend(frames)
        self.show(context, frames)
        retargeting.follow(context, self.armature())

    def write(self, context):
        """What was recorded as an action from the current frame on, or None where nothing came."""
        frames, self.recorded = self.recorded, None
        scene = context.scene
        times = []
        kept = []
        for frame in frames or []:
            if not times or frame.time_s > times[-1]:
                times.append(frame.time_s)
                kept.append(frame.pose)
        if not kept or self.armature() is None:
            return None
        fps = scene.render.fps / scene.render.fps_base
        keys = [scene.frame_current + fps * (time - times[0]) for time in times]
        return armatures.animate(self.armature(), self.rig, kept, keys, "Take")


def tick():
    if Live.current is None:
        return None
    try:
        Live.current.tick(bpy.context)
    except ReferenceError:
        pass  # a file was loaded meanwhile; the next tick looks anew
    redraw()
    return TICK_S


def redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


class DEPTHMOCAP_OT_live_start(bpy.types.Operator):
    bl_idname = "depthmocap.live_start"
    bl_label = "Connect"
    bl_description = "Lets the stream of depthmocap live --vmc drive an armature"

    @classmethod
    def poll(cls, context):
        return Live.current is None

    def execute(self, context):
        settings = context.scene.depthmocap
        try:
            Live.current = Live(settings.vmc_address, settings.vmc_port)
        except OSError as error:
            self.report({"ERROR"}, f"Port {settings.vmc_port} of {settings.vmc_address} cannot be listened on: {error}")
            return {"CANCELLED"}
        bpy.app.timers.register(tick, persistent=True)
        return {"FINISHED"}


class DEPTHMOCAP_OT_live_stop(bpy.types.Operator):
    bl_idname = "depthmocap.live_stop"
    bl_label = "Disconnect"

    @classmethod
    def poll(cls, context):
        return Live.current is not None

    def execute(self, context):
        if Live.current.recorded is not None:
            Live.current.write(context)
        stop()
        return {"FINISHED"}


class DEPTHMOCAP_OT_record(bpy.types.Operator):
    bl_idname = "depthmocap.record"
    bl_label = "Record"
    bl_description = "Starts a take; again: ends it as an action that begins at the current frame"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return Live.current is not None

    def execute(self, context):
        if Live.current.recorded is None:
            Live.current.recorded = []
            return {"FINISHED"}
        action = Live.current.write(context)
        if action is None:
            self.report({"WARNING"}, "Nothing was received during the take")
            return {"CANCELLED"}
        self.report({"INFO"}, f"{action.name}: frames {action.frame_range[0]:.0f} to {action.frame_range[1]:.0f}")
        return {"FINISHED"}


def stop():
    if Live.current is not None:
        Live.current.receiver.end()
        Live.current = None


CLASSES = (DEPTHMOCAP_OT_live_start, DEPTHMOCAP_OT_live_stop, DEPTHMOCAP_OT_record)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    stop()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
