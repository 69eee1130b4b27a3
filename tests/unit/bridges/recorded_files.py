"""Recordings as other programs write them, made of the first pictures of a bundled one by libraries of others."""
import json
import struct
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

WALK = Path(__file__).parents[3] / "recordings/walk"
INFO = "/camera/depth/camera_info"
IMAGE = "/camera/depth/image_raw"


@dataclass
class Take:
    """Pictures [mm], their times [ns], and fx fy cx cy."""
    pictures: list
    times_ns: list
    k: tuple

    @property
    def size(self):
        height, width = self.pictures[0].shape
        return width, height


def walk(count):
    depthmocap = pytest.importorskip("depthmocap", reason="the Python package is not built")
    recording = depthmocap.Recording(WALK)
    c = recording.camera
    return Take([np.rint(recording[n] * 1000).astype("<u2") for n in range(count)],
                [round(time_s * 1e9) for time_s in recording.times[:count]], (c.fx, c.fy, c.cx, c.cy))


def small(count=12):
    """Pictures of 8 x 6, each of one value."""
    return Take([np.full((6, 8), 1000 + n, "<u2") for n in range(count)], [n * 33_333_000 for n in range(count)],
                (6.0, 6.5, 3.5, 2.5))


class Ros:
    """Messages of ROS 1 or 2 by rosbags."""

    def __init__(self, version):
        typesys = pytest.importorskip("rosbags.typesys", reason="pip install rosbags")
        self.version = version
        self.store = typesys.get_typestore(typesys.Stores.ROS1_NOETIC if version == 1 else typesys.Stores.ROS2_HUMBLE)

    def type(self, name):
        return self.store.types[name]

    def header(self, time_ns):
        stamp = self.type("builtin_interfaces/msg/Time")(*divmod(time_ns, 10**9))
        names = dict(seq=0) if self.version == 1 else {}
        return self.type("std_msgs/msg/Header")(**names, stamp=stamp, frame_id="depth")

    def image(self, picture, time_ns, form="16UC1", pad=0, big=False):
        height, width = picture.shape
        kind = picture.dtype.newbyteorder(">" if big else "<")
        row = picture.astype(kind).view(np.uint8).reshape(height, -1)
        data = np.pad(row, ((0, 0), (0, pad)))
        return self.type("sensor_msgs/msg/Image")(self.header(time_ns), height, width, form, big, data.shape[1],
                                                  data.reshape(-1))

    def info(self, take, model="plumb_bob", d=(0, 0, 0, 0, 0), k=None):
        width, height = take.size
        fx, fy, cx, cy = take.k if k is None else k
        K = np.array([fx, 0, cx, 0, fy, cy, 0, 0, 1.0])
        P = np.array([fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1.0, 0])
        parts = [np.array(d, float), K, np.eye(3).reshape(-1), P]
        roi = self.type("sensor_msgs/msg/RegionOfInterest")(0, 0, 0, 0, False)
        return self.type("sensor_msgs/msg/CameraInfo")(self.header(0), height, width, model, *parts, 0, 0, roi)

    def pack(self, message):
        serialize = self.store.serialize_ros1 if self.version == 1 else self.store.serialize_cdr
        return bytes(serialize(message, message.__msgtype__))


def topics_of(ros, take, image=IMAGE, **options):
    """(topic, time, message): the lens, then the pictures."""
    return [(INFO, 0, ros.info(take)), *((image, time, ros.image(picture, time + 10**18, **options))
                                         for picture, time in zip(take.pictures, take.times_ns))]


def write_bag(path, messages, compression=None):
    ros = Ros(1)
    rosbag1 = pytest.importorskip("rosbags.rosbag1")
    writer = rosbag1.Writer(path)
    if compression:
        writer.set_compression(rosbag1.Writer.CompressionFormat[compression.upper()])
    with writer:
        connections = {}
        for topic, time_ns, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, message.__msgtype__, typestore=ros.store)
            writer.write(connections[topic], time_ns + 10**18, ros.pack(message))
    return path


def write_db3(path, messages):
    ros = Ros(2)
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    with rosbag2.Writer(path, version=9, storage_plugin=rosbag2.StoragePlugin.SQLITE3) as writer:
        connections = {}
        for topic, time_ns, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, message.__msgtype__, typestore=ros.store)
            writer.write(connections[topic], time_ns + 10**18, ros.pack(message))
    return path


def write_mcap(path, messages, compression="ZSTD", chunk_size=1 << 20, version=2):
    ros = Ros(version)
    mcap = pytest.importorskip("mcap.writer", reason="pip install mcap")
    with open(path, "wb") as file:
        writer = mcap.Writer(file, compression=mcap.CompressionType[compression], chunk_size=chunk_size)
        writer.start()
        channels = {}
        for topic, time_ns, message in messages:
            if topic not in channels:
                schema = writer.register_schema(message.__msgtype__, "ros2msg", b"")
                channels[topic] = writer.register_channel(topic, "cdr" if version == 2 else "ros1", schema)
            writer.add_message(channels[topic], time_ns, ros.pack(message), time_ns)
        writer.finish()
    return path


def write_foxglove(path, take):
    foxglove = pytest.importorskip("foxglove", reason="pip install foxglove-sdk")
    pytest.importorskip("mcap_protobuf", reason="pip install mcap-protobuf-support")
    messages = pytest.importorskip("foxglove.messages")
    width, height = take.size
    fx, fy, cx, cy = take.k
    with foxglove.open_mcap(path):
        foxglove.log("/depth/calibration", messages.CameraCalibration(
            width=width, height=height, K=[fx, 0, cx, 0, fy, cy, 0, 0, 1]), log_time=1)
        for picture, time_ns in zip(take.pictures, take.times_ns):
            foxglove.log("/depth/image", messages.RawImage(
                timestamp=messages.Timestamp(*divmod(time_ns + 10**18, 10**9)), width=width, height=height,
                encoding="16UC1", step=2 * width, data=picture.tobytes()), log_time=time_ns + 1)
    return path


def write_foxglove_json(path, take):
    import base64
    mcap = pytest.importorskip("mcap.writer", reason="pip install mcap")
    width, height = take.size
    fx, fy, cx, cy = take.k
    lens = dict(width=width, height=height, distortion_model="", D=[], K=[fx, 0, cx, 0, fy, cy, 0, 0, 1], R=[], P=[])
    with open(path, "wb") as file:
        writer = mcap.Writer(file)
        writer.start()
        channels = [writer.register_channel(topic, "json", writer.register_schema(f"foxglove.{kind}", "jsonschema", b"{}"))
                    for topic, kind in (("/depth/calibration", "CameraCalibration"), ("/depth/image", "RawImage"))]
        writer.add_message(channels[0], 0, json.dumps(lens).encode(), 0)
        for picture, time_ns in zip(take.pictures, take.times_ns):
            sec, nsec = divmod(time_ns + 10**18, 10**9)
            image = dict(timestamp=dict(sec=sec, nsec=nsec), width=width, height=height, encoding="16UC1", step=2 * width,
                         data=base64.b64encode(picture.tobytes()).decode())
            writer.add_message(channels[1], time_ns, json.dumps(image).encode(), time_ns)
        writer.finish()
    return path


def azure_calibration(take, sensor=1024, left=192, above=180, distortion=(0,) * 8,
                      model="CALIBRATION_LensDistortionModelBrownConrady"):
    """calibration.json of Azure Kinect; distortion: k1 to k6, p1, p2."""
    fx, fy, cx, cy = take.k
    k = distortion
    numbers = [(cx + left + 0.5) / sensor, (cy + above + 0.5) / sensor, fx / sensor, fy / sensor, *k[:6], 0, 0, k[7], k[6]]
    depth = {"Location": "CALIBRATION_CameraLocationD0",
             "Intrinsics": {"ModelParameterCount": 14, "ModelParameters": numbers, "ModelType": model}}
    colour = {"Location": "CALIBRATION_CameraLocationPV0", "Intrinsics": {"ModelParameters": []}}
    return json.dumps({"CalibrationInformation": {"Cameras": [colour, depth]}}).encode()


def write_mkv(path, take, calibration):
    """Tracks IR and DEPTH, as k4arecorder writes them: b16g, positive height in the header of the codec."""
    av = pytest.importorskip("av", reason="pip install av")
    width, height = take.size
    microseconds = Fraction(1, 10**6)
    with av.open(str(path), "w", format="matroska", options={"allow_raw_vfw": "1"}) as container:
        streams = []
        for name in ("IR", "DEPTH"):
            stream = container.add_stream("rawvideo", rate=30)
            stream.width, stream.height, stream.pix_fmt = width, height, "gray16be"
            stream.codec_context.time_base = microseconds
            stream.metadata["title"] = name
            streams.append(stream)
        if calibration:
            container.add_attachment("calibration.json", "application/octet-stream", calibration)
        for picture, time_ns in zip(take.pictures, take.times_ns):
            for stream, values in zip(streams, (np.full_like(picture, 7), picture)):
                frame = av.VideoFrame.from_ndarray(values, format="gray16le").reformat(format="gray16be")
                frame.pts, frame.time_base = time_ns // 1000, microseconds
                container.mux(stream.encode(frame))
    # FFmpeg writes no name of the pixels' form and a height below 0.
    data = path.read_bytes()
    written, meant = (struct.pack("<Iii", 40, width, sign * height) for sign in (-1, 1))
    for _ in streams:
        at = data.index(written)
        data = data[:at] + meant + struct.pack("<HH", 1, 16) + b"b16g" + data[at + 20:]
    path.write_bytes(data)
    return path
