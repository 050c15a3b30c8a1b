"""Reads and writes the EXR files that oriel-inspect and Blender write: scan lines, float or half, no compression or ZIP."""
import struct
import zlib

import numpy

TYPES = {1: "<f2", 2: "<f4"}


def header_of(data):
    """Attributes by name and where the table of offsets begins."""
    attributes, at = {}, 8
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        (size,) = struct.unpack_from("<i", rest)
        at += len(name) + len(kind) + 6
        attributes[name.decode()] = data[at : at + size]
        at += size
    return attributes, at + 1


def channels_of(listed):
    found, at = [], 0
    while listed[at]:
        end = listed.index(0, at)
        found.append((listed[at:end].decode(), TYPES[struct.unpack_from("<i", listed, end + 1)[0]]))
        at = end + 17
    return found


def unpacked(block, size):
    """ZIP of EXR: differences of bytes, those of even places first."""
    if len(block) == size:
        return block
    steps = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    steps[1:] -= 128
    halves = (numpy.cumsum(steps) & 255).astype(numpy.uint8)
    whole = numpy.empty_like(halves)
    whole[0::2], whole[1::2] = halves[: (size + 1) // 2], halves[(size + 1) // 2 :]
    return whole.tobytes()


def read(path, layer=""):
    """Rows of red, green and blue, float64. layer: before the channels' names, with its dot."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = header_of(data)
    x0, y0, x1, y1 = struct.unpack("<iiii", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    channels = channels_of(attributes["channels"])
    line_bytes = width * sum(numpy.dtype(kind).itemsize for _, kind in channels)
    planes = {name: numpy.zeros((height, width)) for name, _ in channels}
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = range(y - y0, min(y - y0 + lines, height))
        raw, used = unpacked(data[offset + 8 : offset + 8 + size], len(rows) * line_bytes), 0
        for row in rows:
            for name, kind in channels:
                planes[name][row] = numpy.frombuffer(raw, kind, width, used)
                used += width * numpy.dtype(kind).itemsize
    return numpy.stack([planes[layer + c] for c in "RGB"], -1)


def write(path, image):
    """Red, green and blue as floats, not compressed."""
    height, width, _ = image.shape
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    names = b"".join(c + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    head = struct.pack("<ii", 20000630, 2)
    for name, kind, value in (
        (b"channels", b"chlist", names), (b"compression", b"compression", b"\0"), (b"dataWindow", b"box2i", box),
        (b"displayWindow", b"box2i", box), (b"lineOrder", b"lineOrder", b"\0"), (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        (b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)), (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ):
        head += name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    head += b"\0"
    line = 12 * width
    first = len(head) + 8 * height
    with open(path, "wb") as file:
        file.write(head + struct.pack(f"<{height}Q", *(first + y * (line + 8) for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, line))
            file.write(numpy.ascontiguousarray(image[y, :, ::-1].T, "<f4").tobytes())
