"""The commands that scripts/break tries."""

from typing import NamedTuple


class Command(NamedTuple):
    kind: str  # of the input, see inputs.py; it lies in the folder `in`
    arguments: str  # outputs are named out*


COMMANDS = {
    "replay": Command("recording", "replay in/rec --last 3 --joints out.csv --bvh out.bvh --labels out_labels --threads 1"),
    "preview": Command("recording", "replay in/rec --last 3 --preview out.mp4 --stats out.json --threads 1"),
    "tum": Command("tum", "replay in/rec --last 3 --joints out.csv --depth-unit 1 --threads 1"),
    "settings": Command("settings", "replay in/rec --last 1 --config in/settings.json --actor in/actor.json --pose out.csv"),
    "live": Command("recording", "live --source replay:in/rec --speed 0 --pose out.csv --gltf out.glb --threads 1"),
    "record": Command("recording", "record --source replay:in/rec --speed 0 --out out_rec"),
    "oni": Command("oni", "record --source replay:in/a.oni --speed 0 --out out_rec"),
    "calibrate": Command("poses", "calibrate in/rec --any-pose --frames 4 --out out.json --threads 1"),
    "evaluate": Command("recording", "evaluate --joints in/rec/truth/joints.csv --truth in/rec"),
    "ik": Command("ik", "ik --targets in/t.csv --priors in/priors.bin --actor in/actor.json --prior ppca --out out.csv"),
    "picture": Command("picture", "ik --targets in/t.csv --projection pinhole --camera in/c.json --out out.csv"),
    "repair_csv": Command("m.csv", "repair in/m.csv --out out.trc --poses out.csv --bvh out.bvh --threads 1"),
    "repair_trc": Command("m.trc", "repair in/m.trc --out out.c3d --threads 1"),
    "repair_c3d": Command("m.c3d", "repair in/m.c3d --out out.csv --threads 1"),
    "forest": Command("forest", "forest info in/a.forest"),
    "posedb_bvh": Command("bvh", "posedb build --motions in --out out.posedb --threads 1"),
    "posedb_asf": Command("asf", "posedb build --motions in --out out.posedb --threads 1"),
    "posedb_info": Command("posedb", "posedb info in/a.posedb --sources"),
    "mixture": Command("posedb", "posedb learn --posedb in/a.posedb --components 4 --out out.mixture --threads 1"),
    "motion_bvh": Command("bvh", "motion in/a.bvh --bones in/bones.json --joints out.csv"),
    "motion_amc": Command("asf", "motion in/a.amc --joints out.csv"),
    "synthesize": Command("bvh", "synthesize --motion in/a.bvh --out out_rec --last 1 --threads 1"),
}


def outputs(command):
    """The names of the files and folders that a command writes."""
    return [a for a in command.arguments.split() if a.startswith("out")]
