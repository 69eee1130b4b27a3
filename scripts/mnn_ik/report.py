"""The tables of the experiment. What is measured is kept in a file, so that a broken run goes on."""
import dataclasses
import json

import torch

from measuring import tables
from mnn_ik import autoencoder, priors, recipes
from mnn_ik.experiment import COUNTS, Case, Experiment

PPCA_DIMS = (10, 20)  # tried; the best on the validation poses counts
OURS = Case("unseen", "typical", "a row per degree of freedom")
CHANGES = {
    "as in the paper": Case(),
    "motions not learned from": Case(split="unseen"),
    "start: typical pose": Case(start="typical"),
    "a row per degree of freedom": Case(form="a row per degree of freedom"),
    "all three, as ours": OURS,
}


class Report:
    def __init__(self, data, work):
        self.work, self.learned = work, torch.tensor(data.learned)
        self.experiment = Experiment(data)
        self.mixture = self.kept_mixture(work / "mixture.pt")
        self.experiment.typical = self.mixture.typical
        self.file = work / "figures.json"
        self.figures = json.loads(self.file.read_text()) if self.file.exists() else {}

    def kept_mixture(self, path):
        if not path.exists():
            torch.save(priors.Mixture(self.learned), path)
        return torch.load(path, weights_only=False)

    def of(self, name, make, case):
        key = f"{name}, {', '.join(dataclasses.astuple(case))}"
        if key not in self.figures:
            self.figures[key] = self.experiment.figures(make(), case)
            self.file.write_text(json.dumps(self.figures, indent=1))
            print(key, json.dumps(self.figures[key]), flush=True)
        return self.figures[key]

    def gmm(self, case=Case()):
        return self.of("gmm", lambda: self.mixture, case)

    def ppca(self):
        tried = {dims: self.of(f"ppca {dims}", lambda d=dims: priors.Ppca(self.learned, d), Case()) for dims in PPCA_DIMS}
        return min(tried.items(), key=lambda item: item[1]["validated_mm"])

    def network(self, name, case=Case(), step=None):
        recipe = recipes.RECIPES[name]
        step = step or self.steps(name)
        at = None if step == self.steps(name) else step
        return self.of(f"{name} {step}", lambda: priors.Autoencoder(name, autoencoder.load(self.work / name, recipe.width, at)), case)

    def curve(self, name):
        path = self.work / name / "curve.json"
        return json.loads(path.read_text()) if path.exists() else []

    def steps(self, name):
        return self.curve(name)[-1]["step"]

    def trained(self):
        return [name for name in recipes.RECIPES if self.curve(name)]


def gains(figures, gmm):
    """Less error than the mixture, position and rotation [%], averaged over the four counts as in the paper."""
    return [100 * tables.mean([1 - f[i] / g[i] for f, g in zip(figures["counts"], gmm["counts"])]) for i in (0, 2)]


def less(figures, gmm):
    return [f"{gain:.0f} %" for gain in gains(figures, gmm)]


def positions(figures):
    return " / ".join(f"{row[0]:.0f}" if row[0] >= 10 else f"{row[0]:.1f}" for row in figures["counts"])


def rotations(figures):
    return " / ".join(f"{row[2]:.1f}" for row in figures["counts"])


def named(recipe):
    return f"{recipe.width} wide, batch {recipe.batch}" + (", fast" if recipe.falls else "") + (", denoising" if recipe.noise else "")


def main_table(report):
    rows = []

    def add(name, figures):
        cells = [f"{mm:.1f} ± {mm_dev:.1f} mm, {deg:.1f} ± {deg_dev:.1f}°" for mm, mm_dev, deg, deg_dev in figures["counts"]]
        rows.append([name, *cells, *less(figures, report.gmm())])
    add("numeric", report.of("numeric", lambda: priors.Nothing("numeric"), Case()))
    dims, figures = report.ppca()
    add(f"PPCA, {dims} directions", figures)
    add("GMM, 70 Gaussians", report.gmm())
    for name in report.trained():
        add(f"autoencoder, {named(recipes.RECIPES[name])}, {report.steps(name)} steps", report.network(name))
    return tables.table(["prior", *(f"{count} joints" for count in COUNTS), "position: less than GMM", "angle: less"], rows)


def change_table(report):
    rows = []
    for change, case in CHANGES.items():
        gmm = report.gmm(case)
        cells = [change, positions(gmm), rotations(gmm)]
        for name in ("narrow", "narrow-denoising"):
            figures = report.network(name, case)
            cells += [positions(figures), " / ".join(less(figures, gmm))]
        rows.append(cells)
    return tables.table(["", "GMM [mm]", "[°]", "autoencoder [mm]", "less than GMM: position / angle",
                         "denoising [mm]", "less than GMM: position / angle"], rows)


def training_table(report):
    rows = []
    for name in report.trained():
        recipe, points = recipes.RECIPES[name], {point["step"]: point for point in report.curve(name)}
        for step in sorted({*recipe.kept_steps, report.steps(name)}):
            if step in points and step <= report.steps(name) and not recipe.noise:
                p = points[step]
                rows.append([named(recipe), step, *(f"{p[k]:.2f}" for k in ("learned", "frames", "unseen")),
                             " / ".join(less(report.network(name, step=step), report.gmm()))])
    return tables.table(["network", "steps", "learned [°]", "other frames [°]", "other motions [°]",
                         "less than GMM: position / angle"], rows)


def lines(report):
    return [*main_table(report), "",
            "What changes what comes of it; errors with 6 / 8 / 10 / 15 joints, the autoencoder 128 wide:", "", *change_table(report), "",
            "Training: what the network loses of a degree of freedom (root mean square), and its lead:", "", *training_table(report)]
