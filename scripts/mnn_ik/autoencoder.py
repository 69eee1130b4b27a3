"""The paper's autoencoder and its training (its appendix A)."""
import dataclasses
import json
import time

import torch

CODE = 35  # the paper's
DOFS = 93
WEIGHT_VARIANCE = 0.01  # of the first weights
RATE_DECAY, RATE_DECAY_STEPS = 0.98, 2000
L2_WEIGHT = 1e-5  # c of (3.2), which the paper does not give: a hundredth of what the trained network loses
MEASURED_STEPS = 250  # between points of the learning curve
MEASURED_POSES = 5000


@dataclasses.dataclass(frozen=True)
class Recipe:
    """Of one training; the paper's but for the batch, which was 10,000 of 3 million poses."""
    width: int = 1024
    batch: int = 1000
    steps: int = 8000
    noise: float = 0.0  # [deviations of a DoF] added to what the encoder sees
    rate: float = 1e-4
    falls: bool = False  # the rate falls to 0 along half a cosine, and the first weights are He's: learns much faster
    kept_steps: tuple = ()  # weights are kept of these, too
    seed: int = 1


def network(width, he=False):
    sizes = [DOFS, width, width, width, CODE, width, width, width, DOFS]
    layers = []
    for i, (inputs, outputs) in enumerate(zip(sizes, sizes[1:])):
        linear = torch.nn.Linear(inputs, outputs)
        torch.nn.init.normal_(linear.weight, std=(2 / inputs if he else WEIGHT_VARIANCE) ** 0.5)
        torch.nn.init.zeros_(linear.bias)
        layers.append(linear)
        if i not in (3, 7):  # code and result are linear
            layers.append(torch.nn.ReLU())
    return torch.nn.Sequential(*layers)


def lost_deg(net, poses):
    """Root mean square of what is lost of a DoF."""
    with torch.no_grad():
        return float((net(poses) - poses).square().mean().sqrt().rad2deg())


class Training:
    """Of one recipe, in a folder that has its state: it goes on where it was stopped."""

    def __init__(self, recipe, learned, tests, folder):
        self.recipe, self.learned, self.tests, self.folder = recipe, learned, tests, folder
        folder.mkdir(parents=True, exist_ok=True)
        torch.manual_seed(recipe.seed)
        self.net = network(recipe.width, recipe.falls)
        self.optimiser = torch.optim.Adam(self.net.parameters(), lr=recipe.rate)
        self.schedule = (torch.optim.lr_scheduler.CosineAnnealingLR(self.optimiser, recipe.steps) if recipe.falls else
                         torch.optim.lr_scheduler.StepLR(self.optimiser, RATE_DECAY_STEPS, RATE_DECAY))
        self.deviation = learned.std(dim=0)
        self.step, self.seconds, self.curve = 0, 0.0, []
        if (folder / "state.pt").exists():
            self.load()

    def load(self):
        state = torch.load(self.folder / "state.pt")
        self.net.load_state_dict(state["net"])
        self.optimiser.load_state_dict(state["optimiser"])
        self.schedule.load_state_dict(state["schedule"])
        self.step, self.seconds, self.curve = state["step"], state["seconds"], state["curve"]

    def save(self):
        torch.save({"net": self.net.state_dict(), "optimiser": self.optimiser.state_dict(),
                    "schedule": self.schedule.state_dict(), "step": self.step, "seconds": self.seconds,
                    "curve": self.curve}, self.folder / "state.part")
        (self.folder / "state.part").rename(self.folder / "state.pt")
        (self.folder / "curve.json").write_text(json.dumps(self.curve))

    def run(self):
        while self.step < self.recipe.steps:
            began = time.monotonic()
            for _ in range(min(MEASURED_STEPS, self.recipe.steps - self.step)):
                self.advance()
                if self.step in self.recipe.kept_steps:
                    torch.save(self.net.state_dict(), self.folder / f"step-{self.step}.pt")
            self.seconds += time.monotonic() - began
            point = {"step": self.step, "seconds": self.seconds}
            for name, poses in {"learned": self.learned, **self.tests}.items():
                point[name] = lost_deg(self.net, poses[torch.linspace(0, len(poses) - 1, MEASURED_POSES).long()])
            self.curve.append(point)
            self.save()
            print(self.folder.name, json.dumps(point), flush=True)

    def advance(self):
        poses = self.learned[torch.randint(len(self.learned), (self.recipe.batch,))]
        seen = poses + self.recipe.noise * self.deviation * torch.randn_like(poses) if self.recipe.noise else poses
        weights = torch.cat([w.flatten() for name, w in self.net.named_parameters() if name.endswith("weight")])
        loss = (self.net(seen) - poses).square().sum(dim=1).mean() + L2_WEIGHT * weights.norm()
        self.optimiser.zero_grad()
        loss.backward()
        self.optimiser.step()
        self.schedule.step()
        self.step += 1


def load(folder, width, step=None):
    """Trained network; of an earlier step if one is named."""
    net = network(width)
    state = torch.load(folder / "state.pt")["net"] if step is None else torch.load(folder / f"step-{step}.pt")
    net.load_state_dict(state)
    return net.double().requires_grad_(False)
