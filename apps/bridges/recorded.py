#!/usr/bin/env python3
"""Sends the depth of a recording that another program made to depthmocap. Needs numpy, and of the packages lz4, mcap,
mcap-protobuf-support and av those that the file asks for.

    python3 recorded.py take.bag | depthmocap record --source pipe:- --out take
    python3 recorded.py take.bag | depthmocap live --source pipe:- --joints take.csv

.bag   ROS 1, RealSense's of old        .db3   ROS 2, RealSense's of new
.mcap  ROS 1 and 2, Foxglove               .mkv   Azure Kinect, Orbbec Femto
"""
import argparse
import importlib
import json
import sys
from pathlib import Path

from frame_pipe import FRAMES_OUT, FramePipe, run  # first: it keeps standard output for the frames

from recorded_choice import Survey, shown
from recorded_messages import Cut, Lens

READERS = ("recorded_bag", "recorded_db3", "recorded_mcap", "recorded_mkv")
ENDINGS = (".db3", ".mcap")  # of the files in the folder that ROS 2 writes
LATEST_NS = 4 * 10**18  # after the first picture: what the pipe takes


def file_of(path):
    """The file itself, or the one in a folder of ROS 2."""
    if not path.is_dir():
        return path
    inside = sorted(file for file in path.iterdir() if file.suffix in ENDINGS)
    if len(inside) != 1:
        raise RuntimeError(f"{path} holds {len(inside)} files {' or '.join(ENDINGS)}; name one")
    return inside[0]


def reader_of(path):
    with open(path, "rb") as file:
        start = file.read(16)
    for name in READERS:
        module = importlib.import_module(name)
        if start.startswith(module.MAGIC):
            return module.messages
    raise RuntimeError(f"{path} " + ("is empty" if not start else "is no .bag (version 2.0), .db3, .mcap or .mkv"))


def camera_file(path):
    """Lens and depth unit of a file in the form of recording.json."""
    try:
        text = json.loads(path.read_text())
        k = text["intrinsics"]
        lens = Lens(int(text["width"]), int(text["height"]), tuple(float(k[name]) for name in ("fx", "fy", "cx", "cy")),
                    tuple(map(float, k.get("distortion") or ())))
        return lens, text.get("depth_unit_m")
    except (OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise RuntimeError(f"{path} is no camera in the form of a recording.json: "
                           f"{getattr(error, 'strerror', None) or error}") from None


class Sender:
    """Sends pictures whose times grow; counts what it leaves out."""

    def __init__(self, form, lens, straight, fps, unit_m, name):
        self._like = form, lens.width, lens.height
        self._lens = lens
        self._options = dict(fps=fps, depth_unit_m=unit_m, camera=name, waits=True,
                             distortion=() if straight else lens.distortion)
        self._k = lens.straight if straight else lens.taken
        self._pipe = self._first_ns = self._last_ns = None
        self.sent = self.damaged = self.late = 0

    def send(self, message):
        try:
            picture = message.read()
            if (picture.form, picture.width, picture.height) != self._like:
                raise ValueError("another kind of picture")
            steps = picture.steps()
        except ValueError:
            self.damaged += 1
            return
        time_ns = picture.time_ns or message.time_ns
        if self._pipe is None:
            self._pipe = FramePipe(self._lens.width, self._lens.height, *self._k, **self._options)
            self._first_ns = time_ns
        elif not self._last_ns < time_ns < self._first_ns + LATEST_NS:
            self.late += 1
            return
        self._pipe.write(self.sent, (time_ns - self._first_ns) / 1e9, steps)
        self._last_ns = time_ns
        self.sent += 1

    def warnings(self):
        return ([f"{self.damaged} damaged or other pictures are left out"] * (self.damaged > 0) +
                [f"{self.late} pictures whose times do not grow are left out"] * (self.late > 0))


def lens_and_unit(survey, topic, camera):
    """Lens, metres a step, and who tells them."""
    size = topic.picture.width, topic.picture.height
    unit_m = survey.unit_m(topic)
    if camera:
        lens, told_m = camera_file(camera)
        if (lens.width, lens.height) != size:
            raise RuntimeError(f"{camera} is of {lens.width} x {lens.height}, "
                               f"the pictures are of {size[0]} x {size[1]}")
        return lens, unit_m if topic.picture.form == "32FC1" or told_m is None else told_m, camera
    name = survey.lens_topic(topic)
    lens = survey.lenses.get(name)
    if lens is None or lens.problem:
        why = lens.problem if lens else f"the file tells no intrinsics for {size[0]} x {size[1]}{survey.why()}"
        raise RuntimeError(f"{survey.path}: {why}; give --camera FILE, in the form of a recording.json")
    return lens, unit_m, shown(name)


def say(text):
    print("recorded: " + text, file=sys.stderr)


def send(args):
    path = file_of(args.file)
    messages = reader_of(path)
    survey = Survey(messages, path, whole=args.list)
    if args.list:
        FRAMES_OUT.write("".join(line + "\n" for line in survey.lines()).encode())
        FRAMES_OUT.flush()
        return
    topic = survey.depth_topic(args.topic)
    lens, unit_m, told_by = lens_and_unit(survey, topic, args.camera)
    straight = bool(lens.straight) and "rect" in topic.name
    say(f"depth of {shown(topic.name)}, {lens.width} x {lens.height} at {topic.fps():.4g} per second; lens of {told_by}")
    sender = Sender(topic.picture.form, lens, straight, topic.fps(), unit_m, path.name)
    warnings = []
    try:
        for message in messages(path):
            if message.topic == topic.name and message.read:
                sender.send(message)
    except Cut as cut:
        warnings.append(f"{path} is damaged or cut short ({shown(str(cut))}); what came before is sent")
    warnings += sender.warnings()
    if sender.sent == 0:
        raise RuntimeError(f"{path} holds no whole picture" + "".join("; " + warning for warning in warnings))
    if warnings:
        say(f"warning: {'; '.join(warnings)}")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("file", type=Path, help="the recording; of ROS 2 also its folder")
    options.add_argument("--topic", help="the topic or track of the depth, where the file has several")
    options.add_argument("--camera", type=Path, metavar="FILE", help="intrinsics and depth unit, as in a recording.json")
    options.add_argument("--list", action="store_true", help="what is in the file, and what would be taken")
    args = options.parse_args()
    run(lambda: send(args), "recorded")


if __name__ == "__main__":
    main()
