"""Reads PNG files, and says how much there is to see."""

import struct
import zlib


def pixels(png):
    """Width, height and rows of RGB or RGBA bytes of a PNG without interlacing."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at : at + 8])
        part = png[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, _, color = struct.unpack(">IIBB", part[:10])
        data += part if kind == b"IDAT" else b""
        at += 12 + size
    channels = {2: 3, 6: 4}[color]
    raw, rows, before = zlib.decompress(data), [], bytearray(width * channels)
    for y in range(height):
        start = y * (width * channels + 1)
        kind, row = raw[start], bytearray(raw[start + 1 : start + 1 + width * channels])
        for i in range(len(row)):
            left, up = row[i - channels] if i >= channels else 0, before[i]
            corner = before[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                row[i] = (row[i] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        rows.append(row)
        before = row
    return width, height, channels, rows


def colors(png):
    """How many colours a picture has, and the part of its commonest one."""
    width, _, channels, rows = pixels(png)
    found = {}
    for row in rows:
        for i in range(width):
            color = bytes(row[i * channels : i * channels + 3])
            found[color] = found.get(color, 0) + 1
    return len(found), max(found.values()) / sum(found.values())


def changed(before, after):
    """The part of the pixels that differ between two pictures of the same size."""
    (width, height, channels, one), (_, _, _, two) = pixels(before), pixels(after)
    differ = sum(a[i : i + 3] != b[i : i + 3] for a, b in zip(one, two) for i in range(0, channels * width, channels))
    return differ / (width * height)
