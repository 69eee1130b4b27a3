"""Whole-body motion capture with one depth camera.

    import depthmocap
    for frame in depthmocap.track("recordings/walk"):
        print(frame.time_s, frame.state, frame.joints[depthmocap.JOINTS.index("left_knee")])

Metres, radians and seconds. Camera frame: x right, y down, z forward; world: y up. Arrays are numpy's.
"""
from ._core import (
    BONES,
    DOFS,
    JOINTS,
    PARTS,
    Actor,
    CameraModel,
    Error,
    Frame,
    FrameStream,
    Ik,
    IkSolution,
    Markers,
    Recording,
    RecordingWriter,
    Repaired,
    Tracker,
    __version__,
    calibrate,
    cameras,
    live,
    read_joints,
    read_pose,
    repair,
    track,
    write_joints,
    write_pose,
)

__all__ = [
    "BONES", "DOFS", "JOINTS", "PARTS", "Actor", "CameraModel", "Error", "Frame", "FrameStream", "Ik", "IkSolution",
    "Markers", "Recording", "RecordingWriter", "Repaired", "Tracker", "__version__", "calibrate", "cameras", "live",
    "read_joints", "read_pose", "repair", "track", "write_joints", "write_pose",
]
