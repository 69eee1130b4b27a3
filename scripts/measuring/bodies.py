"""4. Four very different actors and one more (section 6.4 of the paper)."""
import json

from measuring.motions import HELD_OUT, Body, take_of
from measuring.tables import mean, number, table

BODIES = [Body("m", 1.80, 90), Body("m", 1.75, 60), Body("m", 1.82, 55), Body("f", 1.62, 50), Body("f", 1.50, 45)]
FRAMES = 60
MOTIONS = ("16_15", "14_02", "127_02")


def section(lab):
    motions = MOTIONS[:1] if lab.quick else MOTIONS

    def measure(job):
        body, motion = job
        take = take_of(motion)
        recording = lab.render(motion, *body.options, "--first", take.first, "--last", take.first + FRAMES - 1)
        actor = lab.actor(*body.options)
        base = ("--posedb", lab.database(HELD_OUT))
        return (lab.track(recording, *base), lab.track(recording, *base, "--actor", actor),
                lab.track(recording, *base, *body.true_body), json.loads(actor.read_text())["stature_m"])
    jobs = [(b, m) for b in BODIES for m in motions]
    results = dict(zip(jobs, lab.map(measure, jobs)))
    rows = []
    for body in [*BODIES, None]:
        part = [results[b, m] for b, m in jobs if body in (None, b)]
        columns = [[p[i] for p in part] for i in range(3)]
        rows.append([str(body) if body else "**all**",
                     number(part[0][3], 3) if body else "", number(mean([r.stats["stature_m"] for r in columns[0]]), 3) if body else "",
                     *(number(mean([r.joints_mm for r in c]), 0) for c in columns),
                     *(number(mean([r.angles_deg for r in c]), 2) for c in columns),
                     *(number(mean([r.figures["map_10cm"] for r in c]), 3) for c in columns),
                     str(sum(r.stats["lost"] for c in columns for r in c))])
    names = ", ".join(f"{take_of(m).kind} {m}" for m in motions)
    return [f"{names}, up to {FRAMES} frames each, by each body; without calibration (the size is fitted while tracking), with a body calibrated on a rendered "
            "T-pose, and with the rendered body itself.", "",
            *table(["actor", "calibrated stature [m]", "fitted stature [m]"]
                   + [f"{b} [{u}]" for u in ("mm", "deg") for b in ("average", "calibrated", "true")]
                   + [f"map: {b}" for b in ("average", "calibrated", "true")] + ["lost"], rows)]
