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

# Built with a pybind11 before 2.12, arrays of numpy 2 repeat one value: here the time of the first of two frames.
if Markers(["any"], [[[0.0, 0.0, 0.0]]] * 2).times[1] == 0:
    raise ImportError("this build of depthmocap does not know numpy 2: pip install 'numpy<2', or build it with pybind11 2.12")

__all__ = [
    "BONES", "DOFS", "JOINTS", "PARTS", "Actor", "CameraModel", "Error", "Frame", "FrameStream", "Ik", "IkSolution",
    "Markers", "Recording", "RecordingWriter", "Repaired", "Tracker", "__version__", "calibrate", "cameras", "live",
    "read_joints", "read_pose", "repair", "track", "write_joints", "write_pose",
]
