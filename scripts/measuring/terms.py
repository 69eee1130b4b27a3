"""2. What each term is worth (section 6.2 of the paper)."""
from measuring import angles, plots
from measuring.motions import HELD_OUT, take_of
from measuring.tables import mean, number, table

MOTIONS = ("16_22", "127_07", "135_02", "14_02", "05_02")
FRAMES = 60
# The parts that are ours, as --without names them, and what they are.
OURS = {
    "push-in": "markers pushed into the body", "limits": "joint limits", "sides": "expectation of sides",
    "recovery": "a global search where the fit is poor", "feet": "feet that stand are held", "gaussian": "a Gaussian as local model",
    "weights": "our weights", "dense": "dense surface term",
}


def without(*parts):
    return ("--without", ",".join(parts)) if parts else ()


def configurations():
    ours = list(OURS)
    result = {"markers alone (pure IK)": without(*ours, "prior", "smooth"), "markers + prior": without(*ours, "smooth"),
              "markers + prior + smoothness (the paper)": without(*ours)}
    for part, text in OURS.items():
        result[f"the paper + {text}"] = without(*(p for p in ours if p != part))
    result["the paper + our weights + dense surface term"] = without(*(p for p in ours if p not in ("weights", "dense")))
    result["everything"] = ()
    for part, text in OURS.items():
        result[f"everything but {text}"] = without(part)
    result["everything but the prior"] = without("prior")
    result["everything but smoothness"] = without("smooth")
    return result


def section(lab):
    motions = MOTIONS[:2] if lab.quick else MOTIONS
    options = configurations()

    def track(job):
        motion, name = job
        take = take_of(motion)
        return lab.track(take.render(lab, FRAMES), "--posedb", lab.database(HELD_OUT), *take.body.true_body, *options[name])
    jobs = [(motion, name) for motion in motions for name in options]
    runs = dict(zip(jobs, lab.map(track, jobs)))
    rows = []
    for name in options:
        of_all = [runs[m, name] for m in motions]
        rows.append([name, *(number(runs[m, name].joints_mm, 0) for m in motions),
                     number(mean([r.joints_mm for r in of_all]), 0), number(mean([r.angles_deg for r in of_all]), 2),
                     number(mean([r.figures["jitter_m_s2"] for r in of_all]), 0), str(sum(r.stats["lost"] for r in of_all))])
    lines = [f"The true body, up to {lab.frames(FRAMES)} frames of each motion, noise of Kinect v1, motions left out of the database. The first "
             "three rows are the paper's terms with its weights; then each of our additions alone on top of them; then all "
             "of them, and all but one.", ""]
    kinds = [f"{take_of(m).kind} {m} [mm]" for m in motions]
    lines += table(["terms", *kinds, "joints [mm]", "angles [deg]", "jitter [m/s2]", "lost"], rows)
    shown = [*list(options)[:3], "everything"]
    panels = {f"{take_of(m).kind} ({m})": {n: angles.joint_errors_mm(runs[m, n]) for n in shown} for m in motions[:4]}
    lines += ["", "Mean joint error over the frames, as in figure 9 of the paper.", "",
              plots.curves("accuracy-terms.png", panels, "frame", "joint error [mm]", y_top=200)]
    return lines

