"""8. Left and right."""
import collections

import matplotlib.image
import numpy

from measuring.motions import HELD_OUT, takes
from measuring.tables import mean, number, table

FRAMES = 60
PARTS = 16
WAYS = {"each picture by itself": ("--without", "sides"), "with the frames before": ()}


def mirrored(part):
    """The same part of the other side; see ../../libtracker/core/parts.h for the numbers."""
    if part < 3 or part == 9:
        return part
    left = part % 2 == (1 if part < 9 else 0)
    return part + 1 if left else part - 1


def label_image(path):
    return (255 * matplotlib.image.imread(path)).round().astype(int)


def confusion(recording, labels):
    """Pixels by true part (row) and found part (column)."""
    counts = numpy.zeros((PARTS, PARTS), int)
    for found in sorted(labels.glob("*.png")):
        truth = label_image(recording / "truth" / "labels" / found.name)
        of = label_image(found)
        both = (truth > 0) & (of > 0)
        counts += numpy.bincount(PARTS * truth[both] + of[both], minlength=PARTS * PARTS).reshape(PARTS, PARTS)
    return counts


def right_share(counts):
    """Mean over the parts that are seen."""
    return mean([counts[p, p] / counts[p].sum() for p in range(1, PARTS) if counts[p].sum() > 0])


def swapped_share(counts):
    """Of the pixels of parts that have a side."""
    sided = [p for p in range(1, PARTS) if mirrored(p) != p]
    return sum(counts[p, mirrored(p)] for p in sided) / sum(counts[p].sum() for p in sided)


def section(lab):
    jobs = [(take, way) for take in takes(lab) for way in WAYS]

    def labelled(job):
        take, way = job
        recording = take.render(lab, FRAMES)
        return confusion(recording, lab.labels(recording, "--posedb", lab.database(HELD_OUT), *WAYS[way]))
    counts = dict(zip(jobs, lab.map(labelled, jobs)))
    of_kind = collections.defaultdict(list)
    for take in takes(lab):
        of_kind[take.kind].append(take)
    of_kind["**all**"] = takes(lab)
    rows = []
    for kind, some in of_kind.items():
        sums = [sum(counts[take, way] for take in some) for way in WAYS]
        rows.append([kind, *(number(100 * swapped_share(c), 1) for c in sums), *(number(100 * right_share(c), 1) for c in sums)])
    return ["Labels of the motions of section 1, bodies not measured, against the rendered ones. Swapped: of the pixels of a part that has a side, the "
            "share that is called the same part of the other side; right: mean over the parts.", "",
            *table(["motions", *(f"swapped, {way} [%]" for way in WAYS), *(f"right, {way} [%]" for way in WAYS)], rows)]
