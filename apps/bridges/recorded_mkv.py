"""Depth of an .mkv, as the recorders of Azure Kinect and Orbbec's Femto write it: 16-bit pictures, calibration beside."""
import json
from functools import partial

from recorded_messages import Cut, Lens, Message, Picture, need

MAGIC = b"\x1aE\xdf\xa3"
CALIBRATION = "calibration.json"  # the attachment's name
# Of each size of depth pictures: pixels of the whole sensor at that binning, and what is cut off left and above (Azure
# Kinect Sensor SDK: NFOV binned and not, WFOV binned and not).
MODES = {(320, 288): (512, 96, 90), (640, 576): (1024, 192, 180), (512, 512): (512, 0, 0), (1024, 1024): (1024, 0, 0)}


def azure_lens(text, width, height):
    """The depth camera's lens. Sensor units become pixels whose centres are whole numbers."""
    try:
        cameras = json.loads(text.decode("utf-8-sig"))["CalibrationInformation"]["Cameras"]
        depth, = (camera["Intrinsics"] for camera in cameras if camera["Location"] == "CALIBRATION_CameraLocationD0")
        cx, cy, fx, fy, k1, k2, k3, k4, k5, k6, x, y, p2, p1 = map(float, depth["ModelParameters"][:14])
        model = depth["ModelType"]
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        raise ValueError(f"{CALIBRATION} has not the form of Azure Kinect's") from None
    if (width, height) not in MODES:
        raise ValueError(f"Azure Kinect has no depth mode of {width} x {height}")
    sensor, left, above = MODES[width, height]
    brown = model == "CALIBRATION_LensDistortionModelBrownConrady" and x == y == 0
    return Lens(width, height, (fx * sensor, fy * sensor, cx * sensor - left - 0.5, cy * sensor - above - 0.5),
                (k1, k2, p1, p2, k3, k4, k5, k6), problem="" if brown else f"its lens model {model!r} is not known")


def picture(stream, packet, time_ns):
    codec = stream.codec_context

    def load():
        av = need("av", "av")
        try:
            frames = codec.decode(packet)
        except av.FFmpegError as error:
            raise ValueError(f"a picture is damaged: {error}") from None
        if not frames or (frames[0].width, frames[0].height) != (codec.width, codec.height):
            raise ValueError("a picture is damaged")
        return frames[0].to_ndarray()

    return Picture(time_ns, "16UC1", codec.width, codec.height, load)


def calibrations(container, stream):
    """What an attachment tells of a track with depth."""
    width, height = stream.codec_context.width, stream.codec_context.height
    for attachment in container.streams.attachments:
        if attachment.name == CALIBRATION:
            text = bytes(attachment.data)
            yield Message(CALIBRATION, "calibration", 0, lambda: azure_lens(text, width, height))


def messages(path):
    av = need("av", "av")
    av.logging.set_level(av.logging.ERROR)
    av.logging.set_skip_repeated(False)
    try:
        # Errors are caught, not printed: the only word of an end that is missing.
        with av.logging.Capture(local=False) as said, av.open(str(path), format="matroska") as container:
            tracks = {stream.index: (stream.metadata.get("title") or f"track {stream.index}",
                                     stream.codec_context.pix_fmt or "no pictures") for stream in container.streams.video}
            depth = {index for index, (_, form) in tracks.items() if form.startswith("gray16")}
            for index in depth:
                yield from calibrations(container, container.streams[index])
            for packet in container.demux(container.streams.video):
                if packet.size and packet.pts is not None:
                    index = packet.stream.index
                    time_ns = round(packet.pts * packet.time_base * 10**9)
                    read = partial(picture, packet.stream, packet, time_ns) if index in depth else None
                    yield Message(*tracks[index], time_ns, read)
            if any("prematurely" in text for _, _, text in said):
                raise Cut("the end is missing")
    except av.FFmpegError as error:
        raise Cut(error.strerror or "it is damaged") from None
