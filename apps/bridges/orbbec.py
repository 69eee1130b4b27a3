#!/usr/bin/env python3
"""Sends the depth of an Orbbec camera (Femto, Gemini, Astra 2) to depthmocap. Needs: pip install pyorbbecsdk2 numpy

    python3 orbbec.py | depthmocap live --source pipe:- --view
"""
import argparse

from frame_pipe import FramePipe, run  # first: it keeps standard output for the frames

import numpy as np
from pyorbbecsdk import Config, OBFormat, OBSensorType, Pipeline

PATIENCE_MS = 5000  # for one frame


def choose_profile(pipeline, width, height, fps):
    """The mode that was asked for, or the camera's own choice."""
    profiles = pipeline.get_stream_profile_list(OBSensorType.DEPTH_SENSOR)
    if width:
        return profiles.get_video_stream_profile(width, height, OBFormat.Y16, fps)
    return profiles.get_default_video_stream_profile()


def send(args):
    pipeline = Pipeline()
    profile = choose_profile(pipeline, args.width, args.height, args.fps)
    config = Config()
    config.enable_stream(profile)
    pipeline.start(config)
    try:
        lens = profile.get_intrinsic()
        d = profile.get_distortion()
        name = pipeline.get_device().get_device_info().get_name()
        pipe = None
        while True:
            frames = pipeline.wait_for_frames(PATIENCE_MS)
            frame = frames.get_depth_frame() if frames else None
            if frame is None:
                raise RuntimeError(f"no frame within {PATIENCE_MS / 1000:g} s")
            if pipe is None:  # the unit comes with the first frame, in millimetres
                pipe = FramePipe(lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy, fps=profile.get_fps(),
                                 depth_unit_m=frame.get_depth_scale() / 1000,
                                 distortion=(d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6),
                                 camera=name)
            pipe.write(frame.get_index(), frame.get_timestamp_us() / 1e6, np.frombuffer(frame.get_data(), dtype="<u2"))
    finally:
        pipeline.stop()


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--width", type=int, default=0, help="0: the camera's own choice")
    options.add_argument("--height", type=int, default=0)
    options.add_argument("--fps", type=int, default=30)
    args = options.parse_args()
    run(lambda: send(args), "orbbec")


if __name__ == "__main__":
    main()
