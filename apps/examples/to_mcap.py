#!/usr/bin/env python3
"""Writes tracked people as an .mcap with Foxglove's schemas. Needs: pip install depthmocap foxglove-sdk

    python3 to_mcap.py recordings/walk walk.mcap            # open it in Foxglove or Lichtblick
    python3 to_mcap.py openni2 take.mcap                    # a camera, until Ctrl-C

    /tf               FrameTransforms: the camera and the bones in the world
    /skeleton         SceneUpdate: joints and lines between them, in the camera's frame
    /depth/image      RawImage: 16UC1, millimetres
    /depth/calibration  CameraCalibration
"""
import depthmocap
import foxglove
import numpy as np
from foxglove.messages import (
    CameraCalibration, Color, FrameTransform, FrameTransforms, LinePrimitive, LinePrimitiveLineType, Point3, Pose,
    Quaternion, RawImage, SceneEntity, SceneEntityDeletion, SceneUpdate, SpherePrimitive, Timestamp, Vector3)

import skeleton

# The parent of each bone and the joint that it turns about; "" where that is none of depthmocap.JOINTS.
BONES = {"root": ("", "pelvis"), "upperback": ("root", "spine"), "neck": ("upperback", "neck"), "head": ("neck", "head"),
         "lclavicle": ("upperback", ""), "lhumerus": ("lclavicle", "left_shoulder"), "lradius": ("lhumerus", "left_elbow"),
         "rclavicle": ("upperback", ""), "rhumerus": ("rclavicle", "right_shoulder"), "rradius": ("rhumerus", "right_elbow"),
         "lfemur": ("root", "left_hip"), "ltibia": ("lfemur", "left_knee"), "lfoot": ("ltibia", "left_ankle"),
         "rfemur": ("root", "right_hip"), "rtibia": ("rfemur", "right_knee"), "rfoot": ("rtibia", "right_ankle")}
JOINT_SIZE_M = 0.04
YELLOW = Color(r=0.95, g=0.7, b=0.25, a=1)


def product(a, b):
    """Of quaternions w x y z."""
    return np.concatenate(([a[0] * b[0] - a[1:] @ b[1:]], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])))


def quaternion_of(m):
    """w x y z of a rotation matrix: the eigenvector of Bar-Itzhack's matrix with the largest eigenvalue."""
    (a, b, c), (d, e, f), (g, h, i) = m
    k = np.array([[a + e + i, h - f, c - g, d - b], [h - f, a - e - i, b + d, c + g],
                  [c - g, b + d, e - a - i, f + h], [d - b, c + g, f + h, i - a - e]])
    return np.linalg.eigh(k)[1][:, -1]


def vector(kind, values):
    """A Vector3 or Point3."""
    x, y, z = map(float, values)
    return kind(x=x, y=y, z=z)


def transform(stamp, parent, child, place, turn):
    w, x, y, z = map(float, turn)
    return FrameTransform(timestamp=stamp, parent_frame_id=parent, child_frame_id=child,
                          translation=vector(Vector3, place), rotation=Quaternion(x=x, y=y, z=z, w=w))


def bones(frame, stamp):
    """Each bone in the world: turned as it is, at the joint that it turns about."""
    turns = {"": np.array([1.0, 0, 0, 0])}
    for bone, (parent, joint) in BONES.items():
        turns[bone] = product(turns[parent], frame.rotations[depthmocap.BONES.index(bone)])
        if joint:
            place = frame.world_from_camera @ frame.joints[depthmocap.JOINTS.index(joint)]
            yield transform(stamp, "world", f"person_{frame.person}/{bone}", place, turns[bone])


def scene(frame, stamp):
    name = f"person_{frame.person}"
    if frame.state == "lost":
        return SceneUpdate(deletions=[SceneEntityDeletion(timestamp=stamp, id=name)])
    points = [vector(Point3, joint) for joint in frame.joints]
    spheres = [SpherePrimitive(pose=Pose(position=vector(Vector3, joint), orientation=Quaternion(x=0, y=0, z=0, w=1)),
                               size=vector(Vector3, [JOINT_SIZE_M] * 3), color=YELLOW) for joint in frame.joints]
    lines = LinePrimitive(type=LinePrimitiveLineType.LineList, thickness=JOINT_SIZE_M / 2, color=YELLOW,
                          points=[points[joint] for link in skeleton.LINKS for joint in link])
    return SceneUpdate(entities=[SceneEntity(timestamp=stamp, frame_id="camera", id=name, spheres=spheres, lines=[lines])])


def depth_image(frame, stamp):
    steps = np.rint(frame.depth * 1000).clip(0, 65535).astype("<u2")
    height, width = steps.shape
    return RawImage(timestamp=stamp, frame_id="camera", width=width, height=height, encoding="16UC1", step=2 * width,
                    data=steps.tobytes())


def calibration(camera, stamp):
    fx, fy, cx, cy = camera.fx, camera.fy, camera.cx, camera.cy
    return CameraCalibration(timestamp=stamp, frame_id="camera", width=camera.width, height=camera.height,
                             K=[fx, 0, cx, 0, fy, cy, 0, 0, 1], R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
                             P=[fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0])


def main():
    parser = skeleton.options(__doc__)
    parser.add_argument("out", help="the .mcap; it must not exist")
    args = parser.parse_args()
    frames = skeleton.open_source(args)
    with foxglove.open_mcap(args.out):
        for frame in frames:
            time_ns = round(frame.time_s * 1e9)
            stamp = Timestamp(*divmod(time_ns, 10**9))
            turn = quaternion_of(frame.world_from_camera)
            placed = [transform(stamp, "world", "camera", (0, 0, 0), turn)]
            if frame.state != "lost":
                placed += bones(frame, stamp)
            for topic, message in (("/tf", FrameTransforms(transforms=placed)), ("/skeleton", scene(frame, stamp)),
                                   ("/depth/image", depth_image(frame, stamp)),
                                   ("/depth/calibration", calibration(frames.camera, stamp))):
                foxglove.log(topic, message, log_time=time_ns)


if __name__ == "__main__":
    skeleton.run(main)
