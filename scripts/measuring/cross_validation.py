"""1. Cross-validation (section 6.1 of the paper): motions that are not in the database, bodies that no forest saw."""
from measuring import angles, plots
from measuring.motions import HELD_OUT, TUNED_ON, takes
from measuring.tables import mean, number, table

FRAMES = 100
BODIES = ("average", "calibrated", "true", "true, no noise")


def track(lab, take, body):
    recording = take.render(lab, FRAMES, noise="no noise" not in body)
    options = {"average": lambda: (), "calibrated": lambda: ("--actor", lab.actor(*take.body.options))}.get(
        body, lambda: take.body.true_body)()
    return lab.track(recording, "--posedb", lab.database(HELD_OUT), *options)


def row(name, runs, frames):
    """runs: {body: [Run]}."""
    cells = [f"{len(runs['average'])} motions" if frames is None else name[1], str(frames or "")]
    for body in BODIES:
        cells += [number(mean([r.angles_deg for r in runs[body]]), 2), number(mean([r.joints_mm for r in runs[body]]), 0)]
    for body in BODIES[:2]:
        cells.append(number(mean([r.figures["map_10cm"] for r in runs[body]]), 3))
    calibrated = runs["calibrated"]
    return [name[0], *cells, number(mean([angles.observable_mean_deg(r) for r in calibrated]), 2),
            number(mean([r.figures["mean_bone_direction_error_deg"] for r in calibrated])),
            number(mean([r.figures["jitter_m_s2"] for r in calibrated])),
            str(sum(r.stats["lost"] for body in BODIES for r in runs[body]))]


def section(lab):
    chosen = takes(lab)
    jobs = [(take, body) for take in chosen for body in BODIES]
    results = dict(zip(jobs, lab.map(lambda job: track(lab, *job), jobs)))
    rows = []
    for take in chosen:
        runs = {body: [results[take, body]] for body in BODIES}
        rows.append(row((take.kind, take.motion), runs, runs["average"][0].figures["frames"]))
    sums = {"**walk, run, kick**": [t for t in chosen if t.kind in ("walk", "run", "kick")],
            "**not used to choose weights**": [t for t in chosen if t.motion not in TUNED_ON], "**all**": chosen}
    for label, picked in sums.items():
        rows.append(row((label,), {body: [results[t, body] for t in picked] for body in BODIES}, None))
    lines = [f"All {len(HELD_OUT)} motions are left out of the pose database at once, which is at least as hard as one at a "
             "time; the database keeps the other takes of the same performers. The forest has seen none of them but 14_24. Rendered with the noise of Kinect v1 at 30 "
             f"frames a second, up to {lab.frames(FRAMES)} frames each, all motions with different bodies. Columns: an average body whose size "
             "is fitted while tracking (as the program does by itself) | a body calibrated on a T-pose | the body that was "
             "rendered | the same without the sensor's noise. \"Observable\" leaves out the twist of upper arms and thighs while elbow or knee are bent by less than "
             f"{angles.LEAST_BEND_DEG} degrees; it, bones, jitter are of the calibrated body; lost frames are of all four.", ""]
    lines += table(["kind", "motion", "frames"] + [f"{b}: {u}" for b in BODIES for u in ("angles [deg]", "joints [mm]")]
                   + ["average: map", "calibrated: map", "observable [deg]", "bones [deg]", "jitter [m/s2]", "lost"], rows)
    wanted = {"walk, run, kick": [t for t in chosen if t.kind in ("walk", "run", "kick")],
              "the others": [t for t in chosen if t.kind not in ("walk", "run", "kick")]}
    groups = {label: angles.by_angle([results[t, "calibrated"] for t in picked]) for label, picked in wanted.items() if picked}
    seen = angles.by_angle([results[t, "calibrated"] for t in wanted["walk, run, kick"]], only_observable=True)
    lines += ["", "Each joint angle, calibrated body, left and right together; the lines are the paper's mean of 1.5 degrees "
              "and its largest of 2.5.", "", plots.bars("accuracy-angles.png", groups, "mean error [deg]", (1.5, 2.5)), ""]
    names = list(next(iter(groups.values())))
    lines += table(["joint angle", *(f"{g} [deg]" for g in groups), "walk, run, kick, while observable [deg]"],
                   [[n, *(number(g[n]) for g in groups.values()), number(seen.get(n))] for n in names])
    return lines
