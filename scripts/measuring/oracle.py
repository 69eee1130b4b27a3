"""7. What perfect evidence would leave."""
from measuring import angles
from measuring.motions import HELD_OUT, take_of, takes
from measuring.tables import mean, number, table

FRAMES = 60
WAYS = {
    "as tracked": (),
    "true labels": ("--true-labels",),
    "exact markers": ("--true-markers",),
    "exact markers alone": ("--true-markers", "--without", "dense"),
    "the same, the paper's weights": ("--true-markers", "--without", "dense,weights"),
    "the same, unsmoothed": ("--true-markers", "--without", "dense,smooth"),
    "the same, no prior": ("--true-markers", "--without", "dense,smooth,prior,recovery"),
}


def section(lab):
    chosen = [t for t in takes(lab) if t.kind in ("walk", "run", "kick")]

    def track(job):
        take, way = job
        return lab.track(take.render(lab, FRAMES), "--posedb", lab.database(HELD_OUT), *take.body.true_body, *WAYS[way])
    jobs = [(t, w) for t in chosen for w in WAYS]
    runs = dict(zip(jobs, lab.map(track, jobs)))
    of = {w: [runs[t, w] for t in chosen] for w in WAYS}
    angle = {w: angles.by_angle(of[w]) for w in WAYS}
    rows = [[name, *(number(angle[w][name]) for w in WAYS)] for name in angle["as tracked"]]
    rows.append(["**mean angle [deg]**", *(number(mean([r.angles_deg for r in of[w]]), 2) for w in WAYS)])
    rows.append(["**mean, observable [deg]**", *(number(mean([angles.observable_mean_deg(r) for r in of[w]]), 2) for w in WAYS)])
    rows.append(["**joints [mm]**", *(number(mean([r.joints_mm for r in of[w]]), 0) for w in WAYS)])
    return ["Walk, run and kick with the true body. True labels: each pixel's part is the rendered one. Exact markers: the 15 "
            "markers are those of the true pose (the dense term still sees the depth); alone: without the dense term; then "
            "with the paper's weights, without smoothness, and without prior: inverse kinematics of exact markers, so what is left are the angles that "
            "15 markers do not determine.", "",
            *table(["joint angle [deg]", *WAYS], rows)]
