"""Just enough of the formats stereo pairs come in, with Python's standard library only.

An image is (width, height, channels, bytes), rows from the top, 8 bits a sample, channels 1 or 3. A float map is
(width, height, array('f')), rows from the top; infinity = unknown.
"""

import array
import ast
import io
import math
import re
import struct
import sys
import zipfile
import zlib


class format_error(Exception):
    """The data is not what its format asks for, or uses a part of the format that is not supported."""


def read_image(data):
    """A PNG (not interlaced, at most 8 bits a sample) or a binary PGM/PPM (8 bits), as an image."""
    if data.startswith(b"\x89PNG\r\n\x1a\n"):
        return _read_png(data)
    if data[:2] in (b"P5", b"P6"):
        return _read_pnm(data)
    raise format_error("neither a PNG nor a binary PGM or PPM")


def write_pnm(image):
    """PGM for one channel, PPM for three, with the shortest header: equal pixels give equal bytes."""
    width, height, channels, samples = image
    return b"P%d\n%d %d\n255\n" % (6 if channels == 3 else 5, width, height) + samples


def _read_pnm(data):
    separator = rb"(?:\s|#[^\n]*\n)+"
    header = re.match(rb"P([56])" + separator + rb"(\d+)" + separator + rb"(\d+)" + separator + rb"(\d+)\s", data)
    if not header:
        raise format_error("broken PNM header")
    kind, width, height, maximum = (int(group) for group in header.groups())
    if maximum != 255:
        raise format_error(f"PNM with a maximum of {maximum}; only 8-bit images (255) are supported")
    channels = 3 if kind == 6 else 1
    samples = data[header.end() : header.end() + width * height * channels]
    if len(samples) != width * height * channels:
        raise format_error("truncated PNM")
    return width, height, channels, samples


def _png_chunks(data):
    position = 8
    while position + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, position)
        body = data[position + 8 : position + 8 + length]
        if len(body) != length or position + 12 + length > len(data):
            break
        if zlib.crc32(kind + body) != struct.unpack_from(">I", data, position + 8 + length)[0]:
            raise format_error("PNG with a wrong check sum")
        yield kind, body
        if kind == b"IEND":
            return
        position += 12 + length
    raise format_error("truncated PNG")


def _undo_filter(kind, line, above, distance):
    """One PNG scan line, in place; `distance` = bytes from a sample to the one left of it."""
    if kind == 0:
        return
    if kind not in (1, 2, 3, 4):
        raise format_error(f"PNG with an unknown filter {kind}")
    for i in range(len(line)):
        left = line[i - distance] if i >= distance else 0
        up = above[i]
        if kind == 1:
            predicted = left
        elif kind == 2:
            predicted = up
        elif kind == 3:
            predicted = (left + up) >> 1
        else:
            corner = above[i - distance] if i >= distance else 0
            estimate = left + up - corner
            to_left, to_up, to_corner = abs(estimate - left), abs(estimate - up), abs(estimate - corner)
            if to_left <= to_up and to_left <= to_corner:
                predicted = left
            else:
                predicted = up if to_up <= to_corner else corner
        line[i] = (line[i] + predicted) & 255


def _read_png(data):
    header = palette = None
    packed = b""
    for kind, body in _png_chunks(data):
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"PLTE":
            palette = body
        elif kind == b"IDAT":
            packed += body
    if header is None:
        raise format_error("PNG without a header")
    width, height, depth, colour, _, _, interlaced = header
    samples_a_pixel = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}.get(colour)
    if samples_a_pixel is None or depth > 8 or interlaced or (colour == 3 and palette is None):
        raise format_error("PNG of an unsupported kind (interlaced, or more than 8 bits a sample)")
    try:
        raw = zlib.decompress(packed)
    except zlib.error as error:
        raise format_error(f"broken PNG data: {error}") from error
    line_bytes = (width * samples_a_pixel * depth + 7) // 8
    if len(raw) < height * (line_bytes + 1):
        raise format_error("PNG with too few lines")
    distance = max(1, samples_a_pixel * depth // 8)
    samples = bytearray()
    above = bytes(line_bytes)
    for y in range(height):
        start = y * (line_bytes + 1)
        line = bytearray(raw[start + 1 : start + 1 + line_bytes])
        _undo_filter(raw[start], line, above, distance)
        above = line
        if depth < 8:
            mask = (1 << depth) - 1
            line = bytes(line[x * depth // 8] >> (8 - depth - x * depth % 8) & mask for x in range(width))
            if colour == 0:
                line = bytes(value * 255 // mask for value in line)
        if colour == 3:
            line = b"".join(palette[3 * index : 3 * index + 3] for index in line)
        elif colour == 4:
            line = line[0::2]
        elif colour == 6:
            line = bytes(value for i, value in enumerate(line) if i % 4 != 3)
        samples += line
    channels = 1 if colour in (0, 4) else 3
    samples = bytes(samples)
    if len(samples) != width * height * channels:
        raise format_error("PNG with a palette that is too short")
    # Grey stored as colour or through a palette is the same picture as grey.
    if channels == 3 and samples[0::3] == samples[1::3] == samples[2::3]:
        return width, height, 1, samples[0::3]
    return width, height, channels, samples


def read_pfm(data):
    """A one-channel PFM as a float map. The scale factor of its header says the byte order only."""
    header = re.match(rb"Pf\s+(\d+)\s+(\d+)\s+(-?[0-9.]+(?:[eE][-+]?\d+)?)\s", data)
    if not header:
        raise format_error("broken PFM header")
    width, height = int(header[1]), int(header[2])
    body = data[header.end() :]
    if len(body) != 4 * width * height:
        raise format_error("PFM of a wrong length")
    values = _floats(body, little_endian=float(header[3]) < 0)
    return width, height, _flipped(values, width, height)


def write_pfm(float_map):
    width, height, values = float_map
    values = _flipped(values, width, height)
    if sys.byteorder == "big":
        values.byteswap()
    return b"Pf\n%d %d\n-1.0\n" % (width, height) + values.tobytes()


def read_npz(data):
    """The only array of a NumPy .npz file, which must be two-dimensional little-endian float32, as a float map."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = archive.namelist()
            if len(names) != 1:
                raise format_error(f"npz with {len(names)} arrays instead of one")
            content = archive.read(names[0])
    except zipfile.BadZipFile as error:
        raise format_error(f"broken npz: {error}") from error
    if content[:7] != b"\x93NUMPY\x01":
        raise format_error("npz without a NumPy 1.0 array")
    (header_length,) = struct.unpack_from("<H", content, 8)
    header = ast.literal_eval(content[10 : 10 + header_length].decode("latin-1"))
    shape = header["shape"]
    if header["descr"] != "<f4" or header["fortran_order"] or len(shape) != 2:
        raise format_error(f"npz array of an unsupported kind: {header}")
    height, width = shape
    body = content[10 + header_length :]
    if len(body) != 4 * width * height:
        raise format_error("npz array of a wrong length")
    return width, height, _floats(body, little_endian=True)


def scale_truth(image, numerator, denominator):
    """A truth image (grey level = disparity, 0 = unknown) shrunk by numerator/denominator, as a float map.

    Every pixel takes the value of the source pixel that holds its centre: disparities are not mixed across edges.
    """
    width, height, channels, samples = image
    if channels != 1:
        raise format_error("a truth image must be grey")
    small_width, small_height = -(-width * numerator // denominator), -(-height * numerator // denominator)
    values = array.array("f")
    for y in range(small_height):
        row = min((2 * y + 1) * denominator // (2 * numerator), height - 1) * width
        for x in range(small_width):
            level = samples[row + min((2 * x + 1) * denominator // (2 * numerator), width - 1)]
            values.append(level * numerator / denominator if level else math.inf)
    return small_width, small_height, values


def _floats(data, little_endian):
    values = array.array("f")
    values.frombytes(data)
    if little_endian != (sys.byteorder == "little"):
        values.byteswap()
    return values


def _flipped(values, width, height):
    flipped = array.array("f")
    for y in reversed(range(height)):
        flipped.extend(values[y * width : (y + 1) * width])
    return flipped
