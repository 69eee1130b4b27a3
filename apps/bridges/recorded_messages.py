"""Depth pictures, lenses and depth units in the messages of ROS 1, ROS 2 and Foxglove."""
import base64
import importlib
import json
import math
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

# Pixels of a picture: the limit of depthmocap, more than any depth camera has.
MOST_PIXELS = 3840 * 2160
# Bytes of one record or unpacked chunk of a file: four pictures of 3840 x 2160 in metres; chunks have 1 to 10 MB.
MOST_BYTES = 1 << 27
# How a pixel is stored, by the name that ROS and Foxglove have for it: steps of 16 bits, or metres.
DEPTH_FORMS = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}
# The names of OpenCV's lens model, k1 k2 p1 p2 k3 k4 k5 k6, in ROS and in RealSense's files.
LENS_MODELS = ("", "plumb_bob", "rational_polynomial", "Brown Conrady", "None")


class Cut(Exception):
    """The file ends too early or is damaged from here on; what came before it is good."""


class MissingPackage(Exception):
    """A package that this file needs is not installed."""


@dataclass
class Picture:
    """time_ns: 0 where the message does not tell it. load: gives an array of (height, width)."""
    time_ns: int
    form: str
    width: int
    height: int
    load: Callable[[], np.ndarray]

    def check(self):
        if not (self.width > 0 and self.height > 0 and self.width * self.height <= MOST_PIXELS):
            raise ValueError(f"pictures of {self.width} x {self.height} are not read")

    def steps(self):
        """16-bit steps; metres become millimetres, and what is not positive or too far 0."""
        self.check()
        values = self.load()
        if self.form != "32FC1":
            return values
        with np.errstate(invalid="ignore", over="ignore"):
            millimetres = np.rint(values * np.float32(1000))
            return np.where((millimetres > 0) & (millimetres < 65536), millimetres, 0).astype(np.uint16)


@dataclass
class Lens:
    """straight: fx fy cx cy of rectified pictures, if there are such."""
    width: int
    height: int
    taken: tuple
    distortion: tuple = ()
    straight: tuple = ()
    problem: str = ""


@dataclass
class DepthUnit:
    metres: float


@dataclass
class Message:
    """read: gives a Picture, a Lens or a DepthUnit, and may raise ValueError; None: the type says nothing of depth."""
    topic: str
    type: str
    time_ns: int
    read: Callable[[], Any] | None


def need(module, package):
    """A module of a package that only some files need."""
    try:
        return importlib.import_module(module)
    except ImportError:
        raise MissingPackage(f"this file needs a package that is missing: pip install {package}") from None


def rows(data, form, width, height, step, big_endian):
    """The pixels of a picture whose rows are `step` bytes apart."""
    kind = np.dtype((">" if big_endian else "<") + DEPTH_FORMS[form])
    size = kind.itemsize * width
    if step < size or len(data) < step * (height - 1) + size:
        raise ValueError("a picture has too few bytes")
    strides = (step, kind.itemsize)
    return np.ndarray((height, width), kind, data, strides=strides).astype(kind.newbyteorder("="))


def raw_picture(time_ns, form, width, height, step, big_endian, data):
    return Picture(time_ns, form, width, height, lambda: rows(data, form, width, height, step, big_endian))


def lens_of(width, height, model, d, k, p):
    d = tuple(d)
    problem = ""
    if any(d) and (model not in LENS_MODELS or any(d[8:])):
        problem = f"its lens model {model[:40]!r} is not known"
    if not all(map(math.isfinite, (*d, *k, *p))) or k[0] <= 0 or k[4] <= 0:
        problem = "its lens was not calibrated"
    straight = (p[0], p[5], p[2], p[6]) if len(p) == 12 and p[0] > 0 else ()
    return Lens(width, height, (k[0], k[4], k[2], k[5]), d[:8], straight, problem)


def png_picture(time_ns, form, data):
    start = bytes(data).find(b"\x89PNG\r\n\x1a\n")
    if not form.startswith("16UC1") or start < 0 or len(data) < start + 24:
        raise ValueError(f"compressed pictures of the form {form!r} are not read")
    width, height = struct.unpack_from(">II", data, start + 16)

    def load():
        av = need("av", "av")
        decoder = av.CodecContext.create("png", "r")
        decoder.thread_count = 1  # its picture at once
        try:
            frames = decoder.decode(av.Packet(bytes(data[start:]))) or decoder.decode(None)
        except av.FFmpegError as error:
            raise ValueError(f"a PNG is damaged: {error}") from None
        if not frames or (frames[0].width, frames[0].height) != (width, height) or "gray16" not in frames[0].format.name:
            raise ValueError("a PNG holds no 16-bit picture")
        return frames[0].to_ndarray()

    return Picture(time_ns, "16UC1", width, height, load)


class Fields:
    """The fields of a ROS message, one after the other: as ROS 1 packs them, or ROS 2 (CDR)."""

    def __init__(self, data, cdr):
        if cdr and (len(data) < 4 or data[0] != 0 or data[1] > 1):
            raise ValueError("a message is not in the CDR of ROS 2")
        self._order = ">" if cdr and data[1] == 0 else "<"
        self._data = memoryview(data)[4:] if cdr else memoryview(data)
        self._cdr = cdr
        self._at = 0

    def numbers(self, code, count):
        size = struct.calcsize(code)
        if self._cdr and count:
            self._at += -self._at % size
        try:
            values = struct.unpack_from(f"{self._order}{count}{code}", self._data, self._at)
        except struct.error:
            raise ValueError("a message is too short") from None
        self._at += count * size
        return values

    def number(self, code):
        return self.numbers(code, 1)[0]

    def block(self):
        size = self.number("I")
        if size > len(self._data) - self._at:
            raise ValueError("a message is too short")
        self._at += size
        return self._data[self._at - size:self._at]

    def text(self):
        return bytes(self.block()).rstrip(b"\0").decode("utf-8", "replace")

    def header(self):
        """The time stamp of a std_msgs/Header [ns]."""
        if not self._cdr:
            self.number("I")
        seconds, nanoseconds = self.numbers("I", 2)
        self.text()
        return seconds * 10**9 + nanoseconds


def ros_image(fields):
    time_ns = fields.header()
    height, width = fields.numbers("I", 2)
    form, big_endian, step = fields.text(), fields.number("B"), fields.number("I")
    return raw_picture(time_ns, form, width, height, step, big_endian, fields.block())


def ros_compressed(fields):
    time_ns = fields.header()
    return png_picture(time_ns, fields.text(), fields.block())


def ros_camera_info(fields):
    fields.header()
    height, width = fields.numbers("I", 2)
    model, d = fields.text(), fields.numbers("d", fields.number("I"))
    k, _, p = (fields.numbers("d", count) for count in (9, 9, 12))
    return lens_of(width, height, model, d, k, p)


ROS_READERS = {"sensor_msgs/Image": ros_image, "sensor_msgs/CompressedImage": ros_compressed,
               "sensor_msgs/CameraInfo": ros_camera_info}
# RealSense's files tell the step as an option: a number, in the .db3 of newer versions a text.
UNIT_TOPIC = re.compile(r"/option/Depth[_ ]Units/value$")
UNIT_READERS = {"std_msgs/Float32": lambda fields: DepthUnit(float(f"{fields.number('f'):.7g}")),
                "std_msgs/String": lambda fields: DepthUnit(float(fields.text()))}


def ros_message(topic, kind, time_ns, data, cdr):
    kind = kind.replace("/msg/", "/")
    reader = (UNIT_READERS if UNIT_TOPIC.search(topic) else ROS_READERS).get(kind)
    return Message(topic, kind, time_ns, reader and (lambda: reader(Fields(data, cdr))))


def foxglove_image(message):
    time_ns = getattr(message.timestamp, "seconds", 0) * 10**9 + getattr(message.timestamp, "nanos", 0)
    return raw_picture(time_ns, message.encoding, message.width, message.height, message.step, False, message.data)


def foxglove_calibration(m):
    return lens_of(m.width, m.height, m.distortion_model, m.D, m.K, m.P)


FOXGLOVE_READERS = {"foxglove.RawImage": foxglove_image, "foxglove.CameraCalibration": foxglove_calibration}


def foxglove_json(data):
    """A message in JSON with the names that it has as a protocol buffer."""
    fields = json.loads(bytes(data), object_hook=lambda names: SimpleNamespace(**names))
    stamp = getattr(fields, "timestamp", SimpleNamespace())
    fields.timestamp = SimpleNamespace(seconds=getattr(stamp, "sec", 0), nanos=getattr(stamp, "nsec", 0))
    if hasattr(fields, "data"):
        fields.data = base64.b64decode(fields.data)
    return fields


def foxglove_message(topic, kind, time_ns, decode):
    """decode: gives the message, an object with named fields."""
    reader = FOXGLOVE_READERS.get(kind)

    def read():
        try:
            return reader(decode())
        except MissingPackage:
            raise
        except Exception as error:  # noqa: BLE001  what protocol buffers and JSON find wrong has many kinds
            raise ValueError(f"a message is damaged: {error}") from None

    return Message(topic, kind, time_ns, reader and read)
