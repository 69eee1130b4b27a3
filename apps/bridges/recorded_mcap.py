"""Messages of an .mcap: ROS 1, ROS 2, Foxglove as protocol buffers or JSON. Read from its beginning, closed or not."""
import struct
import zlib

from recorded_messages import MOST_BYTES, Cut, Message, foxglove_json, foxglove_message, need, ros_message
from recorded_unpack import unpack

MAGIC = b"\x89MCAP0\r\n"


class Limited:
    """A file of which nobody reads more than MOST_BYTES at once."""

    def __init__(self, file):
        self._file = file

    def read(self, size):
        return self._file.read(min(size, MOST_BYTES))


def records(file):
    reading = need("mcap.stream_reader", "mcap")
    kinds = need("mcap.records", "mcap")
    for record in reading.StreamReader(Limited(file), emit_chunks=True, record_size_limit=MOST_BYTES).records:
        if not isinstance(record, kinds.Chunk):
            yield record
            continue
        record.data = unpack(record.compression, record.data, record.uncompressed_size)
        record.compression = ""
        if record.uncompressed_crc and zlib.crc32(record.data) != record.uncompressed_crc:
            raise Cut("a chunk is damaged")
        yield from reading.breakup_chunk(record)


def protobuf_decoder(schema):
    support = need("mcap_protobuf.decoder", "mcap-protobuf-support")
    return support.DecoderFactory().decoder_for("protobuf", schema)


def message_of(channel, schema, record, decoders):
    kind = schema.name if schema else ""
    how, topic, time_ns, data = channel.message_encoding, channel.topic, record.log_time, record.data
    if how in ("cdr", "ros1"):
        return ros_message(topic, kind, time_ns, data, cdr=how == "cdr")
    if how == "json":
        return foxglove_message(topic, kind, time_ns, lambda: foxglove_json(data))
    if how == "protobuf":
        def decode():
            if schema.id not in decoders:
                decoders[schema.id] = protobuf_decoder(schema)
            return decoders[schema.id](data)
        return foxglove_message(topic, kind, time_ns, decode)
    return Message(topic, f"{kind} ({how})", time_ns, None)


def messages(path):
    kinds = need("mcap.records", "mcap")
    schemas, channels, decoders = {}, {}, {}
    with open(path, "rb") as file:
        try:
            for record in records(file):
                if isinstance(record, kinds.Schema):
                    schemas[record.id] = record
                elif isinstance(record, kinds.Channel):
                    channels[record.id] = record
                elif isinstance(record, kinds.Message) and record.channel_id in channels:
                    channel = channels[record.channel_id]
                    yield message_of(channel, schemas.get(channel.schema_id), record, decoders)
                elif isinstance(record, kinds.DataEnd):
                    return
        except (need("mcap.exceptions", "mcap").McapError, struct.error, ValueError) as error:
            raise Cut(str(error) or "the end is missing") from None
