"""Sends depth frames to `depthmocap ... --source pipe:-`, in the form of docs/reference/pipe.md."""
import json
import os
import struct
import sys

import numpy as np

MARK = b"DMCF"
HEAD = struct.Struct("<4sIqd")

# Libraries of cameras print to standard output, some when they are imported: what they print goes to standard error, and
# the frames have standard output for themselves. Import this module first.
FRAMES_OUT = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
os.dup2(sys.stderr.fileno(), sys.stdout.fileno())


def undistortion_map(width, height, fx, fy, cx, cy, coefficients):
    """Row and column of the taken picture for each pixel of one without distortion, and which of them lie outside.

    coefficients: k1 k2 p1 p2 k3 k4 k5 k6, the rational model of OpenCV. Nearest pixels: depth is never mixed.
    """
    k1, k2, p1, p2, k3, k4, k5, k6 = coefficients
    x, y = np.meshgrid((np.arange(width) - cx) / fx, (np.arange(height) - cy) / fy)
    r2 = x * x + y * y
    radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    column = np.rint((x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) * fx + cx)
    row = np.rint((y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) * fy + cy)
    outside = ~((column >= 0) & (column < width) & (row >= 0) & (row < height))
    column[outside] = row[outside] = 0
    return row.astype(int), column.astype(int), outside


class FramePipe:
    """Writes a header and frames to a binary file, by default the process' standard output."""

    def __init__(self, width, height, fx, fy, cx, cy, *, fps=30.0, depth_unit_m=0.001, distortion=None, camera="",
                 waits=False, file=None):
        """Pixels, frames per second, metres per depth step.

        distortion: k1 k2 p1 p2 k3, and k4 k5 k6 if there are such, as in OpenCV; it is taken out here.
        waits: frames wait to be read, as those of a file do; else the newest is tracked and others are skipped.
        """
        self._file = file or FRAMES_OUT
        self._shape = (height, width)
        self._map = None
        if distortion is not None and any(distortion):
            coefficients = (list(distortion) + [0.0] * 8)[:8]
            self._map = undistortion_map(width, height, fx, fy, cx, cy, coefficients)
        header = {"format": "depthmocap-recording", "version": 1, "width": width, "height": height, "fps": fps,
                  "depth_unit_m": depth_unit_m, "intrinsics": {"fx": fx, "fy": fy, "cx": cx, "cy": cy},
                  "camera": camera, "waits": waits}
        self._file.write(json.dumps(header).encode() + b"\n")
        self._file.flush()

    def write(self, number, time_s, depth):
        """depth: steps of 16 bits, an array of shape (height, width)."""
        picture = np.ascontiguousarray(np.asarray(depth).reshape(self._shape), dtype="<u2")
        if self._map is not None:
            row, column, outside = self._map
            picture = picture[row, column]
            picture[outside] = 0
        self._file.write(HEAD.pack(MARK, picture.nbytes, number, time_s))
        self._file.write(picture.data)
        self._file.flush()


def run(send, what):
    """Calls send() until Ctrl-C or until nobody reads any longer; says in one line what is wrong."""
    try:
        send()
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        sys.stderr.close()  # Python would complain about the closed pipe at exit
    except Exception as error:  # noqa: BLE001  the camera's library has many kinds
        sys.exit(f"{what}: {error}")
