"""recorded.py with files that are cut short, damaged or made to mislead: what is whole, one warning or one line."""
import bz2
import json
import random
import sqlite3
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from recorded_files import IMAGE, INFO, Ros, small
from test_recorded import KINDS, azure, mcap, mkv

KINDS = {**KINDS, "mkv": lambda path, take: mkv(path, azure(take))}
CUTS = 12
FLIPS = 25


def outcomes(paths):
    """Of each file the error, what was said and the frames. Fails where a file crashes the reader or is too much for it."""
    done = subprocess.run([sys.executable, Path(__file__).with_name("read_damaged.py"), *paths], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    found = []
    for line in done.stderr.splitlines():
        outcome = json.loads(line)
        assert bool(outcome["error"]) == (not outcome["frames"]), outcome
        assert "\n" not in outcome["error"] + "".join(outcome["said"])
        found.append((outcome["error"], outcome["said"], outcome["frames"]))
    assert len(found) == len(paths)
    return found


def file_in(path):
    return next(path.glob("*.db3")) if path.is_dir() else path


def written(path, data):
    path.write_bytes(data)
    return path


@pytest.fixture(params=KINDS)
def whole(request, tmp_path):
    return file_in(KINDS[request.param](tmp_path, small()))


def test_of_a_file_that_is_cut_short_the_whole_pictures_are_sent(whole, tmp_path):
    data = whole.read_bytes()
    (_, _, pictures), = outcomes([whole])
    cuts = [len(data) * n // CUTS for n in range(1, CUTS)]
    ends = outcomes([written(tmp_path / f"cut{cut}", data[:cut]) for cut in cuts])
    for cut, (error, said, sent) in zip(cuts, ends):
        assert sent == pictures[:len(sent)], cut
        if 0 < len(sent) < len(pictures):
            assert len(said) == 2 and said[1].startswith("warning: "), (cut, said)


def test_damaged_bytes_do_no_harm(whole, tmp_path):
    data = whole.read_bytes()
    chance = random.Random(7)
    paths = []
    for n in range(FLIPS):
        damaged = bytearray(data)
        for _ in range(chance.choice((1, 4, 30))):
            damaged[chance.randrange(len(data))] = chance.choice((0, 255, chance.randrange(256)))
        paths.append(written(tmp_path / f"damaged{n}", damaged))
    outcomes(paths)


def refused(path):
    (error, _, _), = outcomes([path])
    return error


def bag(path, compression, unpacked_size, data, data_size=None):
    """A .bag of one chunk that tells these sizes; compression, sizes and data need not fit."""
    fields = (b"op=\x05", b"compression=" + compression, b"size=" + struct.pack("<I", unpacked_size))
    header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
    sizes = struct.pack("<I", len(header)), struct.pack("<I", len(data) if data_size is None else data_size)
    return written(path, b"#ROSBAG V2.0\n" + sizes[0] + header + sizes[1] + data)


def test_bags_with_sizes_that_mislead(tmp_path):
    bomb = bz2.compress(bytes(1 << 26))
    largest = 2**32 - 1
    for name, *chunk in (("record", b"none", 1, b"", largest), ("unpacked", b"bz2", largest, bomb),
                         ("bomb", b"bz2", 1 << 20, bomb), ("packer", b"rar", 1 << 20, b"abc"), ("garbage", b"lz4", 99, b"abc")):
        assert refused(bag(tmp_path / name, *chunk)), name
    assert refused(written(tmp_path / "header", b"#ROSBAG V2.0\n" + b"\xff" * 4))


def test_mcaps_with_sizes_that_mislead(tmp_path):
    data = mcap(tmp_path, small(2)).read_bytes()
    at = data.index(b"\x06", 8 + 9)  # the first chunk: opcode, length, two times, unpacked size
    for offset in (1, 25):
        for size in (2**63, 2**40, 2**27 + 1):
            wrong = data[:at + offset] + struct.pack("<Q", size) + data[at + offset + 8:]
            assert refused(written(tmp_path / "wrong", wrong))


def test_pictures_and_lenses_with_sizes_that_mislead(tmp_path):
    ros, take = Ros(1), small(2)
    pack = [(INFO, ros.pack(ros.info(take)), "sensor_msgs/msg/CameraInfo"),
            (IMAGE, ros.pack(ros.image(take.pictures[0], 1)), "sensor_msgs/msg/Image")]
    height_at = struct.calcsize("<IIII") + len("depth")
    for topic, which, wrong in ((0, "lens", struct.pack("<II", 60000, 60000)), (1, "picture", struct.pack("<II", 60000, 60000)),
                                (1, "none", struct.pack("<II", 0, 0))):
        path = tmp_path / f"{which}.mcap"
        writer = pytest.importorskip("mcap.writer").Writer(str(path))
        writer.start()
        for n, (name, data, kind) in enumerate(pack):
            channel = writer.register_channel(name, "ros1", writer.register_schema(kind, "ros1msg", b""))
            data = data[:height_at] + wrong + data[height_at + 8:] if n == topic else data
            writer.add_message(channel, 1, data, 1)
        writer.finish()
        assert refused(path)


def test_databases_that_compute_their_rows(tmp_path):
    for name, sql in (("view", "CREATE VIEW messages AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) "
                               "SELECT x AS id, 1 AS topic_id, x AS timestamp, zeroblob(1000000) AS data FROM n"),
                      ("column", "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
                                 "data BLOB AS (zeroblob(900000000)))"),
                      ("none", "CREATE TABLE other(id INTEGER)")):
        path = tmp_path / f"{name}.db3"
        with sqlite3.connect(path) as database:
            database.execute("CREATE TABLE topics(id INTEGER, name TEXT, type TEXT)")
            database.execute("INSERT INTO topics VALUES (1, '/depth', 'sensor_msgs/msg/Image')")
            database.execute(sql)
            if name == "column":
                database.execute("INSERT INTO messages(topic_id, timestamp) VALUES (1, 1)")
        database.close()
        assert "it has no messages of ROS 2" in refused(path)


def test_tracks_with_sizes_that_mislead(tmp_path):
    data = mkv(tmp_path, azure(small(2))).read_bytes()
    size = b"\xb0\x82" + struct.pack(">H", 640) + b"\xba\x82" + struct.pack(">H", 576)
    assert size in data
    wrong = data.replace(size, b"\xb0\x82\xff\xff\xba\x82\xff\xff")
    assert refused(written(tmp_path / "wrong.mkv", wrong))
