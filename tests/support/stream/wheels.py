"""A system behind aisle's stream that goes by the wheels alone: for `options: {odometry: true}`."""

import struct
import sys

HELLO, FRAME, POSE, LOST, END, TRACK, MOTION = range(1, 8)
VERSION = 1


def receive():
    length, kind = struct.unpack("<II", sys.stdin.buffer.read(8))
    return kind, sys.stdin.buffer.read(length)


def send(kind, payload):
    sys.stdout.buffer.write(struct.pack("<II", len(payload), kind) + payload)
    sys.stdout.buffer.flush()


def turned(q, v):
    """A vector by a unit quaternion (x, y, z, w)."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def moved(pose, t_now_before):
    """The pose after a motion: before's times the inverse of what maps before's points to now's."""
    t, q = t_now_before[:3], t_now_before[3:7]
    back = (-q[0], -q[1], -q[2], q[3])
    step = turned(back, [-x for x in t])
    ahead = turned(pose[3:], step)
    return tuple(a + b for a, b in zip(pose[:3], ahead)) + product(pose[3:], back)


receive()
send(HELLO, struct.pack("<I", VERSION) + b"by wheels")
pose, track = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), b""
while True:
    kind, payload = receive()
    if kind == END:
        send(TRACK, track)
        break
    number = struct.unpack("<q", payload[:8])[0]
    if kind == MOTION:  # of the frame that comes next; the covariance (6 by 6) follows it
        values = struct.unpack("<q7d36d", payload)
        pose = moved(pose, values[1:8])
        continue
    send(POSE, struct.pack("<q7d", number, *pose))
    track += payload[8:16] + struct.pack("<7d", *pose)
