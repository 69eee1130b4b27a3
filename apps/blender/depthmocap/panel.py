"""The tab depthmocap in the sidebar of the 3D view."""
import bpy

from .live import Live
from .posing import JOINT, PINNED, Posing
from .retargeting import Follower


class DepthmocapPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "depthmocap"


class DEPTHMOCAP_PT_live(DepthmocapPanel, bpy.types.Panel):
    bl_label = "Live"

    def draw(self, context):
        layout, settings = self.layout, context.scene.depthmocap
        if Live.current is None:
            layout.prop(settings, "vmc_address")
            layout.prop(settings, "vmc_port")
            layout.operator("depthmocap.live_start", icon="PLAY")
            return
        state = Live.current.receiver.state()
        layout.label(text=state, icon="ERROR" if "lost" in state else "INFO")
        recording = Live.current.recorded is not None
        layout.operator("depthmocap.record", text="End take" if recording else "Record", icon="REC", depress=recording)
        layout.operator("depthmocap.live_stop", icon="CANCEL")


class DEPTHMOCAP_PT_pose(DepthmocapPanel, bpy.types.Panel):
    bl_label = "Pose by handles"

    def draw(self, context):
        layout, settings = self.layout, context.scene.depthmocap
        layout.prop(settings, "server")
        layout.operator("depthmocap.add_body", icon="ARMATURE_DATA")
        if Posing.current is None:
            layout.operator("depthmocap.pose_start", icon="PLAY")
        else:
            self.draw_session(layout, Posing.current)
        layout.prop(settings, "prior")
        layout.prop(settings, "prior_weight_m")
        thing = context.object
        if thing is not None and JOINT in thing:
            layout.operator("depthmocap.pin", icon="PINNED" if thing[PINNED] else "UNPINNED", depress=bool(thing[PINNED]))
        layout.operator("depthmocap.key_pose", icon="KEY_HLT")
        layout.prop(settings, "auto_key")

    @staticmethod
    def draw_session(layout, posing):
        if posing.client.error:
            layout.label(text=posing.client.error, icon="ERROR")
        elif posing.client.connection.version:
            layout.label(text=f"depthmocap {posing.client.connection.version}", icon="CHECKMARK")
        layout.operator("depthmocap.pose_stop", icon="CANCEL")


class DEPTHMOCAP_PT_import(DepthmocapPanel, bpy.types.Panel):
    bl_label = "Recording"

    def draw(self, context):
        self.layout.operator("depthmocap.import_motion", icon="IMPORT")


class DEPTHMOCAP_PT_retarget(DepthmocapPanel, bpy.types.Panel):
    bl_label = "Retarget"

    def draw(self, context):
        layout, settings = self.layout, context.scene.depthmocap
        layout.prop(settings, "source")
        layout.prop(settings, "target")
        layout.prop(settings, "preset")
        layout.operator("depthmocap.retarget", icon="ACTION")
        layout.operator("depthmocap.follow", icon="LINKED", depress=Follower.current is not None)


CLASSES = (DEPTHMOCAP_PT_live, DEPTHMOCAP_PT_pose, DEPTHMOCAP_PT_import, DEPTHMOCAP_PT_retarget)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
