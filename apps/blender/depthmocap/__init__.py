"""depthmocap in Blender: live motion, results of recordings, poses by handles, retargeting."""
bl_info = {
    "name": "depthmocap",
    "author": "depthmocap",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > depthmocap",
    "description": "Motion capture with one depth camera, poses by handles",
    "category": "Animation",
}

from . import importing, live, panel, posing, retargeting, settings

MODULES = (settings, live, importing, posing, retargeting, panel)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
