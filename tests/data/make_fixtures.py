#!/usr/bin/env python3
"""Writes the golden good and damaged files of this folder. Run it again after a change of a format: tests/data/make_fixtures.py"""
import json
import shutil
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
WIDTH, HEIGHT = 6, 4
JOINTS = ("pelvis spine neck head left_shoulder left_elbow left_wrist right_shoulder right_elbow right_wrist "
          "left_hip left_knee left_ankle left_toe right_hip right_knee right_ankle right_toe").split()
DOFS = ("root_tx root_ty root_tz root_rx root_ry root_rz upperback_rx upperback_ry upperback_rz rclavicle_ry rclavicle_rz "
        "lclavicle_ry lclavicle_rz rhumerus_rx rhumerus_ry rhumerus_rz lhumerus_rx lhumerus_ry lhumerus_rz rradius_ry "
        "lradius_ry neck_rx neck_rz head_ry rfemur_rx rfemur_ry rfemur_rz lfemur_rx lfemur_ry lfemur_rz rtibia_rx "
        "ltibia_rx rfoot_rx rfoot_ry lfoot_rx lfoot_ry").split()


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, value, bits=16, color=0):
    """A PNG whose sample at (x, y) is value(x, y); color 0 is grey, 2 is RGB (the sample three times)."""
    sample = {16: ">H", 8: ">B"}[bits]
    rows = b"".join(
        b"\0" + b"".join(struct.pack(sample, value(x, y)) * (3 if color == 2 else 1) for x in range(width))
        for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, color, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def ramp(x, y):
    """The depth picture of every good frame, in steps: 0 at the corner, then unlike at each pixel."""
    return 0 if (x, y) == (0, 0) else 1000 + 10 * y + x


def header(**changes):
    text = {"format": "depthmocap-recording", "version": 1, "width": WIDTH, "height": HEIGHT, "fps": 30.0,
            "depth_unit_m": 0.002, "intrinsics": {"fx": 5.0, "fy": 5.5, "cx": 2.5, "cy": 1.5},
            "camera": "kinect1", "note": "a fixture", "studio": {"room": 7}}
    text.update(changes)
    return {key: value for key, value in text.items() if value is not None}


def intrinsics(**changes):
    return {**header()["intrinsics"], **changes}


GOOD_ROWS = ["0,0.000000,depth/000000.png", "1,0.033333,depth/000001.png", "2,0.066667,depth/000002.png"]


def recording(name, head=None, rows=None, columns="frame,time_s,file", pictures=None):
    folder = HERE / "recordings" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "recording.json").write_text(head if isinstance(head, str) else json.dumps(head or header(), indent=1) + "\n")
    (folder / "frames.csv").write_text("\n".join([columns] + (GOOD_ROWS if rows is None else rows)) + "\n")
    for file, data in (pictures or {}).items():
        (folder / file).parent.mkdir(exist_ok=True)
        (folder / file).write_bytes(data)


def recordings():
    good = png(WIDTH, HEIGHT, ramp)
    recording("good", pictures={f"depth/{i:06d}.png": good for i in range(3)})
    recording("empty", rows=[])
    recording("no_json", head="{\"format\": ")
    recording("no_object", head="[1, 2]")
    recording("wrong_format", header(format="a-movie"))
    recording("future_version", header(version=99))
    recording("no_fps", header(fps=None))
    recording("zero_unit", header(depth_unit_m=0))
    recording("no_width", header(width=None))
    recording("zero_width", header(width=0))
    recording("huge_width", header(width=2000000000))
    recording("no_intrinsics", header(intrinsics=None))
    recording("nan_intrinsics", header(intrinsics=intrinsics(fx=float("nan"))))
    recording("null_intrinsics", header(intrinsics=intrinsics(cx=None)))
    recording("zero_focal_length", header(intrinsics=intrinsics(fy=0)))
    recording("negative_focal_length", header(intrinsics=intrinsics(fx=-525.0)))
    recording("short_distortion", header(intrinsics=intrinsics(distortion=[0.1, 0.2])))
    recording("wrong_columns", columns="time_s,frame,file")
    recording("times_out_of_order", rows=[GOOD_ROWS[0], GOOD_ROWS[2], "3,0.033333,depth/000001.png"])
    recording("same_time_twice", rows=[GOOD_ROWS[0], "1,0.000000,depth/000001.png"])
    recording("short_row", rows=[GOOD_ROWS[0], "1,0.033333"])
    recording("no_number", rows=[GOOD_ROWS[0], "1,soon,depth/000001.png"])
    recording("nan_time", rows=["0,nan,depth/000000.png"])
    recording("path_outside", rows=["0,0.000000,../good/depth/000000.png"])
    recording("path_absolute", rows=["0,0.000000,/good/depth/000000.png"])
    flipped = bytearray(good)
    flipped[len(good) // 2] ^= 0x10
    wide = png(WIDTH + 1, HEIGHT, ramp)
    damaged = {"whole": good, "cut_short": good[:len(good) // 2], "no_end": good[:-12], "flipped_byte": bytes(flipped),
               "eight_bits": png(WIDTH, HEIGHT, lambda x, y: x, bits=8), "colour": png(WIDTH, HEIGHT, ramp, color=2),
               "wrong_size": wide, "no_png": b"frame,time_s,file\n", "empty": b""}
    names = [*damaged, "missing"]
    recording("damaged_pictures", rows=[f"{i},{i / 30:.6f},depth/{name}.png" for i, name in enumerate(names)],
              pictures={f"depth/{name}.png": data for name, data in damaged.items()})


def tum(name, text):
    folder = HERE / "recordings" / name
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "depth").mkdir(parents=True)
    (folder / "depth.txt").write_text(text)
    (folder / "depth/1.png").write_bytes(png(640, 480, lambda x, y: 10000 if y < 240 else 0))


def tum_folders():
    rows = "100.000000 depth/1.png\n100.033333 depth/1.png\n100.133333 depth/1.png\n100.166666 depth/1.png\n"
    tum("tum_freiburg1_fixture", "# depth maps\n# timestamp filename\n" + rows)
    tum("tum_freiburg3_fixture", "# depth maps\n" + rows)
    tum("tum_out_of_order", "100.1 depth/1.png\n100.0 depth/1.png\n")


def joints_row(frame, state):
    start = f"{frame},{frame / 30:.6f},{state}"
    if state == "lost":
        return start + ",,,,0" * len(JOINTS)
    return start + "".join(f",{0.1 * i:.6f},{-0.05 * i:.6f},{2 + 0.01 * frame:.6f},{i / 20:.3f}" for i in range(len(JOINTS)))


def tracks():
    folder = HERE / "tracks"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    head = "frame,time_s,state," + ",".join(f"{joint}_{axis}" for joint in JOINTS for axis in "xyzc")
    rows = [joints_row(0, "tracking"), joints_row(1, "lost"), joints_row(2, "coasting")]

    def joints(name, *lines):
        (folder / f"joints_{name}.csv").write_text("\n".join(lines) + "\n")

    joints("good", head, *rows)
    joints("more_columns", "# a comment", head + ",speed", "", *[row + ",1.5" for row in rows])
    joints("wrong_header", head.replace("left_elbow_x", "left_elbow_u"), *rows)
    joints("short_row", head, rows[0], rows[2][:200])
    joints("no_number", head, rows[0].replace("0.100000", "0.1OOOOO", 1))
    joints("empty_coordinate", head, rows[0].replace("0.100000", "", 1))
    joints("unknown_state", head, rows[0].replace("tracking", "dancing"))
    joints("large_confidence", head, rows[0].replace("0.850", "1.850"))
    joints("frames_out_of_order", head, rows[2], rows[0])
    joints("empty")

    comment = "# world frame: y up, x right, z towards the camera; metres, radians; p_camera = (x, -y, -z)"
    head = "frame,time_s," + ",".join(DOFS)
    rows = [f"{frame},{frame / 30:.6f}" + "".join(f",{0.01 * i - 0.1 * frame:.6f}" for i in range(len(DOFS)))
            for frame in (0, 2)]

    def pose(name, *lines):
        (folder / f"pose_{name}.csv").write_text("\n".join(lines) + "\n")

    pose("good", comment, head, *rows)
    pose("wrong_header", comment, head.replace("upperback_ry", "spine_ry"), *rows)
    pose("short_row", comment, head, rows[0][:-10])
    pose("infinite", comment, head, rows[0].replace("0.050000", "inf"))


if __name__ == "__main__":
    recordings()
    tum_folders()
    tracks()
