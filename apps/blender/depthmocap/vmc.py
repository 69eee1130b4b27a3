"""Receives the VMC protocol (OSC over UDP) on a thread of its own. Knows nothing of Blender but its vectors."""
import socket
import struct
import threading
import time
from collections import deque
from dataclasses import dataclass

from mathutils import Quaternion, Vector

from .rig import Pose, Rig

# The bones of the protocol that depthmocap sends, by our names, parents before children.
PARENTS = {
    "Hips": None, "Spine": "Hips", "Neck": "Spine", "Head": "Neck",
    "LeftShoulder": "Spine", "LeftArm": "LeftShoulder", "LeftForeArm": "LeftArm", "LeftHand": "LeftForeArm",
    "RightShoulder": "Spine", "RightArm": "RightShoulder", "RightForeArm": "RightArm", "RightHand": "RightForeArm",
    "LeftUpLeg": "Hips", "LeftLeg": "LeftUpLeg", "LeftFoot": "LeftLeg", "LeftToeBase": "LeftFoot",
    "RightUpLeg": "Hips", "RightLeg": "RightUpLeg", "RightFoot": "RightLeg", "RightToeBase": "RightFoot",
}
VMC_NAMES = {"UpperArm": "Arm", "LowerArm": "ForeArm", "UpperLeg": "UpLeg", "LowerLeg": "Leg", "Toes": "ToeBase"}

MOST_FRAMES = 36000  # that wait to be taken: 10 minutes at 60 a second
QUIET_S = 1.0  # without a packet after which the stream counts as lost
DEEPEST_BUNDLE = 4


@dataclass
class Frame:
    time_s: float
    pose: Pose


def our_name(vmc_name):
    for theirs, ours in VMC_NAMES.items():
        if vmc_name.endswith(theirs):
            return vmc_name[:-len(theirs)] + ours
    return vmc_name


def messages(packet, depth=0):
    """(address, arguments) of every OSC message in a packet; ValueError or struct.error where it is damaged."""
    if packet[:8] == b"#bundle\0":
        if depth > DEEPEST_BUNDLE:
            raise ValueError("bundles too deep")
        at = 16
        while at < len(packet):
            size, = struct.unpack_from(">i", packet, at)
            if size <= 0 or at + 4 + size > len(packet):
                raise ValueError("damaged bundle")
            yield from messages(packet[at + 4:at + 4 + size], depth + 1)
            at += 4 + size
        return
    address, at = text(packet, 0)
    types, at = text(packet, at)
    arguments = []
    for kind in types[1:]:
        if kind == "s":
            value, at = text(packet, at)
        elif kind in "fi":
            value, = struct.unpack_from(">" + kind, packet, at)
            at += 4
        else:
            raise ValueError(f"arguments of type {kind}")
        arguments.append(value)
    yield address, arguments


def text(packet, at):
    end = packet.index(b"\0", at)
    return packet[at:end].decode("utf-8"), end + 4 - end % 4


class FrameBuilder:
    """Puts frames together from messages; a frame begins with its time and ends where all bones are there."""

    def __init__(self):
        self.time_s = 0.0
        self.pose = Pose({}, {})
        self.tracking = False

    def add(self, address, arguments):
        """A whole Frame, or None."""
        if address == "/VMC/Ext/OK" and len(arguments) >= 1:
            self.tracking = arguments[0] == 1 and (len(arguments) < 4 or arguments[3] == 1)
        elif address == "/VMC/Ext/T" and len(arguments) == 1:
            self.time_s, self.pose = float(arguments[0]), Pose({}, {})
        elif address == "/VMC/Ext/Bone/Pos" and len(arguments) == 8:
            return self.add_bone(our_name(str(arguments[0])), arguments[1:])
        return None

    def add_bone(self, name, numbers):
        if name not in PARENTS:
            return None
        x, y, z, qx, qy, qz, qw = numbers
        self.pose.offsets[name] = Vector((-x, y, z))  # Unity's axes are ours mirrored at x = 0
        self.pose.rotations[name] = Quaternion((qw, qx, -qy, -qz))
        if len(self.pose.offsets) < len(PARENTS):
            return None
        frame, self.pose = Frame(self.time_s, self.pose), Pose({}, {})
        return frame


class VmcReceiver:
    """Every method returns at once. OSError where the port cannot be had."""

    def __init__(self, address, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self.socket.bind((address, port))
        except OSError:
            self.socket.close()
            raise
        self.socket.settimeout(0.2)  # within which end() is heard
        self.frames = deque(maxlen=MOST_FRAMES)
        self.last_packet_s = None
        self.tracking = False
        self.ends = False
        self.thread = threading.Thread(target=self.run, name="depthmocap vmc", daemon=True)
        self.thread.start()

    def take(self):
        """Frames that came since the last call, oldest first."""
        taken = []
        while self.frames:
            taken.append(self.frames.popleft())
        return taken

    def state(self):
        """A line for the panel."""
        if self.last_packet_s is None:
            return "Waiting for a stream: depthmocap live --vmc localhost:PORT"
        quiet_s = time.monotonic() - self.last_packet_s
        if quiet_s > QUIET_S:
            return f"Connection lost: nothing has come for {quiet_s:.0f} s"
        return "Receiving" if self.tracking else "Receiving; nobody is tracked"

    def end(self):
        self.ends = True
        self.thread.join()

    def run(self):
        builder = FrameBuilder()
        while not self.ends:
            try:
                packet = self.socket.recv(65536)
            except OSError:  # nothing came, or the system has a moment's trouble
                continue
            try:
                for message in messages(packet):
                    frame = builder.add(*message)
                    if frame is not None:
                        self.frames.append(frame)
            except (ValueError, IndexError, struct.error, TypeError):
                continue  # not of this protocol
            self.last_packet_s = time.monotonic()
            self.tracking = builder.tracking
        self.socket.close()


def rig_of(frame):
    """The rig of a frame's body, its hips at their height at rest."""
    offsets = dict(frame.pose.offsets)
    low = sum((offsets[bone].y for bone in ("LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase")))
    offsets["Hips"] = Vector((0, -low, 0))
    return Rig(dict(PARENTS), offsets, {"Head": 1.6 * offsets["Head"]})
