"""3. Against another tracker on real data (section 6.3 of the paper): MSR Action3D's reference skeletons."""
import collections
import csv
import statistics

from measuring.lab import DATA
from measuring.tables import mean, number, table

ACTIONS = ("high arm wave, horizontal arm wave, hammer, hand catch, forward punch, high throw, draw x, draw tick, "
           "draw circle, hand clap, two hand wave, side boxing, bend, forward kick, side kick, jogging, tennis swing, "
           "tennis serve, golf swing, pick up and throw").split(", ")
# Joints that two skeletons can agree on; the reference's hips, pelvis, spine, neck and head stand for other places of
# the body than ours.
LIMB_JOINTS = [f"{side}_{joint}" for side in ("left", "right") for joint in ("shoulder", "elbow", "wrist", "knee", "ankle")]


def acceleration(path, frames):
    """Mean and median acceleration [m/s^2] of the limb joints over frames whose neighbours are there, too."""
    with open(path) as file:
        rows = {int(r["frame"]): r for r in csv.DictReader(line for line in file if not line.startswith("#"))}
    values = []
    for frame in frames:
        three = [rows.get(frame + k) for k in (-1, 0, 1)]
        if any(r is None or r["state"] == "lost" for r in three):
            continue
        dt = (float(three[2]["time_s"]) - float(three[0]["time_s"])) / 2
        for joint in LIMB_JOINTS:
            difference = [sum(w * float(r[f"{joint}_{axis}"]) for w, r in zip((1, -2, 1), three)) for axis in "xyz"]
            values.append(sum(d * d for d in difference) ** 0.5 / dt ** 2)
    return values


def reference_frames(path):
    with open(path) as file:
        return [int(r["frame"]) for r in csv.DictReader(line for line in file if not line.startswith("#"))
                if r["state"] == "tracking"]


def measure(lab, recording, *options):
    reference = recording / "reference" / "joints.csv"
    if not reference.exists():
        return None
    run = lab.track(recording, *options, truth=reference)
    if run.figures["compared"] == 0:
        return None
    frames = reference_frames(reference)
    per_joint = run.figures["per_joint_error_m"]
    return {"name": recording.name, "compared": run.figures["compared"],
            "limbs": 1000 * mean([per_joint[j] for j in LIMB_JOINTS]), "bones": run.figures["mean_bone_direction_error_deg"],
            "ours": acceleration(run.joints, frames), "theirs": acceleration(reference, frames),
            "lost": run.stats["lost"]}


def weighted(entries, key):
    return sum(e[key] * e["compared"] for e in entries) / sum(e["compared"] for e in entries)


def tracked_share(lab, recordings):
    stats = lab.map(lambda r: lab.stats(r, "--threads", 1), recordings)
    frames, tracked = (sum(s[key] for s in stats) for key in ("frames", "tracked"))
    return (f"Of the {frames} frames of all {len(recordings)} sequences, those without a usable reference too, "
            f"{100 * tracked / frames:.1f} % were tracked.")


def section(lab):
    recordings = sorted((DATA / "real" / "msr").iterdir())
    if lab.quick:
        recordings = [r for r in recordings if r.name.startswith(("a02_s01", "a14_s01", "a16_s01", "a18_s01"))]
    ways = {"as they come": (), "`--smooth 0.25`": ("--smooth", 0.25), "the paper's method": ("--method", "paper")}
    jobs = [(r, w) for r in recordings for w in ways]
    found = dict(zip(jobs, lab.map(lambda j: measure(lab, j[0], *ways[j[1]]), jobs)))
    entries = {w: [e for r in recordings if (e := found[r, w])] for w in ways}
    by_action = collections.defaultdict(list)
    for entry in entries["as they come"]:
        by_action[entry["name"][:3]].append(entry)

    def line(name, part):
        ours, theirs = ([a for e in part for a in e[k]] for k in ("ours", "theirs"))
        return [name, str(sum(e["compared"] for e in part)), number(weighted(part, "limbs"), 0), number(weighted(part, "bones")),
                number(mean(ours)), number(mean(theirs)), number(statistics.median(ours)), number(statistics.median(theirs)),
                str(sum(e["lost"] for e in part))]
    rows = [line(f"{a} {ACTIONS[int(a[1:]) - 1]}", by_action[a]) for a in sorted(by_action)]
    rows += [line(f"**all, {w}**", entries[w]) for w in ways]
    return ["Real Kinect v1 frames against the data set's reference skeleton, which is another tracker's output with errors of "
            "5 to 10 cm, not truth: this is agreement. Shoulders, elbows, wrists, knees and ankles; the reference's pelvis, hips "
            "and head stand for other places of the body, which is also in \"bones\". Acceleration of the same joints, of "
            "both trackers over the same frames (15 a second): a steadier tracker has less, and motion is the same in both.", "",
            *table(["action", "frames", "agreement [mm]", "bones [deg]", "our acceleration, mean [m/s2]", "theirs, mean",
                    "ours, median", "theirs, median", "our lost frames"], rows),
            "", tracked_share(lab, recordings)]
