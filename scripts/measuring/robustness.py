"""6. Where it breaks."""
import math

from measuring import angles, plots
from measuring.motions import HELD_OUT, take_of
from measuring.tables import mean, number, table

MOTIONS = ("16_22", "127_07", "14_02")
FRAMES = 45


class Series:
    """One disturbance: recordings and options by its strength. A reading is (options of synthesize, of Lab.variant, of
    experiment)."""

    def __init__(self, name, unit, values, reading):
        self.name, self.unit, self.values, self.reading = name, unit, values, reading


def occlusion(side, board):
    return lambda share: ((), {}, ("--occlude", share / 100, "--occluder", side, "--board", board))


SERIES = [
    Series("yaw", "deg", (0, 30, 60, 90, 120, 150, 180), lambda v: (("--yaw", v), {}, ())),
    Series("distance", "m", (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5), lambda v: (("--distance", v), {}, ())),
    Series("occluded from below, not measured", "%", (0, 10, 20, 30, 40), occlusion("below", 0)),
    Series("occluded from the left, not measured", "%", (0, 10, 20, 30, 40), occlusion("left", 0)),
    Series("occluded from the left by a board 1 m from the camera", "%", (0, 10, 20, 30, 40), occlusion("left", 1.0)),
    Series("frames a second", "1/s", (30, 15, 10, 7.5, 6, 5), lambda v: ((), {"every": round(30 / v)}, ())),
    Series("fast motion", "times", (1, 2, 3), lambda v: ((), {"every": v, "speed": v}, ())),
    Series("wrong size of the actor", "%", (-10, -5, 0, 5, 10), lambda v: ((), {}, ("--actor-scale", 1 + v / 100))),
    Series("stature to start from, without an actor file", "m", (1.45, 1.6, 1.75, 1.9, 2.05),
           lambda v: ((), {}, ("--stature", v))),
    Series("room", "", ("none", "room"), lambda v: (("--scene", v), {}, ())),
]


def measure(lab, motion, series, value):
    render, variant, options = series.reading(value)
    take = take_of(motion)
    yaw = () if "--yaw" in render else ("--yaw", take.yaw_deg)
    recording = lab.variant(lab.render(motion, *take.body.options, "--first", take.first, "--last", take.first + FRAMES - 1,
                                       *yaw, *render), **variant)
    body = () if "--stature" in options else take.body.true_body
    return lab.track(recording, "--posedb", lab.database(HELD_OUT), *body, *options)


def recovery(lab, motion):
    """Frames until the mean joint error is below 10 cm again after half a second without any measurement."""
    take = take_of(motion)
    recording = lab.render(motion, *take.body.options, "--first", take.first, "--last", take.first + FRAMES - 1, "--yaw",
                           take.yaw_deg)
    last = 29
    run = lab.track(recording, "--posedb", lab.database(HELD_OUT), *take.body.true_body, "--first-blank", last - 14,
                    "--last-blank", last)
    good = [f for f, error in angles.joint_errors_mm(run) if f > last and error < 100]
    return (good[0] - last) / 30 if good else math.inf


def section(lab):
    motions = MOTIONS[:2] if lab.quick else MOTIONS
    lines = [f"{', '.join(f'{take_of(m).kind} {m}' for m in motions)}: up to {FRAMES} frames each, the true body unless the size "
             "is what is wrong, noise of Kinect v1, motions left out of the database. Lost: frames without a pose (the tracker "
             "carries a pose on for 0.4 s before). A hit is a joint within 10 cm.", ""]
    panels, rows = {}, []
    for series in SERIES:
        jobs = [(m, v) for v in series.values for m in motions]
        runs = dict(zip(jobs, lab.map(lambda job, s=series: measure(lab, job[0], s, job[1]), jobs)))
        points = []
        for value in series.values:
            part = [runs[m, value] for m in motions]
            error = mean([r.joints_mm for r in part])
            points.append((value, error))
            worst = max(part, key=lambda r: r.joints_mm if r.joints_mm == r.joints_mm else 1e9)
            rows.append([series.name, f"{value} {series.unit}".strip(), number(error, 0),
                         number(mean([r.angles_deg for r in part]), 2), number(mean([r.figures["map_10cm"] for r in part]), 3),
                         f"{sum(r.stats['lost'] for r in part)} of {sum(r.stats['frames'] for r in part)}",
                         f"{take_of(motions[part.index(worst)]).kind}: {number(worst.joints_mm, 0)}"])
        if series.unit:
            panels[f"{series.name} [{series.unit}]"] = {"mean": points}
    lines += table(["what", "how much", "joints [mm]", "angles [deg]", "hits", "lost frames", "worst motion [mm]"], rows)
    seconds = lab.map(lambda m: recovery(lab, m), motions)
    lines += ["", "Half a second without any measurement, then the actor is there again: the joints are within 10 cm after "
              + ", ".join(f"{number(s, 2) if math.isfinite(s) else 'never'} s ({take_of(m).kind} {m})" for s, m in zip(seconds, motions))
              + ".", "", plots.curves("accuracy-robustness.png", panels, "", "joint error [mm]", columns=3)]
    return lines
