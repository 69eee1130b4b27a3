"""Small good inputs of each kind, made of what is in the repository, for scripts/break."""

import functools
import json
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAM = Path(os.environ.get("DEPTHMOCAP_PROGRAM", ROOT / "build/depthmocap"))  # another build: with sanitizers
FRAMES = 4  # of a recording

# name, parent, direction, length [m], degrees of freedom
BONES = [
    ("lhipjoint", "root", (0.9, -0.4, 0), 0.1, ""), ("lfemur", "lhipjoint", (0, -1, 0), 0.42, "rx ry rz"),
    ("ltibia", "lfemur", (0, -1, 0), 0.42, "rx"), ("lfoot", "ltibia", (0, -0.3, 0.95), 0.16, "rx rz"),
    ("rhipjoint", "root", (-0.9, -0.4, 0), 0.1, ""), ("rfemur", "rhipjoint", (0, -1, 0), 0.42, "rx ry rz"),
    ("rtibia", "rfemur", (0, -1, 0), 0.42, "rx"), ("rfoot", "rtibia", (0, -0.3, 0.95), 0.16, "rx rz"),
    ("lowerback", "root", (0, 1, 0), 0.18, "rx ry rz"), ("upperback", "lowerback", (0, 1, 0), 0.18, "rx ry rz"),
    ("thorax", "upperback", (0, 1, 0), 0.15, "rx ry rz"), ("lowerneck", "thorax", (0, 1, 0), 0.08, "rx ry rz"),
    ("head", "lowerneck", (0, 1, 0), 0.15, "rx ry rz"), ("lclavicle", "thorax", (1, 0, 0), 0.17, "ry rz"),
    ("lhumerus", "lclavicle", (1, 0, 0), 0.29, "rx ry rz"), ("lradius", "lhumerus", (1, 0, 0), 0.25, "rx"),
    ("rclavicle", "thorax", (-1, 0, 0), 0.17, "ry rz"), ("rhumerus", "rclavicle", (-1, 0, 0), 0.29, "rx ry rz"),
    ("rradius", "rhumerus", (-1, 0, 0), 0.25, "rx"),
]


def asf():
    bones = ""
    for number, (name, _, (x, y, z), length, dofs) in enumerate(BONES, 1):
        dof = f"dof {dofs}\nlimits " + "\n".join(["(-180 180)"] * len(dofs.split())) + "\n" if dofs else ""
        bones += f"begin\nid {number}\nname {name}\ndirection {x} {y} {z}\nlength {length / 0.0254 * 0.45:.4f}\naxis 0 0 0 XYZ\n{dof}end\n"
    children = {}
    for name, parent, *_ in BONES:
        children.setdefault(parent, []).append(name)
    hierarchy = "".join(f"{parent} {' '.join(names)}\n" for parent, names in children.items())
    return (":version 1.10\n:name small\n:units\nmass 1.0\nlength 0.45\nangle deg\n:root\norder TX TY TZ RX RY RZ\n"
            "axis XYZ\nposition 0 0 0\norientation 0 0 0\n:bonedata\n" + bones + ":hierarchy\nbegin\n" + hierarchy + "end\n")


def amc():
    text = ":FULLY-SPECIFIED\n:DEGREES\n"
    for frame in range(1, 9):
        text += f"{frame}\nroot 0 17 {frame * 0.1:.2f} 0 {frame} 0\n"
        for name, _, _, _, dofs in BONES:
            if dofs:
                text += name + "".join(f" {2.0 * frame:.1f}" for _ in dofs.split()) + "\n"
    return text


def run_quietly(*arguments):
    subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@functools.cache
def made(name):
    """The bytes of a file that the program makes itself."""
    with tempfile.TemporaryDirectory() as folder:
        walk, out = ROOT / "recordings/walk", Path(folder) / name
        if name == "a.bvh":
            run_quietly("replay", walk, "--last", "9", "--bvh", out)
        elif name == "a.posedb":
            run_quietly("posedb", "build", "--procedural", "--threshold", "0.5", "--mirror", "off", "--out", out)
        elif name == "settings.json":
            run_quietly("replay", walk, "--last", "0", "--save-config", out)
        else:
            short = Path(folder) / "short.csv"
            lines = (walk / "truth/joints.csv").read_text().splitlines(keepends=True)
            short.write_text("".join(lines[:40]))
            if name == "m.csv":
                return short.read_bytes()
            run_quietly("repair", short, "--out", out)
        return out.read_bytes()


def recording(folder, name="walk", kept=range(FRAMES)):
    """The frames of these numbers."""
    source = ROOT / "recordings" / name
    late = re.compile(r"\d+\.png")
    shutil.copytree(source, folder, ignore=lambda _, names: [n for n in names if late.fullmatch(n) and int(n[:-4]) not in kept])
    for table in ["frames.csv", "truth/joints.csv", "truth/pose.csv"]:
        if (folder / table).exists():
            lines = (folder / table).read_text().splitlines(keepends=True)
            rows = [l for l in lines if not re.match(r"\d", l) or int(l.split(",")[0]) in kept]
            (folder / table).write_text("".join(rows))


def tum(folder):
    recording(folder)
    (folder / "recording.json").unlink()
    (folder / "frames.csv").unlink()
    (folder / "depth.txt").write_text("".join(f"{i / 30:.6f} depth/{i:06d}.png\n" for i in range(FRAMES)))


def make_input(kind, folder):
    folder.mkdir()
    if kind == "recording":
        recording(folder / "rec")
    elif kind == "poses":  # that differ
        recording(folder / "rec", "walk", range(0, 120, 6))
    elif kind == "tum":
        tum(folder / "rec")
    elif kind == "settings":
        recording(folder / "rec")
        (folder / "settings.json").write_bytes(made("settings.json"))
        shutil.copy(ROOT / "tests/data/actors/good.json", folder / "actor.json")
    elif kind == "oni":
        shutil.copy(ROOT / "tests/data/recordings/openni2.oni", folder / "a.oni")
    elif kind == "ik":
        shutil.copy(ROOT / "tests/data/ik/targets_good.csv", folder / "t.csv")
        shutil.copy(ROOT / "forest/models/pose_priors.bin", folder / "priors.bin")
        shutil.copy(ROOT / "tests/data/actors/good.json", folder / "actor.json")
    elif kind == "picture":
        places = {"head": (320, 100), "neck": (320, 140), "left_wrist": (450, 200), "right_wrist": (190, 200),
                  "pelvis": (320, 260), "left_ankle": (350, 440), "right_ankle": (290, 440)}
        (folder / "t.csv").write_text("pose_id,joint,u,v\n" + "".join(f"a,{j},{u},{v}\n" for j, (u, v) in places.items()))
        shutil.copy(ROOT / "recordings/walk/recording.json", folder / "c.json")
    elif kind == "forest":
        shutil.copy(ROOT / "forest/models/tpose.forest", folder / "a.forest")
    elif kind == "posedb":
        (folder / "a.posedb").write_bytes(made("a.posedb"))
    elif kind == "bvh":
        (folder / "a.bvh").write_bytes(made("a.bvh"))
        (folder / "bones.json").write_text(json.dumps({"head": "Head"}))
    elif kind == "asf":
        (folder / "a.asf").write_text(asf())
        (folder / "a.amc").write_text(amc())
    else:
        (folder / kind).write_bytes(made(kind))  # m.csv, m.trc, m.c3d
