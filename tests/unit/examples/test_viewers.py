"""The examples for viewers and robots: what they write is read by libraries of others."""
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import depthmocap

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "apps/examples"
FRAMES = 8


@pytest.fixture(scope="module")
def take(tmp_path_factory):
    """The first pictures of a bundled recording, and how they are tracked."""
    folder = tmp_path_factory.mktemp("take") / "walk"
    recording = depthmocap.Recording(ROOT / "recordings/walk")
    with depthmocap.RecordingWriter(folder, recording.camera) as writer:
        for n, time_s in enumerate(recording.times[:FRAMES]):
            writer.write(recording[n], time_s)
    tracked = list(depthmocap.track(folder))
    assert [frame.state for frame in tracked].count("tracking") > FRAMES / 2
    return folder, tracked


def run(example, *arguments):
    return subprocess.run([sys.executable, EXAMPLES / example, *arguments], capture_output=True, text=True)


def messages_of(path):
    reader = pytest.importorskip("mcap.reader", reason="pip install mcap")
    decoder = pytest.importorskip("mcap_protobuf.decoder", reason="pip install mcap-protobuf-support")
    found = {}
    with open(path, "rb") as file:
        for _, channel, message, content in reader.make_reader(file, decoder_factories=[decoder.DecoderFactory()]) \
                .iter_decoded_messages():
            found.setdefault(channel.topic, []).append((message.log_time, content))
    return found


def vector(v):
    return np.array([v.x, v.y, v.z])


def matrix(q):
    """Of a quaternion."""
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


@pytest.fixture(scope="module")
def mcap(take, tmp_path_factory):
    pytest.importorskip("foxglove", reason="pip install foxglove-sdk")
    path = tmp_path_factory.mktemp("mcap") / "walk.mcap"
    done = run("to_mcap.py", take[0], path)
    assert done.returncode == 0, done.stderr
    return path


def test_joints_in_the_mcap_are_those_that_were_tracked(take, mcap):
    found = messages_of(mcap)
    assert len(found["/skeleton"]) == len(take[1])
    for frame, (time_ns, scene) in zip(take[1], found["/skeleton"]):
        assert time_ns == round(frame.time_s * 1e9)
        if frame.state == "lost":
            assert scene.deletions[0].id == "person_1"
            continue
        entity, = scene.entities
        assert entity.frame_id == "camera"
        joints = np.array([vector(sphere.pose.position) for sphere in entity.spheres])
        assert abs(joints - frame.joints).max() < 0.001
        assert len(entity.lines[0].points) == 2 * 17


def test_bones_in_the_mcap_stand_and_turn_as_they_were_tracked(take, mcap):
    along = {"rhumerus": ("right_elbow", (-1, 0, 0)), "lradius": ("left_wrist", (1, 0, 0)), "rfemur": ("right_knee", (0, -1, 0)),
             "ltibia": ("left_ankle", (0, -1, 0))}
    at = {"root": "pelvis", "rhumerus": "right_shoulder", "lradius": "left_elbow", "rfemur": "right_hip", "ltibia": "left_knee",
          "head": "head"}
    for frame, (_, message) in zip(take[1], messages_of(mcap)["/tf"]):
        placed = {transform.child_frame_id: transform for transform in message.transforms}
        world = matrix(placed["camera"].rotation)
        assert abs(world - frame.world_from_camera).max() < 1e-6
        if frame.state == "lost":
            continue
        joint = {name: frame.joints[n] for n, name in enumerate(depthmocap.JOINTS)}
        for bone, name in at.items():
            transform = placed[f"person_1/{bone}"]
            assert transform.parent_frame_id == "world"
            assert abs(world.T @ vector(transform.translation) - joint[name]).max() < 0.001
        for bone, (end, rest) in along.items():
            way = world @ (joint[end] - joint[at[bone]])
            turned = matrix(placed[f"person_1/{bone}"].rotation) @ rest
            assert np.linalg.norm(turned - way / np.linalg.norm(way)) < 0.002, bone  # 0.1 degrees


def test_depth_in_the_mcap_is_the_recordings(take, mcap):
    found = messages_of(mcap)
    camera = depthmocap.Recording(take[0]).camera
    lens = found["/depth/calibration"][0][1]
    assert (lens.width, lens.height, *lens.K[:6]) == (640, 480, camera.fx, 0, camera.cx, 0, camera.fy, camera.cy)
    for frame, (_, image) in zip(take[1], found["/depth/image"]):
        steps = np.frombuffer(image.data, "<u2").reshape(image.height, image.step // 2)
        assert image.encoding == "16UC1" and (steps == np.rint(frame.depth * 1000)).all()


@pytest.mark.skipif("DEPTHMOCAP_PROGRAM" not in os.environ, reason="DEPTHMOCAP_PROGRAM names no program to send to")
def test_the_mcap_is_a_recording_again(take, mcap, tmp_path):
    with subprocess.Popen([sys.executable, ROOT / "apps/bridges/recorded.py", mcap], stdout=subprocess.PIPE) as sending:
        subprocess.run([os.environ["DEPTHMOCAP_PROGRAM"], "record", "--source", "pipe:-", "--out", tmp_path / "again"],
                       stdin=sending.stdout, check=True, capture_output=True)
    again = depthmocap.Recording(tmp_path / "again")
    first = depthmocap.Recording(take[0])
    assert (again.times == first.times).all() and (again[3] == first[3]).all()


def test_what_rerun_is_sent_is_what_was_tracked(take, tmp_path):
    pytest.importorskip("rerun", reason="pip install rerun-sdk")
    path = tmp_path / "walk.rrd"
    done = run("to_rerun.py", take[0], "--save", path)
    assert done.returncode == 0, done.stderr
    reading = pytest.importorskip("rerun.chunk", reason="this rerun-sdk does not read .rrd files")
    joints = {}
    entities = set()
    for chunk in reading.RrdReader(path).stream():
        entities.add(str(chunk.entity_path))
        if str(chunk.entity_path) == "/world/camera/person_1/joints":
            table = chunk.to_record_batch()
            for n, positions in zip(*(table.column(name).to_pylist() for name in ("frame", "Points3D:positions"))):
                joints[n] = np.array(positions)
    assert {"/world/camera/image", "/world/camera/image/depth", "/world/camera/image/parts",
            "/world/camera/person_1/bones"} <= entities
    seen = [frame for frame in take[1] if frame.state != "lost"]
    assert len(joints) == len(seen)
    for frame in seen:
        assert abs(joints[frame.frame] - frame.joints).max() < 1e-5


@pytest.mark.parametrize("example, package, out", [("to_mcap.py", "foxglove", ["out.mcap"]),
                                                   ("to_rerun.py", "rerun", ["--save", "out.rrd"])])
def test_a_source_that_is_not_there_is_one_line(example, package, out, tmp_path):
    pytest.importorskip(package)
    done = run(example, tmp_path / "missing", *out)
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1 and "missing" in done.stderr
