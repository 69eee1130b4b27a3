"""What both examples for viewers need: options, the bones between joints, and frames from a recording or a camera."""
import argparse
from pathlib import Path

import depthmocap

PARENTS = {"spine": "pelvis", "neck": "spine", "head": "neck",
           "left_shoulder": "neck", "left_elbow": "left_shoulder", "left_wrist": "left_elbow",
           "right_shoulder": "neck", "right_elbow": "right_shoulder", "right_wrist": "right_elbow",
           "left_hip": "pelvis", "left_knee": "left_hip", "left_ankle": "left_knee", "left_toe": "left_ankle",
           "right_hip": "pelvis", "right_knee": "right_hip", "right_ankle": "right_knee", "right_toe": "right_ankle"}
# Joint and its parent, as indices in depthmocap.JOINTS.
LINKS = [(depthmocap.JOINTS.index(joint), depthmocap.JOINTS.index(parent)) for joint, parent in PARENTS.items()]


def options(description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", help="a recording, or a camera by its name for --source: openni2, v4l2:/dev/video0, pipe:-")
    parser.add_argument("--people", type=int, default=1, help="most people to be tracked")
    parser.add_argument("--seconds", type=float, default=0.0, help="of a camera; 0: until Ctrl-C")
    return parser


def open_source(args):
    """An iterator of frames, whose camera is known."""
    if Path(args.source).exists():
        return depthmocap.track(args.source, people=args.people)
    return depthmocap.live(args.source, people=args.people, seconds=args.seconds)


def run(main):
    """Calls main() until Ctrl-C; what is wrong with a file or a camera is one line."""
    try:
        main()
    except KeyboardInterrupt:
        pass
    except (depthmocap.Error, OSError) as error:
        raise SystemExit(str(error)) from None
