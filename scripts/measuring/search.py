"""5. The search for nearest poses."""
import json

from measuring import plots
from measuring.lab import key_of
from measuring.motions import HELD_OUT, take_of
from measuring.tables import mean, number, table

THRESHOLDS_M = (0.5, 0.3, 0.2, 0.1, 0.05, 0.02)
FRAMES = 60
MOTIONS = ("16_15", "127_07", "135_02", "14_02", "05_02", "127_02")
MODELS = ((15, 3), (15, 7), (30, 3), (30, 7), (50, 3), (50, 5), (50, 7))


def recall(lab, take):
    path = lab.work / "search" / lab.fingerprint / f"{key_of(take, lab.quick)}.json"
    return json.loads(lab.kept(path, lambda part: part.write_text(
        lab.call(lab.build / "tests" / "search_experiment", take.render(lab, FRAMES), "--posedb", lab.database(HELD_OUT), "--threads",
                 1).stdout)).read_text())


def section(lab):
    chosen = [take_of(m) for m in (MOTIONS[:2] if lab.quick else MOTIONS)]
    found = [recall(lab, take) for take in chosen]
    rows = []
    for i, entry in enumerate(found[0]["search"]):
        part = [f["search"][i] for f in found]
        rows.append([entry["candidates"], *(number(mean([p[k] for p in part]), d) for k, d in (("recall", 3), ("nearest", 3), ("ms", 2)))])
    rows.append(["exhaustive", "1", "1", number(mean([f["exhaustive_ms"] for f in found]), 2)])
    lines = [f"The {found[0]['poses']} poses of CMU without the held-out motions; queries of {sum(f['queries'] for f in found)} tracked "
             "frames; recall of the 50 nearest poses of equation (3) and of the nearest one; time of one search on one thread.", "",
             *table(["candidates", "recall of 50", "recall of the nearest", "time [ms]"], rows), ""]
    counts = {}
    for f in found:
        for model, n in f["chosen"].items():
            counts[model] = counts.get(model, 0) + n
    total = sum(counts.values())
    lines += ["The local model: a Gaussian over 50 neighbours, or the paper's subspace, its size chosen for each frame by cross-validation ("
              + ", ".join(f"{model}: {100 * n / total:.0f} %" for model, n in sorted(counts.items(), key=lambda x: -x[1]))
              + ") or the same for all frames; and the search by its candidates.", ""]

    def average(*options, database=None):
        runs = lab.map(lambda t: lab.track(t.render(lab, FRAMES), "--posedb", database or lab.database(HELD_OUT), *t.body.true_body, *options),
                       chosen)
        return [number(mean([r.angles_deg for r in runs]), 2), number(mean([r.joints_mm for r in runs]))]
    rows = [["Gaussian, K 50, 512 candidates (default)", *average()]]
    rows += [[f"Gaussian, K {k}", *average("--neighbours", k)] for k in (15, 30)]
    rows.append(["subspace, K and B chosen for each frame", *average("--without", "gaussian")])
    rows += [[f"subspace, K {k}, B {b}", *average("--without", "gaussian", "--neighbours", k, "--dims", b)] for k, b in (MODELS[:2] if lab.quick else MODELS)]
    rows += [[f"{c} candidates", *average("--candidates", c)] for c in (64, 4096)]
    lines += table(["search and local model", "angles [deg]", "joints [mm]"], rows)
    sizes, points = [], []
    for threshold in THRESHOLDS_M[::2] if lab.quick else THRESHOLDS_M:
        database = lab.database(HELD_OUT, "--threshold", threshold)
        poses = database_size(lab, database)
        angle, joints = average(database=database)
        sizes.append([f"CMU, poses {threshold} m apart", poses, angle, joints])
        points.append((poses, float(angle)))
    default = lab.build / "share" / "depthmocap" / "default.posedb"
    sizes.append(["the one that comes with the program", database_size(lab, default), *average(database=default)])
    lines += ["", "The database: CMU thinned so that no two poses' joints all lie nearer than so much, and the default one.", "",
              *table(["database", "poses", "angles [deg]", "joints [mm]"], sizes), "",
              plots.curves("accuracy-database.png", {"size of the database": {"angles": points}}, "poses", "joint angles [deg]",
                           columns=1, log_x=True)]
    return lines


def database_size(lab, database):
    said = lab.call(lab.program, "posedb", "info", database).stdout
    return int(next(line.split()[1] for line in said.splitlines() if line.startswith("poses")))
