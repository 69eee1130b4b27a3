#!/usr/bin/env python3
"""Shows tracked people in the Rerun viewer. Needs: pip install depthmocap rerun-sdk

    python3 to_rerun.py recordings/walk                     # opens the viewer
    python3 to_rerun.py openni2                             # a camera, until Ctrl-C
    python3 to_rerun.py recordings/walk --save walk.rrd     # a file for the viewer: rerun walk.rrd
"""
import depthmocap
import numpy as np
import rerun as rr

import skeleton

# Colours of people, from the first on.
COLORS = [(240, 180, 60), (80, 180, 240), (160, 220, 90), (230, 110, 150), (180, 140, 240), (120, 220, 210)]


def show_camera(camera):
    parts = [rr.AnnotationInfo(id=part, label=name) for part, name in enumerate(depthmocap.PARTS)]
    parts[0] = rr.AnnotationInfo(id=0, label=depthmocap.PARTS[0], color=(0, 0, 0, 0))  # the room is not painted over
    rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Y_UP, static=True)
    rr.log("world/camera", rr.AnnotationContext(parts), static=True)
    rr.log("world/camera/image", rr.Pinhole(resolution=[camera.width, camera.height], focal_length=[camera.fx, camera.fy],
                                            principal_point=[camera.cx, camera.cy], camera_xyz=rr.ViewCoordinates.RDF),
           static=True)


def show_pictures(frame):
    """Depth, which the viewer shows as points, too, small and grey so that the skeleton is seen among them; and the body
    part of each pixel."""
    rr.log("world/camera", rr.Transform3D(mat3x3=frame.world_from_camera))
    rr.log("world/camera/image/depth", rr.DepthImage(frame.depth, meter=1.0, colormap="grayscale", point_fill_ratio=0.2))
    rr.log("world/camera/image/parts", rr.SegmentationImage(frame.labels, opacity=0.5))


def show_person(frame):
    name = f"world/camera/person_{frame.person}"
    if frame.state == "lost":
        rr.log(name, rr.Clear(recursive=True))
        return
    color = COLORS[(frame.person - 1) % len(COLORS)]
    rr.log(f"{name}/joints", rr.Points3D(frame.joints, radii=0.02, colors=color, labels=depthmocap.JOINTS, show_labels=False))
    rr.log(f"{name}/bones", rr.LineStrips3D([frame.joints[list(link)] for link in skeleton.LINKS], radii=0.01, colors=color))
    rr.log(f"{name}/markers", rr.Points3D(frame.markers[np.isfinite(frame.markers).all(axis=1)], radii=0.01))


def main():
    parser = skeleton.options(__doc__)
    parser.add_argument("--save", metavar="FILE", help="writes an .rrd file in place of opening the viewer")
    args = parser.parse_args()
    frames = skeleton.open_source(args)
    rr.init("depthmocap", spawn=args.save is None)
    if args.save:
        rr.save(args.save)
    show_camera(frames.camera)
    for frame in frames:
        rr.set_time("time", duration=frame.time_s)
        rr.set_time("frame", sequence=frame.frame)
        show_pictures(frame)
        show_person(frame)


if __name__ == "__main__":
    skeleton.run(main)
