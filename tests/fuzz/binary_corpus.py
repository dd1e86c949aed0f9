#!/usr/bin/env python3
"""Writes the binary files of the corpus, each as small as its format allows.

Usage: python3 tests/fuzz/binary_corpus.py AISLE_READ_MODEL. The text files were written by hand or
by the program itself. Changed formats change here.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
MODELS = CORPUS.parent.parent / "support/gltf_models.py"
MASK = (1 << 64) - 1


def write(target, name, content):
    (CORPUS / target).mkdir(parents=True, exist_ok=True)
    (CORPUS / target / name).write_bytes(content)


def counted(items):
    return struct.pack("<Q", len(items)) + b"".join(items)


def map_checksum(body):
    value = 0xCBF29CE484222325
    words = [int.from_bytes(body[i:i + 8], "little") for i in range(0, len(body) // 8 * 8, 8)]
    for word in words + list(body[len(body) // 8 * 8:]):
        value = ((value ^ word) * 0x100000001B3) & MASK
        value ^= value >> 29
    return value


POSE = struct.pack("<12d", 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)


def frame(number, features):
    return (struct.pack("<qqd", number, number * 50_000_000, 1.2)
            + counted([struct.pack("<ffiff", 100 + 50 * i, 80, 0, 10, 30) for i in range(features)])
            + counted([struct.pack("<4Q", i, 2, 3, 4) for i in range(features)])
            + counted([struct.pack("<6d", 100 + 50 * i, 80, 12, 1, 0.5, 0)
                       for i in range(features)])
            + counted([bytes([40 + i]) * 15 * 15 for i in range(features)]))


def keyframe(number, parent, landmarks):
    return (struct.pack("<qq", number, parent) + POSE
            + counted([struct.pack("<ii", slot, 0) for slot in landmarks])
            + frame(number, len(landmarks)))


def landmark(slot, observations):
    return (struct.pack("<ii3d", slot, 0, 0.5, 0.2, 4 + slot)
            + counted([struct.pack("<qi", keyframe, feature) for keyframe, feature in observations])
            + struct.pack("<qii4Q3ddi", 0, 3, 2, slot, 2, 3, 4, 0, 0, 1, 4.0, 0))


def small_map():
    body = struct.pack("<ii5dq", 752, 480, 435.2, 435.2, 367.2, 252.2, 0.12, 1)
    body += counted([keyframe(0, -1, [0, 1, -1]), keyframe(1, 0, [1, -1, 0])])
    body += counted([landmark(0, [(0, 0), (1, 2)]), landmark(1, [(0, 1), (1, 0)])])
    body += counted([struct.pack("<i", 1)] * 3) + counted([struct.pack("<i", 2)])
    body += counted([]) + struct.pack("<q", 2)
    return b"aislemap" + struct.pack("<IIQQ", 3, 0, len(body), map_checksum(body)) + body


def vocabulary():
    def node(first, children, word, weight):
        return struct.pack("<4Qiiif", first & 7, word & 7, 3, 4, first, children, word, weight)

    nodes = node(1, 2, -1, 0) + node(-1, 0, 0, 0.7) + node(-1, 0, 1, 0.2)
    value = 0xCBF29CE484222325
    for byte in nodes:
        value = ((value ^ byte) * 0x100000001B3) & MASK
    return b"aislevoc" + struct.pack("<IIQ", 1, 3, value) + nodes


def png(kind, depth, rows, palette=None):
    def chunk(name, content):
        return (struct.pack(">I", len(content)) + name + content
                + struct.pack(">I", zlib.crc32(name + content)))

    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind]
    width = len(rows[0]) * 8 // (depth * channels)
    data = chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), depth, kind, 0, 0, 0))
    if palette:
        data += chunk(b"PLTE", palette)
    data += chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows)))
    return b"\x89PNG\r\n\x1a\n" + data + chunk(b"IEND", b"")


def text(bytes_):
    return struct.pack("<I", len(bytes_)) + bytes_


def record(op, body):
    return struct.pack("<BQ", op, len(body)) + body


def cdr_header(stamp=(1, 2), frame=b"map\0"):
    return b"\0\1\0\0" + struct.pack("<iI", *stamp) + text(frame)


def mcap(how):
    """A bag of one schema, one channel and two messages: bare, in a chunk, or in one of zstd."""
    schema = struct.pack("<H", 1) + text(b"std_msgs/msg/Header") + text(b"ros2msg") + text(b"x")
    channel = struct.pack("<HH", 1, 1) + text(b"/a") + text(b"cdr") + struct.pack("<I", 0)
    records = record(3, schema) + record(4, channel)
    for k in range(2):
        records += record(5, struct.pack("<HIQQ", 1, k, k, k) + cdr_header((k, 0)))
    body, method = records, b""
    if how == "zstd":  # one raw block behind a head that states the size
        block = struct.pack("<I", 1 | len(records) << 3)[:3]
        body = b"\x28\xB5\x2F\xFD\x20" + struct.pack("<B", len(records)) + block + records
        method = b"zstd"
    if how != "bare":
        chunk = struct.pack("<QQQI", 0, 1, len(records), zlib.crc32(records)) + text(method)
        records = record(6, chunk + struct.pack("<Q", len(body)) + body)
    metadata = record(12, text(b"aisle") + text(text(b"scene") + text(b"short")))
    magic = b"\x89MCAP0\r\n"
    return (magic + record(1, text(b"ros2") + text(b"x")) + records + metadata +
            record(15, bytes(4)) + record(2, bytes(20)) + magic)


def main(reader):
    for how in ("bare", "chunk", "zstd"):
        write("mcap", how + ".mcap", mcap(how))
    image = cdr_header() + struct.pack("<II", 2, 3) + text(b"mono8\0") + b"\0\0" + struct.pack("<I", 3)
    write("ros_message", "image", b"\4" + image + text(bytes(range(6))))
    write("ros_message", "compressed", b"\5" + cdr_header() + text(b"png\0") + text(png(0, 8, [b"\0\1"] * 2)))
    write("ros_message", "transforms", b"\1\0\1\0\0" + struct.pack("<I", 1) + cdr_header()[4:] +
          text(b"rig\0") + bytes(4) + struct.pack("<7d", 1, 2, 3, 0, 0, 0, 1))
    write("map_file", "two_keyframes.map", small_map())
    write("vocabulary", "two_words.voc", vocabulary())
    write("png", "grey.png", png(0, 8, [b"\0\x80\xff", b"\1\2\3"]))
    write("png", "deep.png", png(0, 16, [b"\0\0\xff\xff"] * 2))
    write("png", "colour.png", png(2, 8, [b"\0\0\0\1\2\3"] * 2))
    write("png", "palette.png", png(3, 8, [b"\0\1\0", b"\1\1\0"], b"\0\0\0\x80\0\0"))
    write("png", "bits.png", png(0, 1, [b"\xA5"] * 2))
    numbers = struct.pack("<12f", *range(12))
    write("pfm", "little.pfm", b"PF\n2 2\n-1.0\n" + numbers)
    write("pfm", "big.pfm", b"PF\n2 2\n1.0\n" + numbers)
    write("pfm", "grey.pfm", b"Pf\n2 2\n-1.0\n" + numbers[:16])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([sys.executable, MODELS, folder], check=True)
        for name in ("same_names", "splines", "sparse", "quantized", "primitives"):
            write("glb", name + ".glb", (folder / (name + ".glb")).read_bytes())
        write("gltf", "inline.gltf", (folder / "text_inline.gltf").read_bytes())
        for name in ("same_names", "splines"):
            file = folder / (name + ".glb")
            limits = [str(file), str(folder), "0", "0", "0", "0", "0", "0", "5000000", "8192",
                      str(1 << 28), "10000", str(4 << 30), "120", "1"]
            write("model_bytes", name, subprocess.run([reader] + limits, check=True,
                                                      capture_output=True).stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
