"""Records ten pictures of RealSense's software device by its own recorder: record_realsense.py FILE"""
import sys
import time

import numpy as np
import pyrealsense2 as rs

WIDTH, HEIGHT = 64, 48
device = rs.software_device()
sensor = device.add_sensor("Depth")
lens = rs.intrinsics()
lens.width, lens.height, lens.fx, lens.fy, lens.ppx, lens.ppy = WIDTH, HEIGHT, 60.0, 61.0, 31.5, 23.5
lens.model, lens.coeffs = rs.distortion.brown_conrady, [0, 0, 0, 0, 0]
stream = rs.video_stream()
stream.type, stream.index, stream.uid = rs.stream.depth, 0, 1
stream.width, stream.height = WIDTH, HEIGHT
stream.fps, stream.bpp, stream.fmt, stream.intrinsics = 30, 2, rs.format.z16, lens
profile = sensor.add_video_stream(stream)
sensor.add_read_only_option(rs.option.depth_units, 0.00025)
recorder = rs.recorder(sys.argv[1], device)
recorded = recorder.query_sensors()[0]
recorded.open(recorded.get_stream_profiles()[0])
recorded.start(rs.frame_queue(20))
for number in range(10):
    frame = rs.software_video_frame()
    frame.pixels = np.full((HEIGHT, WIDTH), 1000 + number, np.uint16)
    frame.stride, frame.bpp, frame.timestamp, frame.frame_number = 2 * WIDTH, 2, 5000 + number * 1000 / 30, number
    frame.domain, frame.profile = rs.timestamp_domain.hardware_clock, profile.as_video_stream_profile()
    frame.depth_units = 0.00025
    sensor.on_video_frame(frame)
    time.sleep(0.03)
recorded.stop()
recorded.close()
