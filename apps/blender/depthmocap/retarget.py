"""Our body's motion on the armature of a character.

In the character's rest pose arms may hang and legs may be apart. Each bone of a limb is turned first as if the character
stood in our T-pose (the rest-pose correction), then as our bone is turned. Limbs of other proportions would miss: arms and
legs are bent so that a wrist lies as far from its shoulder as ours in lengths of the arm, and an ankle stands where ours
stands in lengths of the leg.
"""
from dataclasses import dataclass
from math import acos

from mathutils import Matrix, Vector

from .presets import PRESETS, SWITCHES

LIMBS = [(f"{side}{upper}", f"{side}{lower}", f"{side}{end}")
         for side in ("Left", "Right") for upper, lower, end in (("Arm", "ForeArm", "Hand"), ("UpLeg", "Leg", "Foot"))]
# Bones that are set together, parents before children.
LEVELS = [["Neck", "LeftShoulder", "RightShoulder", "LeftUpLeg", "RightUpLeg"], ["Head", "LeftArm", "RightArm", "LeftLeg", "RightLeg"],
          ["LeftForeArm", "RightForeArm", "LeftFoot", "RightFoot"], ["LeftHand", "RightHand"]]
LONGEST_REACH = 0.9995  # of a limb: a straight one has no plane to bend in
SPINE_ROUNDS = 2  # in which the chain of the spine is turned to where our neck is


class RetargetError(Exception):
    """What to tell the user."""


def named(armature, name):
    if name in armature.pose.bones:
        return armature.pose.bones[name]
    return next((bone for bone in armature.pose.bones if bone.name.endswith(":" + name)), None)


def minimal(start, end):
    """Matrix 3 x 3: the least turn from one direction to another."""
    return start.rotation_difference(end).to_matrix()


@dataclass
class Source:
    """What is read of our armature in one frame, in axes that are z up, facing -y."""
    turns: dict  # bone to Matrix 3 x 3, the identity at rest
    places: dict  # bone to Vector [m]

    @staticmethod
    def of(armature):
        bones = armature.pose.bones
        rest = {bone.name: bone.bone.matrix_local.to_3x3() for bone in bones}
        return Source({bone.name: bone.matrix.to_3x3() @ rest[bone.name].inverted() for bone in bones},
                      {bone.name: bone.head.copy() for bone in bones})

    @staticmethod
    def at_rest(armature):
        bones = armature.data.bones
        return Source({bone.name: Matrix.Identity(3) for bone in bones}, {bone.name: bone.head_local.copy() for bone in bones})


def middle(places, first, second):
    return (places[first] + places[second]) / 2


def length(places, chain):
    return sum((places[b] - places[a]).length for a, b in zip(chain, chain[1:]))


class Retarget:
    """From one of our armatures to a character's. Made once for a pair, then used for every frame."""

    def __init__(self, context, source, target, preset):
        self.context, self.source, self.target = context, source, target
        self.source_name = source.name
        self.bones = {}
        for ours, names in PRESETS[preset].items():
            chain = [named(target, name) for name in names]
            chain = [bone for bone in chain if bone is not None]
            if not chain:
                raise RetargetError(f"{target.name} has no bone {names[0]}: is it a {preset} armature?")
            if ours not in source.pose.bones:
                raise RetargetError(f"{source.name} has no bone {ours}: choose an armature of depthmocap")
            self.bones[ours] = chain
        for bone, key, value in SWITCHES.get(preset, ()):
            if bone in target.pose.bones and key in target.pose.bones[bone]:
                target.pose.bones[bone][key] = value
        self.rest = Source.at_rest(source)
        self.axes = self.axes_of_target()
        self.rest_places = {ours: self.axes.inverted() @ chain[0].bone.head_local for ours, chain in self.bones.items()}
        self.corrections = {}
        for upper, lower, end in LIMBS:
            for bone, child in ((upper, lower), (lower, end)):
                along = self.rest_places[child] - self.rest_places[bone]
                self.corrections[bone] = minimal(along, self.rest.places[child] - self.rest.places[bone])
            if not end.endswith("Foot"):  # feet stand flat at rest, whatever the legs do
                self.corrections[end] = self.corrections[lower]
        self.leg_scale = self.scale_of("LeftUpLeg", "LeftLeg", "LeftFoot")
        self.arm_scale = self.scale_of("LeftArm", "LeftForeArm", "LeftHand")

    def axes_of_target(self):
        """Matrix 3 x 3: axes that are z up, facing -y, to the target's armature, by the world's up and the hips."""
        up = (self.target.matrix_world.to_3x3().inverted() @ Vector((0, 0, 1))).normalized()
        left = self.bones["LeftUpLeg"][0].bone.head_local - self.bones["RightUpLeg"][0].bone.head_local
        left = (left - left.project(up)).normalized()
        return Matrix((left, up.cross(left), up)).transposed()

    def scale_of(self, *chain):
        return length(self.rest_places, chain) / length(self.rest.places, chain)

    def place(self, bone):
        """Vector: the head of the target's bone as it is posed now, z up, facing -y, in the target's unit."""
        return self.axes.inverted() @ self.bones[bone][0].head

    def on_ground(self, p):
        """Where a place of our body is for the target: scaled about its ankles' height at rest."""
        ours, theirs = (middle(places, "LeftFoot", "RightFoot").z for places in (self.rest.places, self.rest_places))
        return self.leg_scale * (p - Vector((0, 0, ours))) + Vector((0, 0, theirs))

    def update(self):
        self.context.view_layer.update()

    def turn_of(self, ours, source):
        return source.turns[ours] @ self.corrections.get(ours, Matrix.Identity(3))

    def set_turn(self, bone, turn):
        """`turn`: Matrix 3 x 3 from the target's rest, z up, facing -y."""
        wanted = self.axes @ turn @ self.axes.inverted() @ bone.bone.matrix_local.to_3x3()
        matrix = wanted.to_4x4()
        matrix.translation = bone.head
        local = self.target.convert_space(pose_bone=bone, matrix=matrix, from_space="POSE", to_space="LOCAL").to_quaternion()
        if bone.rotation_mode == "QUATERNION":
            if local.dot(bone.rotation_quaternion) < 0:
                local.negate()
            bone.rotation_quaternion = local
        elif bone.rotation_mode == "AXIS_ANGLE":
            axis, angle = local.to_axis_angle()
            bone.rotation_axis_angle = (angle, *axis)
        else:
            bone.rotation_euler = local.to_euler(bone.rotation_mode, bone.rotation_euler)

    def apply(self):
        """Poses the target as the source is posed now."""
        source = Source.of(self.source)
        self.set_hips(source)
        self.set_spine(source)
        turns = {ours: self.turn_of(ours, source) for ours in self.bones}
        for level in LEVELS:
            for upper, lower, end in LIMBS:
                if upper in level:
                    self.bend(source, turns, upper, lower, end)
            for ours in level:
                self.set_turn(self.bones[ours][0], turns[ours])
            self.update()

    def set_hips(self, source):
        hips = self.bones["Hips"][0]
        self.set_turn(hips, self.turn_of("Hips", source))
        self.update()
        wanted = self.on_ground(middle(source.places, "LeftUpLeg", "RightUpLeg"))
        missing = wanted - (self.place("LeftUpLeg") + self.place("RightUpLeg")) / 2
        matrix = hips.matrix.copy()
        matrix.translation += self.axes @ missing
        hips.location = self.target.convert_space(pose_bone=hips, matrix=matrix, from_space="POSE", to_space="LOCAL").translation
        self.update()

    def set_spine(self, source):
        chain = self.bones["Spine"]
        first, last = source.turns["Hips"].to_quaternion(), source.turns["Spine"].to_quaternion()
        turns = [first.slerp(last, (k + 1) / len(chain)).to_matrix() for k in range(len(chain))]
        for _ in range(SPINE_ROUNDS if len(chain) > 1 else 1):
            for bone, turn in zip(chain, turns):
                self.set_turn(bone, turn)
                self.update()
            hips = (self.place("LeftUpLeg") + self.place("RightUpLeg")) / 2
            swing = minimal(self.place("Neck") - hips, source.places["Neck"] - middle(source.places, "LeftUpLeg", "RightUpLeg"))
            turns[:-1] = [swing @ turn for turn in turns[:-1]]

    def bend(self, source, turns, upper, lower, end):
        """Changes the turns of a limb so that its end lies where it should."""
        start = self.place(upper)
        if end.endswith("Foot"):
            goal = self.on_ground(source.places[end])
        else:
            goal = start + self.arm_scale * (source.places[end] - source.places[upper])
        first = turns[upper] @ (self.rest_places[lower] - self.rest_places[upper])
        second = turns[lower] @ (self.rest_places[end] - self.rest_places[lower])
        reach = (goal - start).length
        longest, shortest = first.length + second.length, abs(first.length - second.length)
        reach = min(max(reach, shortest + 1e-4 * longest), LONGEST_REACH * longest)
        plane = first.cross(second)
        if plane.length < 1e-3 * first.length * second.length:  # straight: bends as our joint does
            plane = source.turns[upper] @ (Vector((-1, 0, 0)) if end.endswith("Foot") else Vector((0, 0, 1 if upper == "RightArm" else -1)))
        # Law of cosines: the angle by which the lower bone leaves the upper one's direction.
        bent = acos(max(-1.0, min(1.0, (reach ** 2 - first.length ** 2 - second.length ** 2) / (2 * first.length * second.length))))
        turn = Matrix.Rotation(bent - first.angle(second), 3, plane)
        turns[lower] = turn @ turns[lower]
        whole = minimal(first + turn @ second, goal - start)
        turns[upper], turns[lower] = whole @ turns[upper], whole @ turns[lower]

    def key(self, frame):
        for chain in self.bones.values():
            for bone in chain:
                path = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(bone.rotation_mode, "rotation_euler")
                bone.keyframe_insert(path, frame=frame)
        self.bones["Hips"][0].keyframe_insert("location", frame=frame)
