"""A body as our files and streams have it, and how it lies in Blender.

Ours: metres, y up, right-handed; a body at rest stands in a T-pose and faces +z, its left along +x. Every bone is parallel
to the world at rest, so that a rotation of a bone in its parent is the identity there. Blender: z up, facing -y.
"""
from dataclasses import dataclass, field

from mathutils import Matrix, Quaternion, Vector

SHORTEST_BONE_M = 0.01  # Blender drops bones without length
TIP_SHARE = 0.4  # of a bone that ends nowhere, in the length of the bone before: about that of a hand or of toes
STEEP = 0.7  # a bone this near to "forward" (45 degrees) takes "up" for its z axis


@dataclass
class Rig:
    """Bones by name, parents before children."""
    parents: dict  # bone to parent, None for the root
    offsets: dict  # bone to Vector [m], ours: its head in its parent at rest
    tips: dict = field(default_factory=dict)  # bone to Vector [m], ours: the end of a bone without child


@dataclass
class Pose:
    """One pose of a rig. Bones that are missing are as at rest."""
    rotations: dict  # bone to Quaternion in its parent, ours
    offsets: dict  # bone to Vector [m], ours; of the root: its place in the world


def to_blender(p):
    return Vector((p[0], -p[2], p[1]))


def to_ours(p):
    return Vector((p[0], p[2], -p[1]))


def rotation_to_blender(q):
    return Quaternion((q.w, q.x, -q.z, q.y))


def heads(rig):
    """Bone to Vector [m], Blender's: its head at rest."""
    places = {}
    for bone, parent in rig.parents.items():
        places[bone] = to_blender(rig.offsets[bone]) + (places[parent] if parent else Vector())
    return places


def tail(rig, bone, places):
    """Vector [m], Blender's: where a bone ends at rest. Of several children the one in the middle of the body counts."""
    if bone in rig.tips:
        end = places[bone] + to_blender(rig.tips[bone])
    else:
        children = [child for child, parent in rig.parents.items() if parent == bone]
        if children:
            end = places[min(children, key=lambda child: abs(rig.offsets[child].x))]
        else:
            end = places[bone] + TIP_SHARE * to_blender(rig.offsets[bone])
    if (end - places[bone]).length < SHORTEST_BONE_M:
        end = places[bone] + Vector((0, 0, SHORTEST_BONE_M))
    return end


def z_axis(along):
    """Vector, Blender's: where the z axis of a bone along this direction points at rest."""
    forward = Vector((0, -1, 0))
    wanted = Vector((0, 0, 1)) if along.normalized().dot(forward) > STEEP else forward
    return wanted - wanted.project(along)


def bone_pose(rest, rig, pose, bone):
    """Quaternion and Vector for a PoseBone whose rest matrix in the armature is `rest` (4 x 4)."""
    axes = rest.to_quaternion()
    turn = rotation_to_blender(pose.rotations[bone]) if bone in pose.rotations else Quaternion()
    moved = to_blender(pose.offsets[bone] - rig.offsets[bone]) if bone in pose.offsets else Vector()
    return axes.inverted() @ turn @ axes, axes.inverted() @ moved


def world(rig, pose):
    """Bone to Matrix 4 x 4, Blender's, of the frame that is parallel to the world at rest."""
    frames = {}
    for bone, parent in rig.parents.items():
        turn = rotation_to_blender(pose.rotations.get(bone, Quaternion())).to_matrix().to_4x4()
        local = Matrix.Translation(to_blender(pose.offsets.get(bone, rig.offsets[bone]))) @ turn
        frames[bone] = frames[parent] @ local if parent else local
    return frames
