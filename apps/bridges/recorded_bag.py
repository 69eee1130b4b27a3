"""Messages of a .bag of ROS 1, read from its beginning, so that one that was never closed is read, too."""
import io
import struct

from recorded_messages import MOST_BYTES, Cut, ros_message
from recorded_unpack import unpack

MAGIC = b"#ROSBAG V2.0\n"
MESSAGE, CHUNK, CONNECTION = b"\x02", b"\x05", b"\x07"  # what a record is, its field "op"
MOST_HEADER_BYTES = 1 << 20  # of a record; names of topics and types have some hundred


def fields(block):
    """name=value, each behind its length."""
    found = {}
    at = 0
    while at + 4 <= len(block):
        size, = struct.unpack_from("<I", block, at)
        name, equals, value = block[at + 4:at + 4 + size].partition(b"=")
        if not equals or at + 4 + size > len(block):
            break
        found[name] = value
        at += 4 + size
    return found


def block(file, most, partial=False):
    """What stands behind its length in 4 bytes. partial: at the end of the file what is there."""
    size = file.read(4)
    if not size:
        return None
    size = struct.unpack("<I", size.ljust(4, b"\xff"))[0]
    if size > most:
        raise Cut("a record is damaged")
    data = file.read(size)
    if len(data) < size and not partial:
        raise Cut("the end is missing")
    return data


def number(header, name, form="<I"):
    value = header.get(name, b"")
    if len(value) != struct.calcsize(form):
        raise Cut("a record is damaged")
    return struct.unpack(form, value)


def records(file):
    """(fields of the header, data) of all records."""
    while (head := block(file, MOST_HEADER_BYTES)) is not None:
        header = fields(head)
        if b"op" not in header:
            raise Cut("a record is damaged")
        yield header, block(file, MOST_BYTES, header[b"op"] == CHUNK) or b""


def messages_in(file, connections):
    for header, data in records(file):
        if header[b"op"] == CONNECTION:
            texts = header.get(b"topic", b""), fields(data).get(b"type", b"")
            connections[number(header, b"conn")] = tuple(text.decode("utf-8", "replace") for text in texts)
        elif header[b"op"] == MESSAGE:
            connection = connections.get(number(header, b"conn"))
            seconds, nanoseconds = number(header, b"time", "<II")
            if connection is not None:
                yield ros_message(*connection, seconds * 10**9 + nanoseconds, data, cdr=False)
        elif header[b"op"] == CHUNK and isinstance(file, io.BufferedReader):  # there is none in a chunk
            how = header.get(b"compression", b"none").decode("ascii", "replace")
            yield from messages_in(io.BytesIO(unpack(how, data, *number(header, b"size"))), connections)


def messages(path):
    with open(path, "rb") as file:
        file.seek(len(MAGIC))
        yield from messages_in(file, {})
