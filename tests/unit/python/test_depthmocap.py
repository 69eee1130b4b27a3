"""The Python package against the program and the bundled recordings."""
import gc
import itertools
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import depthmocap

ROOT = Path(__file__).parents[3]
WALK = ROOT / "recordings/walk"
PROGRAM = os.environ.get("DEPTHMOCAP_PROGRAM")


@pytest.fixture(scope="module")
def frames():
    return list(itertools.islice(depthmocap.track(WALK), 12))


def test_names_fit_to_the_arrays():
    assert len(depthmocap.JOINTS) == 18 and depthmocap.JOINTS[0] == "pelvis"
    assert len(depthmocap.DOFS) == 36 and len(depthmocap.BONES) == 16 and len(depthmocap.PARTS) == 16
    assert depthmocap.__version__.count(".") == 2


def test_a_frame_has_shapes_and_units(frames):
    frame = frames[8]
    assert frame.state == "tracking" and frame.person == 1
    assert frame.joints.shape == (18, 3) and frame.joints.dtype == np.float64
    assert 1 < frame.joints[0, 2] < 6, "metres from the camera"
    assert frame.confidence.shape == (18,) and frame.confidence.max() <= 1
    assert frame.q.shape == (36,)
    assert np.allclose(np.linalg.norm(frame.rotations, axis=1), 1)
    assert frame.labels.shape == frame.depth.shape == (480, 640)
    assert frame.labels.dtype == np.uint8 and 0 < frame.labels.max() <= 15
    assert frame.markers.shape == (15, 3) and (frame.marker_confidence > 0).any()
    assert 1.3 < frame.stature < 2.2
    assert frame.stage_ms["total"] > 0
    assert np.allclose(frame.world_from_camera @ frame.world_from_camera.T, np.eye(3))
    assert [f.frame for f in frames] == sorted(f.frame for f in frames)


def test_the_root_stands_where_the_pelvis_is(frames):
    frame = frames[8]
    assert np.allclose(frame.world_from_camera @ frame.joints[0], frame.q[:3], atol=0.15)


def test_floor_and_world(frames):
    floors = [frame.floor for frame in frames if frame.floor is not None]
    assert all(np.isclose(np.linalg.norm(floor[:3]), 1) and floor[1] > 0.9 for floor in floors)


@pytest.mark.skipif(not PROGRAM, reason="DEPTHMOCAP_PROGRAM names no program to compare with")
def test_files_have_the_bytes_of_replay(tmp_path):
    squat = ROOT / "recordings/squat"
    kept = list(depthmocap.track(squat))
    depthmocap.write_joints(tmp_path / "a.csv", kept)
    depthmocap.write_pose(tmp_path / "a.pose.csv", kept)
    subprocess.run([PROGRAM, "replay", squat, "--joints", tmp_path / "b.csv", "--pose", tmp_path / "b.pose.csv"], check=True,
                   capture_output=True)
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert (tmp_path / "a.pose.csv").read_bytes() == (tmp_path / "b.pose.csv").read_bytes()
    track = depthmocap.read_joints(tmp_path / "a.csv")
    assert track["joints"].shape == (len(kept), 18, 3)
    assert np.allclose(track["joints"][30], kept[30].joints, atol=1e-4)
    assert np.allclose(depthmocap.read_pose(tmp_path / "a.pose.csv")["q"][-1], kept[-1].q, atol=1e-4)


def test_iteration_may_stop_anywhere():
    stream = depthmocap.track(WALK)
    next(stream)
    stream.close()
    assert len(list(stream)) < 10, "only those that were ready"
    threads_before = len(os.listdir("/proc/self/task"))
    for _ in range(3):
        next(depthmocap.track(WALK))
        gc.collect()
    deadline = time.monotonic() + 10  # helpers of the tracker's pool take a moment to go
    while len(os.listdir("/proc/self/task")) > threads_before and time.monotonic() < deadline:
        time.sleep(0.05)
    assert len(os.listdir("/proc/self/task")) <= threads_before, "a session that nobody listens to ends"


def test_other_threads_run_meanwhile():
    counted = 0
    over = threading.Event()

    def count():
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    list(itertools.islice(depthmocap.track(WALK), 10))
    over.set()
    counter.join()
    assert counted > 10


def test_lost_frames_have_nan():
    camera = depthmocap.CameraModel(320, 240, 280, 280, 159.5, 119.5)
    frame, = depthmocap.Tracker(camera).process(np.full((240, 320), np.nan), 0.0)
    assert frame.state == "lost"
    assert np.isnan(frame.joints).all() and np.isnan(frame.q).all() and (frame.depth == 0).all()


def test_pictures_of_ones_own():
    recording = depthmocap.Recording(WALK)
    assert len(recording) > 50 and len(recording.times) == len(recording)
    tracker = depthmocap.Tracker(recording.camera)
    states = []
    for i in range(5):
        frame, = tracker.process(recording[i], recording.times[i], i)
        states.append(frame.state)
    assert states[-1] == "tracking"
    assert np.array_equal(recording[-1], recording[len(recording) - 1])
    with pytest.raises(IndexError):
        recording[len(recording)]


def test_turned_pictures():
    assert depthmocap.Recording(WALK, turn=90)[0].shape == (640, 480)
    with pytest.raises(depthmocap.Error, match="turn"):
        depthmocap.Recording(WALK, turn=45)


def test_recordings_are_written(tmp_path):
    camera = depthmocap.CameraModel(8, 6, 8, 8, 3.5, 2.5)
    depth = np.linspace(0.5, 4, 48).reshape(6, 8)
    with depthmocap.RecordingWriter(tmp_path / "rec", camera, name="mine") as writer:
        writer.write(depth, 0.0)
        writer.write(depth, 0.1)
    again = depthmocap.Recording(tmp_path / "rec")
    assert len(again) == 2 and again.camera.fx == 8
    assert np.allclose(again[1], depth, atol=0.0006)
    with pytest.raises(depthmocap.Error):
        depthmocap.RecordingWriter(tmp_path / "rec", camera)


def test_a_stream_knows_its_camera():
    for stream in (depthmocap.track(WALK, turn=90), depthmocap.live(f"replay:{WALK}", turn=90)):
        assert (stream.camera.width, stream.camera.height, stream.camera.fx) == (480, 640, 575.8)
        stream.close()


def test_live_takes_a_replay():
    seen = list(itertools.islice(depthmocap.live(f"replay:{WALK}", speed=0), 5))
    assert len(seen) == 5 and seen[-1].time_s > 0


def test_live_takes_frames_of_another_program(tmp_path):
    """What apps/bridges/frame_pipe.py sends is tracked as the same frames of a recording are."""
    sender = f"""
import sys; sys.path.insert(0, {str(ROOT / "apps/bridges")!r})
from frame_pipe import FramePipe
import depthmocap, numpy as np
recording = depthmocap.Recording({str(WALK)!r})
c = recording.camera
pipe = FramePipe(c.width, c.height, c.fx, c.fy, c.cx, c.cy, fps=recording.fps, waits=True)
for i, time_s in enumerate(recording.times[:4]):
    pipe.write(i, time_s, np.rint(recording[i] * 1000).astype("<u2"))
"""
    with open(tmp_path / "stream", "wb") as stream:
        subprocess.run([sys.executable, "-c", sender], stdout=stream, check=True)
    piped = list(depthmocap.live(f"pipe:{tmp_path / 'stream'}"))
    replayed = list(itertools.islice(depthmocap.live(f"replay:{WALK}", speed=0), 4))
    assert len(piped) == 4
    for a, b in zip(piped, replayed):
        assert a.frame == b.frame and a.time_s == pytest.approx(b.time_s)
        assert np.array_equal(a.depth, b.depth)
        assert np.array_equal(a.joints, b.joints, equal_nan=True)


def test_errors_say_where():
    for action in (lambda: depthmocap.track("no/such/folder"), lambda: depthmocap.Recording("no/such/folder"),
                   lambda: depthmocap.calibrate("no/such/folder"), lambda: depthmocap.Markers.load("no/such/folder.trc")):
        with pytest.raises(depthmocap.Error, match="no/such/folder"):
            action()
    with pytest.raises(depthmocap.Error):
        depthmocap.live("webcam")
    with pytest.raises(TypeError):
        depthmocap.track()
    with pytest.raises(depthmocap.Error, match="shape"):
        depthmocap.Tracker(depthmocap.CameraModel(8, 6, 8, 8, 3.5, 2.5)).process(np.zeros(48), 0.0)


def test_cameras_are_a_list():
    assert isinstance(depthmocap.cameras(), list)


def test_actors(tmp_path):
    actor = depthmocap.Actor.average(1.8)
    assert actor.stature == pytest.approx(1.8, abs=0.01)
    assert 0.3 < actor.bone_lengths["upper_leg"] < 0.6
    assert next(depthmocap.track(WALK, actor=actor)).stature == pytest.approx(1.8, abs=0.01)
    with pytest.raises(depthmocap.Error):
        actor.save(tmp_path / "a.json")  # not measured
    with pytest.raises(depthmocap.Error, match="T-pose|pose"):
        depthmocap.calibrate(ROOT / "recordings/boxing")


def test_inverse_kinematics():
    ik = depthmocap.Ik(prior="gmm")
    solution = ik.solve({"left_wrist": (0.3, 1.5, 0.3), "right_wrist": np.array([-0.3, 1.4, 0.3]), "pelvis": (0, 1.0, 0),
                         "left_ankle": (0.1, 0.1, 0), "right_ankle": (-0.1, 0.1, 0)})
    assert solution.residual < 0.02
    assert np.allclose(solution.joints[depthmocap.JOINTS.index("left_wrist")], (0.3, 1.5, 0.3), atol=0.03)
    assert solution.q.shape == (36,) and solution.rotations.shape == (16, 4)
    with pytest.raises(depthmocap.Error, match="there is no joint 'tail'"):
        ik.solve({"tail": (0, 0, 0)})
    with pytest.raises(depthmocap.Error, match="none of"):
        depthmocap.Ik(prior="magic")


def test_repair_fills_gaps(tmp_path):
    truth = depthmocap.read_joints(WALK / "truth/joints.csv")["joints"][:60]
    broken = truth.copy()
    broken[20:30, depthmocap.JOINTS.index("left_wrist")] = np.nan
    markers = depthmocap.Markers(depthmocap.JOINTS, broken)
    assert np.isnan(markers.positions[25, 6]).all()
    repaired = depthmocap.repair(markers)
    filled = repaired.markers.positions[20:30, 6]
    assert np.isfinite(filled).all()
    assert np.linalg.norm(filled - truth[20:30, 6], axis=1).max() < 0.1
    assert repaired.joints.shape == (60, 18, 3) and repaired.q.shape == (60, 36)
    for name in ("m.trc", "m.c3d"):
        repaired.markers.save(tmp_path / name)
        again = depthmocap.Markers.load(tmp_path / name)
        assert again.names == markers.names
        assert np.allclose(again.positions, repaired.markers.positions, atol=1e-4)


def test_every_name_is_typed():
    stub = (Path(depthmocap.__file__).parent / "_core.pyi").read_text()
    for name in depthmocap.__all__:
        thing = getattr(depthmocap, name)
        assert name in stub
        if not isinstance(thing, type) or thing is depthmocap.Error:
            continue
        for member in vars(thing):
            if not member.startswith("_"):
                assert f" {member}" in stub, f"{name}.{member}"
                assert getattr(thing, member).__doc__, f"{name}.{member} has no docstring"
