"""10. Sensors: structured light, time of flight, active stereo; frame by frame and as a whole recording."""
from measuring.motions import HELD_OUT, TUNED_ON, takes
from measuring.tables import mean, number, table

FRAMES = 60
CAMERAS = {"Kinect v1": "kinect1", "time of flight (Kinect v2)": "kinect2", "active stereo (D435)": "d435"}
BODIES = ("average", "true")
WAYS = {"live": (), "replay": ("--look-ahead", 0.3, "--two-passes")}


def recording(lab, take, camera):
    options = [*take.body.options, "--yaw", take.yaw_deg, "--first", take.first, "--last", take.first + lab.frames(FRAMES) - 1]
    return lab.render(take.motion, *options, "--camera", camera)


def track(lab, take, camera, body, way):
    options = take.body.true_body if body == "true" else ()
    return lab.track(recording(lab, take, camera), "--posedb", lab.database(HELD_OUT), *options, *WAYS[way])


def row(name, camera, body, runs):
    """runs: {way: [Run]}."""
    cells = []
    for way in WAYS:
        cells += [number(mean([r.angles_deg for r in runs[way]]), 2), number(mean([r.joints_mm for r in runs[way]])),
                  number(mean([r.figures["map_10cm"] for r in runs[way]]), 3),
                  number(mean([r.figures["jitter_m_s2"] for r in runs[way]]))]
    return [name, camera, body, *cells, str(sum(r.stats["lost"] for way in WAYS for r in runs[way]))]


def section(lab):
    chosen = takes(lab)
    jobs = [(take, camera, body, way) for camera in CAMERAS for body in BODIES for take in chosen for way in WAYS]
    results = dict(zip(jobs, lab.map(lambda job: track(lab, job[0], CAMERAS[job[1]], *job[2:]), jobs)))
    groups = {f"all {len(chosen)}": chosen, "not used to choose weights": [t for t in chosen if t.motion not in TUNED_ON]}
    rows = [row(name, camera, body, {way: [results[t, camera, body, way] for t in picked] for way in WAYS})
            for name, picked in groups.items() for camera in CAMERAS for body in BODIES]
    lines = [f"The motions of section 1, {lab.frames(FRAMES)} frames each, rendered with the noise of three kinds of camera; none of the "
             "motions is in the database. Average: a body whose size is fitted while tracking; true: the body that was rendered. Live: each "
             "frame by those before it; replay: the poses that explain all frames together (`--look-ahead 0.3`).", ""]
    measures = ("angles [deg]", "joints [mm]", "map", "jitter [m/s2]")
    lines += table(["motions", "camera", "body", *(f"{way}: {m}" for way in WAYS for m in measures), "lost"], rows)
    return lines
