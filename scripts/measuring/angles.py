"""Joint angles of a run, degree of freedom by degree of freedom and frame by frame."""
import csv
import math

from measuring.tables import mean

FIRST_JOINT_ANGLE = 6  # the six of the root come before


def read_poses(path):
    """Frame -> {DoF: value}."""
    with open(path) as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {int(row["frame"]): {k: float(v) for k, v in row.items() if k not in ("frame", "time_s")} for row in rows}


# The twist of a straight limb turns nothing but the skin, and a small bend makes it as uncertain as the noise is large
# against the bend: below it the twist is no more than guessed by the prior.
LEAST_BEND_DEG = 30
TWISTS = {"rhumerus_rx": "rradius_ry", "lhumerus_rx": "lradius_ry", "rfemur_ry": "rtibia_rx", "lfemur_ry": "ltibia_rx"}


def observable(dof, truth):
    return dof not in TWISTS or abs(math.degrees(truth[TWISTS[dof]])) >= LEAST_BEND_DEG


def errors_deg(run):
    """[(frame, {DoF: error}, {DoF: whether the truth can be observed})]."""
    found, truth = read_poses(run.pose), read_poses(run.recording / "truth" / "pose.csv")
    result = []
    for frame in sorted(found.keys() & truth.keys()):
        a, b = found[frame], truth[frame]
        dofs = list(b)[FIRST_JOINT_ANGLE:]
        result.append((frame, {d: abs(math.degrees(math.remainder(a[d] - b[d], 2 * math.pi))) for d in dofs},
                       {d: observable(d, b) for d in dofs}))
    return result


def sides(dof):
    """'rtibia_rx' and 'ltibia_rx' are one joint angle."""
    bone = dof.split("_")[0]
    paired = bone[1:] in ("clavicle", "humerus", "radius", "femur", "tibia", "foot")
    return dof[1:] if paired else dof


def by_angle(runs, only_observable=False):
    """{joint angle: mean error [deg]}, left and right together, over all frames of the runs."""
    values = {}
    for run in runs:
        for _, error, seen in errors_deg(run):
            for dof, value in error.items():
                if seen[dof] or not only_observable:
                    values.setdefault(sides(dof), []).append(value)
    return {angle: mean(v) for angle, v in values.items()}


def observable_mean_deg(run):
    return mean([value for _, error, seen in errors_deg(run) for dof, value in error.items() if seen[dof]])


def joint_errors_mm(run):
    """[(frame, mean distance of the joints from the truth)]; a lost frame is missing."""
    def read(path):
        with open(path) as file:
            return {int(r["frame"]): r for r in csv.DictReader(line for line in file if not line.startswith("#"))}
    found, truth = read(run.joints), read(run.recording / "truth" / "joints.csv")
    result = []
    for frame, b in sorted(truth.items()):
        a = found.get(frame)
        if a is None or a["state"] == "lost":
            continue
        names = [key[:-2] for key in b if key.endswith("_x")]
        result.append((frame, 1000 * mean([math.dist([float(a[f"{n}_{k}"]) for k in "xyz"],
                                                     [float(b[f"{n}_{k}"]) for k in "xyz"]) for n in names])))
    return result
