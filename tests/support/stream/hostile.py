"""A system behind aisle's stream that misbehaves: hostile.py WAY [FRAME].

die, exit, leave, word, stall, dribble, twice, ahead, text, nan, far, shear, huge, gigabytes, wrong,
type, short, mute, version, flood, ok; after its final track: abort, code, linger, wait
"""

import os
import struct
import sys
import time

WAY = sys.argv[1]
AT = int(sys.argv[2]) if len(sys.argv) > 2 else 3
HELLO, FRAME, POSE, LOST, END, TRACK = range(1, 7)
IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def receive():
    length, kind = struct.unpack("<II", sys.stdin.buffer.read(8))
    return kind, sys.stdin.buffer.read(length)


def send(kind, payload):
    os.write(1, struct.pack("<II", len(payload), kind) + payload)


def misbehave(number):
    nan = float("nan")
    if WAY == "die":
        os.kill(os.getpid(), 11)
    if WAY == "exit":
        sys.exit("Error: no more memory for dreams")
    if WAY == "leave":
        sys.exit(0)
    if WAY == "word":
        print("hi", flush=True)
        sys.exit(0)
    if WAY == "stall":
        time.sleep(3600)
    if WAY == "dribble":
        os.write(1, struct.pack("<II", 64 << 20, POSE))
        while True:
            os.write(1, b"\x01")
            time.sleep(0.02)
    if WAY == "text":
        print("frame 3 tracked", flush=True)
    if WAY == "ahead":
        poses = [struct.pack("<q7d", number + k, *IDENTITY) for k in range(5)]
        os.write(1, b"".join(struct.pack("<II", len(pose), POSE) + pose for pose in poses))
        while True:
            receive()
    if WAY == "twice":
        send(POSE, struct.pack("<q7d", number, *IDENTITY))
    if WAY == "nan":
        send(POSE, struct.pack("<q7d", number, nan, *IDENTITY[1:]))
    if WAY == "far":
        send(POSE, struct.pack("<q7d", number, (-1) ** number * 1e308, *IDENTITY[1:]))
    if WAY == "shear":
        send(POSE, struct.pack("<q7d", number, 0, 0, 0, 3.0, 0, 0, 1.0))
    if WAY == "huge":
        os.write(1, struct.pack("<II", 0xFFFFFFFF, POSE))
    if WAY == "gigabytes":
        block = b"\x01" * (1 << 20)
        for _ in range(8 << 10):
            os.write(1, block)
    if WAY == "wrong":
        send(POSE, struct.pack("<q7d", number + 7, *IDENTITY))
    if WAY == "type":
        send(77, b"")
    if WAY == "short":
        send(POSE, struct.pack("<q", number))
    if WAY == "flood":
        for _ in range(20000):
            os.write(2, b"x" * 99 + b"\n")


receive()
if WAY == "mute":
    time.sleep(3600)
send(HELLO, struct.pack("<I", 9 if WAY == "version" else 1) + b"hostile")
while True:
    kind, payload = receive()
    if kind == END:
        send(TRACK, b"")
        if WAY == "abort":
            os.abort()
        if WAY == "code":
            sys.exit("ERROR: LeakSanitizer: detected memory leaks")
        if WAY == "linger":
            time.sleep(3600)
        if WAY == "wait":
            sys.stdin.buffer.read()
        break
    number = struct.unpack("<q", payload[:8])[0]
    if number == AT:
        misbehave(number)
    send(POSE, struct.pack("<q7d", number, *IDENTITY))
