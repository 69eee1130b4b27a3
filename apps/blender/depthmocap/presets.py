"""Which bones of known characters stand for ours. A bone of ours may be a chain of theirs, which shares its turn.

A name stands for the bone of that name or, where there is none, for the one that ends in it after a colon: Mixamo's prefix
counts the characters of a file.
"""
SIDES = {"Left": "L", "Right": "R"}


def both_sides(centre, limbs):
    """`limbs`: our bone without its side to a name with {side}, {letter} for it."""
    bones = dict(centre)
    for side, letter in SIDES.items():
        for ours, theirs in limbs.items():
            bones[side + ours] = (theirs.format(side=side, letter=letter),)
    return bones


MIXAMO = both_sides(
    {"Hips": ("Hips",), "Spine": ("Spine", "Spine1", "Spine2"), "Neck": ("Neck",), "Head": ("Head",)},
    {"Shoulder": "{side}Shoulder", "Arm": "{side}Arm", "ForeArm": "{side}ForeArm", "Hand": "{side}Hand",
     "UpLeg": "{side}UpLeg", "Leg": "{side}Leg", "Foot": "{side}Foot"})

# The names that VRoid Studio gives.
VRM = both_sides(
    {"Hips": ("J_Bip_C_Hips",), "Spine": ("J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest"), "Neck": ("J_Bip_C_Neck",),
     "Head": ("J_Bip_C_Head",)},
    {"Shoulder": "J_Bip_{letter}_Shoulder", "Arm": "J_Bip_{letter}_UpperArm", "ForeArm": "J_Bip_{letter}_LowerArm",
     "Hand": "J_Bip_{letter}_Hand", "UpLeg": "J_Bip_{letter}_UpperLeg", "Leg": "J_Bip_{letter}_LowerLeg",
     "Foot": "J_Bip_{letter}_Foot"})

# The FK controls of the rig that Rigify generates from its human.
RIGIFY = both_sides(
    {"Hips": ("torso",), "Spine": ("chest",), "Neck": ("neck",), "Head": ("head",)},
    {"Shoulder": "shoulder.{letter}", "Arm": "upper_arm_fk.{letter}", "ForeArm": "forearm_fk.{letter}", "Hand": "hand_fk.{letter}",
     "UpLeg": "thigh_fk.{letter}", "Leg": "shin_fk.{letter}", "Foot": "foot_fk.{letter}"})

PRESETS = {"Mixamo": MIXAMO, "Rigify": RIGIFY, "VRM": VRM}

# Switches of a rig that let its FK controls work: (bone, property, value).
SWITCHES = {"Rigify": [(f"{limb}_parent.{letter}", "IK_FK", 1.0) for limb in ("upper_arm", "thigh") for letter in "LR"]}
