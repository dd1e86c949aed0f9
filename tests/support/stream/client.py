"""A system behind aisle's stream that says it never moved: where your own begins.

Usage in a suite file: {name: mine, contract: stream, command: python3 tests/support/stream/client.py}
"""

import os
import struct
import sys

HELLO, FRAME, POSE, LOST, END, TRACK = range(1, 7)
VERSION = 1
STDIN = sys.stdin.buffer
STDOUT = os.fdopen(os.dup(1), "wb")  # prints go to stderr from here on: stdout is the stream's
os.dup2(2, 1)


def receive():
    head = STDIN.read(8)
    if len(head) < 8:
        sys.exit("the harness went away")
    length, kind = struct.unpack("<II", head)
    return kind, STDIN.read(length)


def send(kind, payload):
    STDOUT.write(struct.pack("<II", len(payload), kind) + payload)
    STDOUT.flush()


def locate(left, right, width, height):
    """Your SLAM: (tx, ty, tz, qx, qy, qz, qw) of the left camera, or None where it is lost."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0


def main():
    kind, hello = receive()
    version, width, height, _, fx, fy, cx, cy, baseline_m, rate_hz = struct.unpack("<4I6d", hello)
    if kind != HELLO or version != VERSION:
        sys.exit("not my version of the stream")
    send(HELLO, struct.pack("<I", VERSION) + b"stands still")
    track = b""
    while True:
        kind, payload = receive()
        if kind == END:
            return send(TRACK, track)
        if kind != FRAME:  # the wheels' motion to it, say, which is not answered
            continue
        number, stamp_ns = struct.unpack("<qq", payload[:16])
        size = width * height
        pose = locate(payload[16 : 16 + size], payload[16 + size :], width, height)
        if pose is None:
            send(LOST, struct.pack("<q", number))
        else:
            send(POSE, struct.pack("<q7d", number, *pose))
            track += struct.pack("<q7d", stamp_ns, *pose)


main()
