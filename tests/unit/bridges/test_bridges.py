"""The bridges without cameras: what they send is what docs/reference/pipe.md says."""
import json
import os
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

BRIDGES = Path(__file__).parents[3] / "apps/bridges"
WIDTH, HEIGHT = 64, 48


@pytest.fixture(scope="module")
def bridges():
    sys.path.insert(0, str(BRIDGES))
    yield
    sys.path.remove(str(BRIDGES))


def split(stream):
    """The header and (number, seconds, picture) of each frame."""
    line, _, rest = stream.partition(b"\n")
    frames = []
    while rest:
        mark, size, number, time_s = struct.unpack("<4sIqd", rest[:24])
        assert mark == b"DMCF"
        frames.append((number, time_s, np.frombuffer(rest[24:24 + size], "<u2")))
        rest = rest[24 + size:]
    return json.loads(line), frames


# A process of its own: frame_pipe takes over standard output.
def sent_by(code):
    program = f"import sys; sys.path.insert(0, {str(BRIDGES)!r})\n{code}"
    return subprocess.run([sys.executable, "-c", program], capture_output=True, check=True).stdout


def test_frames_arrive_as_they_were_written():
    header, frames = split(sent_by("""
from frame_pipe import FramePipe
import numpy as np
print("a camera's library greets")
pipe = FramePipe(4, 3, 5.0, 5.0, 1.5, 1.0, fps=15, depth_unit_m=0.002, camera="mine")
for n in range(2):
    pipe.write(n, n / 15, np.arange(12, dtype=np.uint16) + n)
"""))
    assert header["width"] == 4 and header["height"] == 3 and header["depth_unit_m"] == 0.002
    assert [number for number, _, _ in frames] == [0, 1]
    assert (frames[1][2] == np.arange(12) + 1).all()


def test_distortion_is_taken_out():
    header, frames = split(sent_by("""
from frame_pipe import FramePipe
import numpy as np
pipe = FramePipe(65, 65, 60.0, 60.0, 32.0, 32.0, distortion=(0.2, 0, 0, 0, 0))
taken = np.tile(np.arange(65, dtype=np.uint16), (65, 1)) + 1
pipe.write(0, 0.0, taken)
"""))
    assert "distortion" not in header["intrinsics"]
    row = frames[0][2].reshape(65, 65)[32]
    assert row[32] == 33  # the centre stays
    x = (52 - 32) / 60  # a pixel right of it comes from farther out
    assert row[52] == 1 + round(32 + 60 * x * (1 + 0.2 * x * x))


def test_a_picture_of_another_size_is_refused():
    code = "from frame_pipe import FramePipe; import numpy as np; FramePipe(4, 3, 5, 5, 1, 1).write(0, 0, np.zeros(11))"
    with pytest.raises(subprocess.CalledProcessError):
        sent_by(code)


def test_realsense_sends_what_its_software_device_gives():
    pytest.importorskip("pyrealsense2", reason="pip install pyrealsense2")
    header, frames = split(sent_by(f"""
import threading, time
from realsense import send
import numpy as np, pyrealsense2 as rs
device = rs.software_device()
sensor = device.add_sensor("Depth")
lens = rs.intrinsics()
lens.width, lens.height, lens.fx, lens.fy, lens.ppx, lens.ppy = {WIDTH}, {HEIGHT}, 60.0, 61.0, 31.5, 23.5
lens.model, lens.coeffs = rs.distortion.brown_conrady, [0, 0, 0, 0, 0]
stream = rs.video_stream()
stream.type, stream.index, stream.uid, stream.width, stream.height = rs.stream.depth, 0, 1, {WIDTH}, {HEIGHT}
stream.fps, stream.bpp, stream.fmt, stream.intrinsics = 30, 2, rs.format.z16, lens
profile = sensor.add_video_stream(stream)
sensor.add_read_only_option(rs.option.depth_units, 0.001)
over = threading.Event()
def feed():
    number = 0
    while not over.is_set():
        frame = rs.software_video_frame()
        frame.pixels = np.full(({HEIGHT}, {WIDTH}), 1000 + number, np.uint16)
        frame.stride, frame.bpp, frame.timestamp, frame.frame_number = 2 * {WIDTH}, 2, number * 1000 / 30, number
        frame.domain, frame.profile, frame.depth_units = rs.timestamp_domain.hardware_clock, profile.as_video_stream_profile(), 0.001
        sensor.on_video_frame(frame)
        number += 1
        time.sleep(0.01)
feeder = threading.Thread(target=feed)
feeder.start()
send(sensor, "software", frames=5)
over.set(); feeder.join()
"""))
    assert header["intrinsics"] == {"fx": 60.0, "fy": 61.0, "cx": 31.5, "cy": 23.5}
    assert header["depth_unit_m"] == pytest.approx(0.001)
    assert len(frames) == 5
    for number, time_s, picture in frames:
        assert (picture == 1000 + number).all()
        assert time_s == pytest.approx(number / 30)


def test_orbbec_uses_functions_that_its_library_has():
    sdk = pytest.importorskip("pyorbbecsdk", reason="pip install pyorbbecsdk2")
    wanted = {"Pipeline": ["get_stream_profile_list", "start", "wait_for_frames", "stop", "get_device"],
              "VideoStreamProfile": ["get_intrinsic", "get_distortion", "get_fps"],
              "DepthFrame": ["get_depth_scale", "get_index", "get_timestamp_us", "get_data"],
              "StreamProfileList": ["get_video_stream_profile", "get_default_video_stream_profile"],
              "OBCameraDistortion": ["k1", "k6", "p1", "p2"]}
    for name, functions in wanted.items():
        for function in functions:
            assert hasattr(getattr(sdk, name), function), f"{name}.{function}"


def test_a_missing_camera_is_one_line():
    pytest.importorskip("pyrealsense2", reason="pip install pyrealsense2")
    done = subprocess.run([sys.executable, BRIDGES / "realsense.py"], capture_output=True, text=True)
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr.splitlines()[-1].startswith("realsense: no camera found")


@pytest.mark.skipif("DEPTHMOCAP_PROGRAM" not in os.environ, reason="DEPTHMOCAP_PROGRAM names no program to send to")
def test_frames_through_the_pipe_are_tracked_as_recorded(tmp_path):
    pytest.importorskip("depthmocap", reason="the Python package is not built")
    recording = BRIDGES.parents[1] / "recordings/squat"
    program = os.environ["DEPTHMOCAP_PROGRAM"]
    sender = f"""
import sys; sys.path.insert(0, {str(BRIDGES)!r})
from frame_pipe import FramePipe
import depthmocap, numpy as np
recording = depthmocap.Recording({str(recording)!r})
c = recording.camera
pipe = FramePipe(c.width, c.height, c.fx, c.fy, c.cx, c.cy, fps=recording.fps, waits=True)
for i, time_s in enumerate(recording.times[:20]):
    pipe.write(i, time_s, np.rint(recording[i] * 1000).astype("<u2"))
"""
    with subprocess.Popen([sys.executable, "-c", sender], stdout=subprocess.PIPE) as sending:
        live = subprocess.run([program, "live", "--source", "pipe:-", "--joints", tmp_path / "live.csv"],
                              stdin=sending.stdout, capture_output=True, text=True)
    assert live.returncode == 0, live.stderr
    subprocess.run([program, "replay", recording, "--last", "19", "--look-ahead", "0", "--passes", "1",
                    "--joints", tmp_path / "replay.csv"],
                   check=True, capture_output=True)
    assert (tmp_path / "live.csv").read_bytes() == (tmp_path / "replay.csv").read_bytes()
