"""Unpacks the chunks of recordings to the size that they tell, up to a limit."""
import bz2

from recorded_messages import MOST_BYTES, Cut, MissingPackage, need


def unpack(how, data, size):
    """The bytes of a chunk; of one that is cut short, those that are there."""
    if how in ("", "none"):
        return data
    if size > MOST_BYTES:
        raise Cut(f"a chunk of {size} bytes")
    try:
        if how == "bz2":
            return bz2.BZ2Decompressor().decompress(data, size)
        if how == "lz4":
            return need("lz4.frame", "lz4").LZ4FrameDecompressor().decompress(data, size)
        if how == "zstd":
            return need("zstandard", "zstandard").ZstdDecompressor().stream_reader(data).read(size)
    except MissingPackage:
        raise
    except Exception:  # noqa: BLE001  each of the three has errors of its own
        raise Cut("a chunk is damaged") from None
    raise Cut(f"a chunk is packed by {how!r}, which is not known")
