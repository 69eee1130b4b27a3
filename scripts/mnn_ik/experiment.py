"""Poses from the places of some of their joints: one prior, one start, one form of the residual, one set of poses."""
import dataclasses

import torch

from mnn_ik import kinematics, solver

COUNTS = (6, 8, 10, 15)  # of joints given, as in the paper
TESTED, VALIDATED = 500, 40  # poses
WEIGHTS_M = [10 ** (k / 2) for k in range(-8, 1)]  # tried, in units of what the prior leaves of a natural pose
TASK_SEED = 7
AT_ONCE = 250  # poses that are solved together: as many as fit a processor's cache


@dataclasses.dataclass(frozen=True)
class Case:
    """Of a prior."""
    split: str = "frames"  # or "unseen"
    start: str = "zero"  # or "typical": the mixture's mean that fits best
    form: str = "one row"  # or "a row per degree of freedom"


class Experiment:
    def __init__(self, data):
        self.skeleton = kinematics.Skeleton(data.parents, data.ends_m)
        frames, unseen = (torch.tensor(values[self.drawn(len(values))]) for values in (data.frames, data.unseen))
        self.sets = {"frames": frames[:TESTED], "unseen": unseen[:TESTED], "validation": frames[TESTED:]}
        self.typical = None  # (n, 93), set with the mixture

    @staticmethod
    def drawn(count):
        """Of poses to test and to choose weights on."""
        order = torch.randperm(count, generator=torch.Generator().manual_seed(TASK_SEED))
        return order[:TESTED + VALIDATED].numpy()

    def given(self, poses, count):
        """Which places are given (n, count)."""
        generator = torch.Generator().manual_seed(TASK_SEED + count)
        return torch.rand(poses, len(self.skeleton.places), generator=generator).argsort(dim=1)[:, :count]

    def problem(self, prior, form, weights_m, truth, given):
        def rows(x, which):
            places, points, axes = self.skeleton.forward(x)
            E = (places - truth[which]).gather(1, given[which, :, None].expand(-1, -1, 3)).flatten(1)
            J = self.skeleton.jacobian(places, points, axes, given[which]).flatten(1, 2)
            r, J_r = prior.one_row(x) if form == "one row" else prior.rows(x)
            w = weights_m[which, None]
            return torch.cat([E, w * r], dim=1), torch.cat([J, w[..., None] * J_r], dim=1)
        return rows

    def starts(self, case, truth, given):
        if case.start == "zero":
            return torch.zeros(len(truth), self.typical.shape[1], dtype=torch.float64)
        missed = (self.skeleton.forward(self.typical)[0][None] - truth[:, None]).square().sum(-1)
        return self.typical[missed.gather(2, given[:, None].expand(-1, len(self.typical), -1)).sum(-1).argmin(dim=1)]

    def unit(self, prior, form):
        """[1/m] what one metre of weight is for the prior, so that weights of all priors compare."""
        r, _ = prior.one_row(self.sets["validation"])
        return 1 / float(r.mean() if form == "one row" else r.mean().sqrt()) if float(r.mean()) > 0 else 0.0

    def solved(self, prior, case, weights_m, poses):
        """Errors [mm] and [deg] (weights, counts, poses)."""
        units = self.unit(prior, case.form)
        mm, deg = torch.zeros(2, len(weights_m), len(COUNTS), len(poses), dtype=torch.float64)
        tasks = [(w, i, chunk) for w in range(len(weights_m)) for i in range(len(COUNTS)) for chunk in torch.arange(len(poses)).split(AT_ONCE)]
        for w, i, chunk in tasks:
            true = poses[chunk]
            truth, given = self.skeleton.forward(true)[0], self.given(len(poses), COUNTS[i])[chunk]
            weights = torch.full((len(true),), weights_m[w] * units, dtype=torch.float64)
            x = solver.solve(self.problem(prior, case.form, weights, truth, given), self.starts(case, truth, given))
            mm[w, i, chunk] = 1000 * (self.skeleton.forward(x)[0] - truth).norm(dim=-1).mean(dim=1)
            deg[w, i, chunk] = kinematics.rotation_errors_deg(x, true)
        return mm, deg

    def weight(self, prior, case):
        """The weight [m] with the least geometric mean of the position errors of the four counts on the validation poses."""
        mm, _ = self.solved(prior, case, WEIGHTS_M, self.sets["validation"])
        logs = mm.mean(dim=2).log().mean(dim=1)
        return WEIGHTS_M[int(logs.argmin())], float(logs.min().exp())

    def figures(self, prior, case):
        """Weight [m], its error on the validation poses [mm], and for each count: position error, its deviation [mm],
        rotation error, its deviation [deg]."""
        weight_m, validated_mm = self.weight(prior, case)
        mm, deg = self.solved(prior, case, [weight_m], self.sets[case.split])
        rows = [[float(v) for v in (mm[0, i].mean(), mm[0, i].std(), deg[0, i].mean(), deg[0, i].std())] for i in range(len(COUNTS))]
        return {"weight_m": weight_m, "validated_mm": validated_mm, "counts": rows}
