#!/usr/bin/env python3
"""Sends the depth of an Azure Kinect to depthmocap. Needs Microsoft's libk4a1.4 and: pip install pyk4a numpy

    python3 azure_kinect.py | depthmocap live --source pipe:- --view
"""
from frame_pipe import FramePipe, run  # first: it keeps standard output for the frames

from pyk4a import CalibrationType, Config, DepthMode, FPS, PyK4A

# The narrow view, binned by nothing: 640 x 576 at 30 per second, to 3.9 m.
MODE = DepthMode.NFOV_UNBINNED


def send():
    camera = PyK4A(Config(depth_mode=MODE, camera_fps=FPS.FPS_30))
    camera.start()
    try:
        matrix = camera.calibration.get_camera_matrix(CalibrationType.DEPTH)
        coefficients = camera.calibration.get_distortion_coefficients(CalibrationType.DEPTH)
        pipe = None
        number = 0
        while True:
            capture = camera.get_capture()
            if capture.depth is None:
                continue
            if pipe is None:
                height, width = capture.depth.shape
                pipe = FramePipe(width, height, matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2],
                                 distortion=coefficients, camera="azure")
            pipe.write(number, capture.depth_timestamp_usec / 1e6, capture.depth)
            number += 1
    finally:
        camera.stop()


if __name__ == "__main__":
    run(send, "azure_kinect")
