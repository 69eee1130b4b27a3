#!/usr/bin/env python3
"""Sends the depth of an Intel RealSense camera to depthmocap. Needs: pip install pyrealsense2 numpy

    python3 realsense.py | depthmocap live --source pipe:- --view
"""
import argparse

from frame_pipe import FramePipe, run  # first: it keeps standard output for the frames

import numpy as np
import pyrealsense2 as rs

PATIENCE_MS = 5000  # for one frame


def choose_profile(sensor, width, height, fps):
    """The depth mode nearest to the one asked for, by the number of pixels first."""
    modes = [profile.as_video_stream_profile() for profile in sensor.get_stream_profiles()
             if profile.stream_type() == rs.stream.depth and profile.format() == rs.format.z16]
    if not modes:
        raise RuntimeError("the sensor has no depth mode")
    return min(modes, key=lambda m: (abs(m.width() * m.height() - width * height), abs(m.width() - width), abs(m.fps() - fps)))


def send(sensor, name, width=640, height=480, fps=30, file=None, frames=None):
    """Frames of a depth sensor until there are `frames` of them (None: for ever)."""
    profile = choose_profile(sensor, width, height, fps)
    lens = profile.get_intrinsics()
    pipe = FramePipe(lens.width, lens.height, lens.fx, lens.fy, lens.ppx, lens.ppy, fps=profile.fps(),
                     depth_unit_m=sensor.get_option(rs.option.depth_units), distortion=lens.coeffs, camera=name,
                     file=file)
    queue = rs.frame_queue(2)
    sensor.open(profile)
    sensor.start(queue)
    try:
        sent = 0
        while frames is None or sent < frames:
            frame = queue.wait_for_frame(PATIENCE_MS)
            pipe.write(frame.get_frame_number(), frame.get_timestamp() / 1000, np.asanyarray(frame.get_data()))
            sent += 1
    finally:
        sensor.stop()
        sensor.close()


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--width", type=int, default=640)
    options.add_argument("--height", type=int, default=480)
    options.add_argument("--fps", type=int, default=30)
    options.add_argument("--serial", help="of the camera, where several are plugged in")
    args = options.parse_args()

    def start():
        devices = [device for device in rs.context().query_devices()
                   if args.serial in (None, device.get_info(rs.camera_info.serial_number))]
        if not devices:
            raise RuntimeError("no camera found; is it plugged in, and do its udev rules let you use it?")
        send(devices[0].first_depth_sensor(), devices[0].get_info(rs.camera_info.name), args.width, args.height, args.fps)

    run(start, "realsense")


if __name__ == "__main__":
    main()
