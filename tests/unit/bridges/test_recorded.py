"""recorded.py reads recordings that other programs made: each kind of file written by a library of others."""
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import recorded_files as files
from recorded_files import IMAGE, INFO, Ros, Take, azure_calibration, small, topics_of
from test_bridges import BRIDGES, split

PROGRAM = os.environ.get("DEPTHMOCAP_PROGRAM")
RECORDED = BRIDGES / "recorded.py"


def run(path, *options):
    return subprocess.run([sys.executable, RECORDED, path, *options], capture_output=True, timeout=60)


def sent(path, *options):
    """Header and frames; fails where anything is wrong."""
    done = run(path, *options)
    assert done.returncode == 0, done.stderr.decode()
    return split(done.stdout)


def refused(path, *options):
    """The one line that says why."""
    done = run(path, *options)
    lines = done.stderr.decode().splitlines()
    assert done.returncode == 1 and done.stdout == b"" and lines[-1].startswith("recorded: "), done.stderr
    assert len(lines) == 1 or lines[0].startswith("recorded: depth of")
    return lines[-1]


def azure(take):
    """Times in whole milliseconds, as Matroska files of FFmpeg have them, and a size of Azure Kinect."""
    width, height = take.size
    above, left = (576 - height) // 2, (640 - width) // 2
    fx, fy, cx, cy = take.k
    frame = ((above, 576 - height - above), (left, 640 - width - left))
    return Take([np.pad(picture, frame) for picture in take.pictures],
                [round(time_ns / 1e6) * 10**6 for time_ns in take.times_ns], (fx, fy, cx + left, cy + above))


def bag(path, take, **options):
    return files.write_bag(path / "take.bag", topics_of(Ros(1), take), **options)


def db3(path, take):
    return files.write_db3(path / "take", topics_of(Ros(2), take))


def mcap(path, take, **options):
    return files.write_mcap(path / "take.mcap", topics_of(Ros(options.get("version", 2)), take), **options)


def foxglove(path, take):
    return files.write_foxglove(path / "fox.mcap", take)


def mkv(path, take):
    return files.write_mkv(path / "take.mkv", take, azure_calibration(take))


KINDS = {"bag": bag, "bag lz4": lambda path, take: bag(path, take, compression="lz4"),
         "bag bz2": lambda path, take: bag(path, take, compression="bz2"), "db3": db3, "mcap": mcap,
         "mcap lz4": lambda path, take: mcap(path, take, compression="LZ4"),
         "mcap without chunks": lambda path, take: mcap(path, take, compression="NONE", chunk_size=1),
         "mcap of ROS 1": lambda path, take: mcap(path, take, version=1), "foxglove": foxglove,
         "foxglove json": lambda path, take: files.write_foxglove_json(path / "json.mcap", take)}


def is_same(take, header, frames):
    assert (header["width"], header["height"]) == take.size
    assert tuple(header["intrinsics"][name] for name in ("fx", "fy", "cx", "cy")) == pytest.approx(take.k, abs=1e-9)
    assert [number for number, _, _ in frames] == list(range(len(take.pictures)))
    assert [time_s for _, time_s, _ in frames] == [(time - take.times_ns[0]) / 1e9 for time in take.times_ns]
    for (_, _, values), picture in zip(frames, take.pictures):
        assert (values == picture.reshape(-1)).all()


@pytest.mark.parametrize("kind", KINDS)
def test_pictures_times_and_lens_arrive(kind, tmp_path):
    take = small()
    header, frames = sent(KINDS[kind](tmp_path, take))
    assert header["waits"] is True and header["depth_unit_m"] == 0.001 and header["fps"] == 30
    is_same(take, header, frames)


def test_azure_kinect_arrives(tmp_path):
    take = azure(small())
    header, frames = sent(mkv(tmp_path, take))
    assert header["fps"] == 30
    is_same(take, header, frames)


@pytest.mark.parametrize("size, place", [((320, 288), (512, 96, 90)), ((512, 512), (512, 0, 0)), ((1024, 1024), (1024, 0, 0))])
def test_modes_of_azure_kinect(size, place, tmp_path):
    width, height = size
    take = Take([np.arange(width * height, dtype="<u2").reshape(height, width)], [0], (150.0, 151.0, 160.0, 140.0))
    is_same(take, *sent(files.write_mkv(tmp_path / "take.mkv", take, azure_calibration(take, *place))))


def test_azure_kinects_distortion_is_taken_out(tmp_path):
    take = azure(small(1))
    take.pictures[0] = np.tile(np.arange(640, dtype="<u2"), (576, 1)) + 1
    take.k = (500.0, 500.0, 320.0, 288.0)
    calibration = azure_calibration(take, distortion=(0.2, 0, 0, 0, 0, 0, 0, 0))
    _, frames = sent(files.write_mkv(tmp_path / "take.mkv", take, calibration))
    x = 100 / 500
    assert frames[0][2].reshape(576, 640)[288, 420] == 1 + round(320 + 100 * (1 + 0.2 * x * x))


@pytest.mark.skipif(not PROGRAM, reason="DEPTHMOCAP_PROGRAM names no program to send to")
@pytest.mark.parametrize("kind", ["bag", "mcap", "foxglove", "db3", "mkv"])
def test_joints_are_those_of_the_folder(kind, tmp_path):
    import depthmocap
    take = files.walk(12)
    take = azure(take) if kind == "mkv" else take
    folder = tmp_path / "folder"
    with depthmocap.RecordingWriter(folder, depthmocap.CameraModel(*take.size, *take.k)) as writer:
        for picture, time_ns in zip(take.pictures, take.times_ns):
            writer.write(picture.astype(np.float32) / 1000, time_ns / 1e9)
    path = mkv(tmp_path, take) if kind == "mkv" else KINDS[kind](tmp_path, take)
    with subprocess.Popen([sys.executable, RECORDED, path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as sending:
        subprocess.run([PROGRAM, "record", "--source", "pipe:-", "--out", tmp_path / "copy"], stdin=sending.stdout,
                       check=True, capture_output=True)
    for name in ("folder", "copy"):
        subprocess.run([PROGRAM, "replay", tmp_path / name, "--joints", tmp_path / f"{name}.csv"], check=True,
                       capture_output=True)
    assert b"tracking" in (tmp_path / "copy.csv").read_bytes()
    assert (tmp_path / "copy.csv").read_bytes() == (tmp_path / "folder.csv").read_bytes()


def test_forms_of_pictures(tmp_path):
    take = small(1)
    take.pictures = [np.arange(48, dtype="<u2").reshape(6, 8) * 1000]
    metres = take.pictures[0].astype(np.float32) / 1000
    metres[0, :4] = np.nan, np.inf, -1, 70
    wanted = take.pictures[0].copy()
    wanted[0, :4] = 0
    for name, picture, options, expected in (
            ("big-endian", take.pictures[0], dict(big=True), take.pictures[0]),
            ("padded", take.pictures[0], dict(pad=6), take.pictures[0]),
            ("metres", metres, dict(form="32FC1"), wanted)):
        ros = Ros(1)
        messages = [(INFO, 0, ros.info(take)), (IMAGE, 0, ros.image(picture, 1, **options))]
        path = files.write_bag(tmp_path / f"{name}.bag", messages)
        header, frames = sent(path)
        assert (frames[0][2] == expected.reshape(-1)).all(), name
        assert header["depth_unit_m"] == 0.001


def test_a_camera_on_its_side_arrives(tmp_path):
    take = small(2)
    take.pictures = [np.arange(33, dtype="<u2").reshape(11, 3) + n for n in range(2)]
    is_same(take, *sent(mcap(tmp_path, take)))


def test_the_depth_is_found_among_other_topics(tmp_path):
    ros, take = Ros(1), small(3)
    infrared = Take([picture + 5000 for picture in take.pictures], take.times_ns, (9.0, 9.0, 3.0, 3.0))
    others = [("/camera/aligned_depth_to_color/camera_info", 0, ros.info(infrared)),
              ("/camera/infra1/camera_info", 0, ros.info(infrared)),
              *(("/camera/infra1/image_raw", time, ros.image(picture, time + 1, form="mono16"))
                for picture, time in zip(infrared.pictures, take.times_ns)),
              *(("/camera/aligned_depth_to_color/image_raw", time, ros.image(picture, time + 1))
                for picture, time in zip(infrared.pictures, take.times_ns))]
    path = files.write_bag(tmp_path / "take.bag", others + topics_of(ros, take))
    is_same(take, *sent(path))
    header, frames = sent(path, "--topic", "/camera/aligned_depth_to_color/image_raw")
    assert header["intrinsics"]["fx"] == 9 and frames[0][2][0] == 6000
    listed = run(path, "--list").stdout.decode()
    assert f"{IMAGE}: 3 of sensor_msgs/Image, 8 x 6 16UC1" in listed and f"taken: {IMAGE}, lens of {INFO}" in listed
    assert "no depth pictures in /nowhere" in refused(path, "--topic", "/nowhere")


def test_realsenses_unit_is_read(tmp_path):
    ros, take = Ros(1), small(2)
    sensor = "/device_0/sensor_0"
    path = files.write_bag(tmp_path / "take.bag", [
        (f"{sensor}/option/Depth_Units/value", 0, ros.type("std_msgs/msg/Float32")(np.float32(0.0001))),
        (f"{sensor}/Depth_0/info/camera_info", 0, ros.info(take)),
        *((f"{sensor}/Depth_0/image/data", time, ros.image(picture, time + 1, form="mono16"))
          for picture, time in zip(take.pictures, take.times_ns))])
    header, frames = sent(path)
    assert header["depth_unit_m"] == 0.0001
    is_same(take, header, frames)


def test_rectified_pictures_have_no_distortion(tmp_path):
    ros, take = Ros(2), small(2)
    take.pictures = [np.arange(48, dtype="<u2").reshape(6, 8)] * 2
    lens = ros.info(take, d=(0.5, 0, 0, 0, 0), k=take.k)
    for topic, straight in (("/depth/image_rect_raw", True), ("/depth/image_raw", False)):
        path = files.write_mcap(tmp_path / "take.mcap", [("/depth/camera_info", 0, lens)] + [
            (topic, time, ros.image(picture, time + 1)) for picture, time in zip(take.pictures, take.times_ns)])
        _, frames = sent(path)
        assert (frames[0][2] == take.pictures[0].reshape(-1)).all() == straight


def test_a_lens_that_is_missing_or_unknown_is_asked_for(tmp_path):
    ros, take = Ros(1), small(2)
    pictures = topics_of(ros, take)[1:]
    camera = tmp_path / "camera.json"
    camera.write_text('{"width": 8, "height": 6, "depth_unit_m": 0.002, "intrinsics": {"fx": 5, "fy": 5, "cx": 1, "cy": 2}}')
    for name, messages, why in (
            ("none", pictures, "tells no intrinsics for 8 x 6"),
            ("fisheye", [(INFO, 0, ros.info(take, model="equidistant", d=(1, 0, 0, 0)))] + pictures, "lens model 'equidistant'"),
            ("zero", [(INFO, 0, ros.info(take, k=(0, 0, 0, 0)))] + pictures, "was not calibrated"),
            ("nan", [(INFO, 0, ros.info(take, k=(float("nan"),) * 4))] + pictures, "was not calibrated")):
        path = files.write_bag(tmp_path / f"{name}.bag", messages)
        assert why in refused(path) and "give --camera FILE" in refused(path)
        header, _ = sent(path, "--camera", camera)
        assert header["intrinsics"] == {"fx": 5, "fy": 5, "cx": 1, "cy": 2} and header["depth_unit_m"] == 0.002
    camera.write_text(camera.read_text().replace("8", "9"))
    assert "is of 9 x 6, the pictures are of 8 x 6" in refused(path, "--camera", camera)
    camera.write_text("{}")
    assert "no camera in the form of a recording.json" in refused(path, "--camera", camera)


def test_what_is_no_recording_is_one_line(tmp_path):
    ros, take = Ros(1), small(2)
    empty, text = tmp_path / "empty.bag", tmp_path / "text.mcap"
    empty.write_bytes(b"")
    text.write_text("hello")
    assert "is empty" in refused(empty)
    assert "is no .bag (version 2.0), .db3, .mcap or .mkv" in refused(text)
    assert "No such file" in refused(tmp_path / "missing.bag")
    (tmp_path / "folder").mkdir()
    assert "holds 0 files" in refused(tmp_path / "folder")
    infrared = files.write_bag(tmp_path / "ir.bag", topics_of(ros, take, image="/camera/ir/image_raw", form="mono16"))
    assert "no pictures that are surely depth" in refused(infrared)


def test_pictures_out_of_order_and_of_another_size_are_left_out(tmp_path):
    ros, take = Ros(1), small(4)
    messages = topics_of(ros, take)
    messages.insert(3, messages[1])
    messages.insert(3, (IMAGE, 50, ros.image(np.ones((2, 2), "<u2"), 10**18 + 40_000_000)))
    done = run(files.write_bag(tmp_path / "take.bag", messages))
    is_same(take, *split(done.stdout))
    assert b"warning: 1 damaged or other pictures are left out; 1 pictures whose times do not grow are left out" in done.stderr


def test_a_missing_package_is_named(tmp_path):
    path = mcap(tmp_path, small(2))
    code = (f"import sys; sys.path.insert(0, {str(BRIDGES)!r}); sys.modules['mcap'] = None\n"
            f"sys.argv = ['recorded', {str(path)!r}]\nimport recorded; recorded.main()")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr == "recorded: this file needs a package that is missing: pip install mcap\n"


def test_what_realsenses_library_records_is_read(tmp_path):
    pytest.importorskip("pyrealsense2", reason="pip install pyrealsense2")
    record = [sys.executable, Path(__file__).with_name("record_realsense.py")]
    # Each version of the library writes one of the two.
    path, = [path for path in (tmp_path / "take.bag", tmp_path / "take.db3")
             if subprocess.run([*record, path], capture_output=True, timeout=60).returncode == 0]
    header, frames = sent(path)
    assert header["intrinsics"] == {"fx": 60.0, "fy": 61.0, "cx": 31.5, "cy": 23.5}
    assert header["depth_unit_m"] == 0.00025 and len(frames) > 5
    for _, _, values in frames:
        assert (values == values[0]).all() and 1000 <= values[0] < 1010
