"""9. Time of each stage."""
from measuring.tables import number, table

STAGES = ["segment", "classify", "markers", "prior", "solve", "total"]


def section(lab):
    recording = lab.render("procedural:walk", "--camera", "kinect1", "--distance", 2.5, "--last", lab.frames(200) - 1)
    stats = lab.stats(recording, "--threads", 2)
    rows = [[stage, *(number(stats["stage_ms"][stage][key], 2) for key in ("mean", "p50", "p95", "p99"))]
            for stage in STAGES]
    return ["640x480, one person at 2.5 m, two threads. Times depend on the machine and on what else runs there; the "
            "benchmarks (`build/tests/tracker_benchmark`) compare within one run.", "",
            *table(["stage [ms]", "mean", "p50", "p95", "p99"], rows), "",
            f"{1000 / stats['stage_ms']['total']['mean']:.0f} frames a second on average, peak memory "
            f"{stats['peak_rss_mb']:.0f} MB."]
