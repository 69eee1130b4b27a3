"""Reads files one by one in a process of little memory: read_damaged.py FILE... prints of each how it ended, as JSON."""
import io
import json
import resource
import signal
import sys
import zlib
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).parents[3] / "apps/bridges"))
import frame_pipe
import recorded
from recorded_messages import Cut, MissingPackage

MOST_BYTES = 2 << 30  # of addresses: libraries take some hundred MB, a hostile size in a header would ask for more
PATIENCE_S = 20  # for a file of some kB
resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))


def frames(stream):
    """A sum of each picture that was sent."""
    line, _, rest = stream.partition(b"\n")
    if not stream:
        return []
    header = json.loads(line)
    size = frame_pipe.HEAD.size + 2 * header["width"] * header["height"]
    assert len(rest) % size == 0
    return [zlib.crc32(rest[at + frame_pipe.HEAD.size:at + size]) for at in range(0, len(rest), size)]


def read(path):
    frame_pipe.FRAMES_OUT = out = io.BytesIO()
    said = []
    recorded.say = said.append
    signal.alarm(PATIENCE_S)
    error = ""
    try:
        recorded.send(SimpleNamespace(file=Path(path), list=False, topic=None, camera=None))
    except (RuntimeError, Cut, MissingPackage) as wrong:
        error = str(wrong)
    signal.alarm(0)
    return {"error": error, "said": said, "frames": frames(out.getvalue())}


def main():
    for path in sys.argv[1:]:
        print(json.dumps(read(path)), file=sys.stderr)


main()
