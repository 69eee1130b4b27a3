"""What the experiments are made with. The forest that comes with the program has seen none of the motions
(forest/models/general.report.md) but 14_24."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Body:
    sex: str
    stature_m: float
    weight_kg: float

    @property
    def options(self):
        return ("--sex", self.sex, "--height", self.stature_m, "--weight", self.weight_kg)

    @property
    def true_body(self):
        return ("--true-body", f"{self.sex},{self.stature_m},{self.weight_kg}")

    def __str__(self):
        return f"{'woman' if self.sex == 'f' else 'man'}, {100 * self.stature_m:.0f} cm, {self.weight_kg} kg"


@dataclasses.dataclass(frozen=True)
class Take:
    """A part of a motion, performed by a body."""
    kind: str
    motion: str
    body: Body
    yaw_deg: float = 0
    first: int = 0
    last: int = 299

    def render(self, lab, frames, noise=True):
        """The recording of the first frames."""
        options = [*self.body.options, "--yaw", self.yaw_deg, "--first", self.first]
        if noise:
            return lab.variant(lab.render(self.motion, *options, "--last", self.last), lab.frames(frames))
        return lab.render(self.motion, *options, "--last", min(self.last, self.first + lab.frames(frames) - 1), "--noise", "off")


CROSS_VALIDATION = [
    Take("walk", "16_22", Body("m", 1.82, 84)),
    Take("walk", "05_01", Body("f", 1.66, 58), 20),
    Take("walk", "16_15", Body("m", 1.71, 66), -15),
    Take("walk", "02_01", Body("f", 1.59, 55), 30),
    Take("run", "02_03", Body("m", 1.75, 70)),
    Take("run", "127_07", Body("f", 1.70, 66), -20),
    Take("run", "16_35", Body("m", 1.88, 90), 15),
    Take("run", "09_01", Body("f", 1.63, 61), -30),
    Take("kick", "135_07", Body("f", 1.60, 52), 15),
    Take("kick", "135_02", Body("m", 1.78, 92)),
    Take("kick", "11_01", Body("m", 1.69, 62), -10),
    Take("box", "14_02", Body("m", 1.85, 79), 10, 200, 499),
    Take("dance", "05_02", Body("f", 1.68, 56)),
    Take("jump", "49_02", Body("m", 1.73, 75), 20),
    Take("wave", "14_24", Body("f", 1.57, 64), -15, 100, 399),
    Take("exercise", "127_02", Body("m", 1.80, 70)),
]
HELD_OUT = [take.motion for take in CROSS_VALIDATION]
TUNED_ON = ("16_15", "02_01", "16_35", "09_01", "11_01")  # the tracker's weights were chosen by these


def takes(lab):
    """All, or a walk, a run and a kick."""
    return [take_of(motion) for motion in ("16_22", "127_07", "135_02")] if lab.quick else CROSS_VALIDATION


def take_of(motion):
    return next(take for take in CROSS_VALIDATION if take.motion == motion)
