"""11. Rare postures: kicks, bends, kneeling, sitting, crouching, upside down; from four sides."""
import dataclasses

from measuring.motions import HELD_OUT, Body
from measuring.tables import mean, number, table

FRAMES = 60
YAWS_DEG = {"the front": 0, "the left": 90, "behind": 180, "the right": 270}
BODIES = [Body("m", 1.76, 74), Body("f", 1.64, 60), Body("m", 1.85, 95), Body("f", 1.71, 55)]  # in turn


@dataclasses.dataclass(frozen=True)
class Posture:
    kind: str
    motion: str
    first: int


POSTURES = [
    Posture("kick", "135_07", 20), Posture("kick", "135_02", 300), Posture("kick", "11_01", 40), Posture("kick", "02_05", 100),
    Posture("kick", "procedural:kick_side", 20), Posture("kick", "procedural:kick_roundhouse", 20),
    Posture("kick", "procedural:knee_strike", 20),
    Posture("leg raised", "05_05", 60), Posture("leg raised", "05_18", 60), Posture("leg raised", "procedural:balance_one_leg", 40),
    Posture("leg raised", "procedural:knee_raises", 20), Posture("leg raised", "procedural:leg_swings", 20),
    Posture("bend", "02_06", 100), Posture("bend", "05_04", 120), Posture("bend", "127_29", 0),
    Posture("bend", "procedural:toe_touch", 40), Posture("bend", "procedural:tie_shoe", 40), Posture("bend", "procedural:side_bends", 40),
    Posture("bend", "procedural:pick_up", 30),
    Posture("kneel", "procedural:kneel", 40), Posture("kneel", "procedural:kneel_one_knee", 40),
    Posture("crouch", "procedural:crouch", 40), Posture("crouch", "procedural:squat", 30), Posture("crouch", "procedural:lunge", 30),
    Posture("sit", "14_27", 150), Posture("sit", "14_30", 250), Posture("sit", "14_29", 250), Posture("sit", "procedural:sit_and_move", 60),
    Posture("arms overhead, crossed", "procedural:clap_overhead", 20), Posture("arms overhead, crossed", "procedural:hands_behind_head", 30),
    Posture("arms overhead, crossed", "procedural:arms_crossed", 20),
    Posture("upside down", "49_06", 40), Posture("upside down", "127_23", 25), Posture("jump", "procedural:jump_tuck", 30),
]


def track(lab, job):
    number_of, posture, yaw_deg = job
    body = BODIES[number_of % len(BODIES)]
    recording = lab.render(posture.motion, *body.options, "--yaw", yaw_deg, "--first", posture.first, "--last",
                           posture.first + lab.frames(FRAMES) - 1)
    captured = [p.motion for p in POSTURES if ":" not in p.motion]
    return lab.track(recording, "--posedb", lab.database(sorted({*HELD_OUT, *captured})))


def cells(runs):
    frames = sum(r.stats["frames"] for r in runs)
    return [number(mean([r.angles_deg for r in runs]), 1), number(mean([r.joints_mm for r in runs])),
            number(mean([r.figures["map_10cm"] for r in runs]), 3),
            f"{sum(r.stats['tracked'] for r in runs)} of {frames}"]


def section(lab):
    chosen = POSTURES[::6] if lab.quick else POSTURES
    jobs = [(i, posture, yaw) for i, posture in enumerate(chosen) for yaw in YAWS_DEG.values()]
    runs = dict(zip(jobs, lab.map(lambda job: track(lab, job), jobs)))
    rows = []
    for i, posture in enumerate(chosen):
        by_side = [runs[i, posture, yaw] for yaw in YAWS_DEG.values()]
        rows.append([posture.kind, posture.motion.replace("procedural:", ""), *(number(r.joints_mm) for r in by_side), *cells(by_side)])
    rows.append(["**all**", f"{len(chosen)} postures", *(number(mean([runs[i, p, yaw].joints_mm for i, p in enumerate(chosen)]))
                                                      for yaw in YAWS_DEG.values()), *cells(list(runs.values()))])
    return [f"{len(chosen)} postures, {lab.frames(FRAMES)} frames each, from four sides, Kinect v1 at 30 frames a second, frame by frame, four "
            "bodies that are not measured. None of the motions is in the database; the forest has seen the captured ones that are not of "
            "section 1. Joints [mm]; lost frames count in none of the means.", "",
            *table(["posture", "motion", *(f"from {side} [mm]" for side in YAWS_DEG), "angles [deg]", "joints [mm]", "map", "tracked"], rows)]
