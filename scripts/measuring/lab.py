"""Runs the program for measurements and keeps what it made: recordings and databases by how they were asked for,
tracking results by that and by the program and the files that it comes with. So a measurement can be taken up again, and
after a change of the tracker only the tracking is done again."""
import concurrent.futures
import datetime
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
QUICK_FRAMES = 40
DATA = pathlib.Path(os.environ.get("DEPTHMOCAP_DATA", ROOT.parent / "shared" / "data"))


def key_of(*parts):
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:16]


def motion_file(name):
    return name if name.startswith("procedural:") else DATA / "cmu" / name.split("_")[0] / f"{name}.amc"


class Run:
    """One tracked recording: `figures` of evaluate, `stats` of the tracker, and where its files are."""

    def __init__(self, folder, recording):
        self.recording = recording
        self.joints, self.pose = folder / "joints.csv", folder / "pose.csv"
        self.figures = json.loads((folder / "figures.json").read_text())
        self.stats = json.loads((folder / "stats.json").read_text())

    @property
    def angles_deg(self):
        return self.figures["mean_joint_angle_error_deg"]

    @property
    def joints_mm(self):
        error_m = self.figures["mean_joint_error_m"]
        return 1000 * error_m if error_m is not None else float("nan")  # nobody was tracked


class Lab:
    def __init__(self, build, work, jobs, quick, commit=None):
        self.build, self.work, self.jobs, self.quick = pathlib.Path(build).resolve(), pathlib.Path(work), jobs, quick
        self.program, self.experiment = self.build / "depthmocap", self.build / "tests" / "experiment"
        for program in (self.program, self.experiment):
            if not program.exists():
                sys.exit(f"no program at {program}: run scripts/build first")
        self.commit = commit  # that the build was made of; None: the present one
        self.locks, self.lock = {}, threading.Lock()

    @functools.cached_property
    def fingerprint(self):
        """Of everything that a tracking result depends on beside the recording."""
        share = self.build / "share" / "depthmocap"
        files = [self.experiment, *sorted(share.glob("*.forest")), share / "default.posedb"]
        return key_of(*(hashlib.sha256(file.read_bytes()).hexdigest() for file in files))

    def heading(self):
        commit = self.commit or subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True,
                                               text=True).stdout.strip()
        return f"commit {commit}, {datetime.date.today().isoformat()}"

    def call(self, program, *arguments, check=True):
        command = [str(program), *map(str, arguments)]
        result = subprocess.run(command, capture_output=True, text=True)
        if check and result.returncode != 0:
            raise RuntimeError(f"failed: {' '.join(command)}\n{result.stderr}")
        return result

    def frames(self, most):
        """Frames of a recording to track."""
        return min(most, QUICK_FRAMES) if self.quick else most

    def map(self, function, items):
        """function(item) for all, several at a time, in order."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(function, items))

    def kept(self, path, make):
        """`path`, which make(temporary path) has made, now or in an earlier run."""
        with self.lock:
            lock = self.locks.setdefault(path, threading.Lock())
        with lock:
            if not path.exists():
                path.parent.mkdir(parents=True, exist_ok=True)
                part = path.with_name(path.name + ".part")
                if part.is_dir():
                    shutil.rmtree(part)
                make(part)
                part.rename(path)
        return path

    def render(self, motion, *options):
        """The recording of a motion (CMU's name or procedural:NAME)."""
        path = self.work / "recordings" / f"{motion.replace(':', '-')}-{key_of(motion, *options)}"
        return self.kept(path, lambda part: self.call(
            self.program, "synthesize", "--motion", motion_file(motion), "--out", part, "--threads", 1, *options))

    def database(self, excluded, *options):
        """All of CMU's poses but those of the excluded motions."""
        path = self.work / "databases" / f"{key_of(sorted(excluded), *options)}.posedb"
        words = [word for name in sorted(excluded) for word in ("--exclude", name)]
        return self.kept(path, lambda part: self.call(
            self.program, "posedb", "build", "--motions", DATA / "cmu", "--motions", DATA / "cmu_bvh", *words,
            "--out", part, "--threads", self.jobs, *options))

    def actor(self, *body):
        """Calibrated on a rendered T-pose of this body (options of synthesize)."""
        recording = self.render("procedural:calibrate", *body)
        path = self.work / "actors" / self.fingerprint / f"{key_of(recording)}.json"
        return self.kept(path, lambda part: self.call(self.program, "calibrate", recording, "--out", part))

    def variant(self, recording, frames=None, every=1, speed=1.0):
        """The same recording, its first frames only, of these every n-th, played `speed` times as fast."""
        name = f"{recording.name}-first{frames or 'all'}-every{every}-speed{speed:g}"
        return self.kept(recording.with_name(name),
                         lambda part: self.make_variant(recording, part, frames, every, speed))

    @staticmethod
    def make_variant(recording, part, frames, every, speed):
        part.mkdir()
        (part / "depth").symlink_to(recording / "depth")
        header = json.loads((recording / "recording.json").read_text())
        header["fps"] *= speed / every
        (part / "recording.json").write_text(json.dumps(header))

        def copy(name):
            lines = (recording / name).read_text().splitlines()
            first = 1 + sum(line.startswith("#") for line in lines)
            rows = [line.split(",", 2) for line in lines[first:][:frames][::every]]
            rows = [f"{frame},{float(time_s) / speed:.6f},{rest}" for frame, time_s, rest in rows]
            (part / name).write_text("\n".join(lines[:first] + rows) + "\n")
        copy("frames.csv")
        (part / "truth").mkdir()
        (part / "truth" / "labels").symlink_to(recording / "truth" / "labels")
        for name in ("joints.csv", "pose.csv"):
            copy(f"truth/{name}")

    def track(self, recording, *options, truth=None, evaluate=()):
        """Tracks and evaluates; truth: the recording's unless given."""
        folder = self.work / "runs" / self.fingerprint / key_of(recording, *options, truth, *evaluate)
        self.kept(folder, lambda part: self.make_run(part, recording, options, truth or recording, evaluate))
        return Run(folder, recording)

    def stats(self, recording, *options):
        """Tracks what has no truth to evaluate with; how the tracker fared."""
        path = self.work / "stats" / self.fingerprint / f"{key_of(recording, *options)}.json"
        return json.loads(self.kept(path, lambda part: self.call(
            self.experiment, recording, "--stats", part, *options)).read_text())

    def labels(self, recording, *options):
        """Folder of the label images that tracking gives."""
        folder = self.work / "labels" / self.fingerprint / key_of(recording, *options)
        return self.kept(folder, lambda part: self.call(
            self.experiment, recording, "--labels", part, "--threads", 1, *options))

    def make_run(self, part, recording, options, truth, evaluate):
        part.mkdir()
        joints, pose = part / "joints.csv", part / "pose.csv"
        self.call(self.experiment, recording, "--joints", joints, "--pose", pose, "--stats", part / "stats.json",
                  "--threads", 1, *options)
        poses = ["--pose", pose] if (pathlib.Path(truth) / "truth" / "pose.csv").exists() and pose.exists() else []
        figures = self.call(self.program, "evaluate", "--joints", joints, "--truth", truth, *poses, *evaluate).stdout
        (part / "figures.json").write_text(figures)
