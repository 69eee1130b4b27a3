#!/usr/bin/env python3
"""Sends the depth of a Kinect of 2013 to depthmocap. Needs libfreenect2 and: pip install pylibfreenect2 numpy

    python3 kinect2.py | depthmocap live --source pipe:- --view
"""
from frame_pipe import FramePipe, run  # first: it keeps standard output for the frames

import numpy as np
from pylibfreenect2 import Freenect2, FrameType, SyncMultiFrameListener

WIDTH, HEIGHT = 512, 424
CLOCK_HZ = 8000  # of the camera's time stamps, 0.125 ms


def send():
    freenect = Freenect2()
    if freenect.enumerateDevices() == 0:
        raise RuntimeError("no camera found; it needs USB 3 and libfreenect2's udev rules")
    device = freenect.openDefaultDevice()
    listener = SyncMultiFrameListener(FrameType.Depth)
    device.setIrAndDepthFrameListener(listener)
    device.startStreams(rgb=False, depth=True)
    try:
        lens = device.getIrCameraParams()
        # libfreenect2 mirrors pictures left to right, and its intrinsics are theirs.
        pipe = FramePipe(WIDTH, HEIGHT, lens.fx, lens.fy, WIDTH - 1 - lens.cx, lens.cy,
                         distortion=(lens.k1, lens.k2, lens.p1, -lens.p2, lens.k3), camera="kinect2")
        while True:
            frames = listener.waitForNewFrame()
            depth = frames[FrameType.Depth]
            millimetres = np.nan_to_num(depth.asarray()).clip(0, 65535)
            pipe.write(depth.sequence, depth.timestamp / CLOCK_HZ, millimetres[:, ::-1].astype("<u2"))
            listener.release(frames)
    finally:
        device.stop()
        device.close()


if __name__ == "__main__":
    run(send, "kinect2")
