"""Reads exported datasets apart from the program that wrote them: struct, zlib and numpy alone."""

import json
import pathlib
import struct
import zlib

import numpy as np


def read_pfm(path):
    """Rows from the top down, float32; (height, width) or (height, width, 3), channels as filed."""
    data = pathlib.Path(path).read_bytes()
    kind, size, scale, body = data.split(b"\n", 3)
    channels = {b"Pf": 1, b"PF": 3}[kind]
    width, height = map(int, size.split())
    order = "<f4" if float(scale) < 0 else ">f4"
    assert len(body) == 4 * channels * width * height, path
    rows = np.frombuffer(body, order).reshape(height, width, channels)[::-1].astype(np.float32)
    return rows[:, :, 0] if channels == 1 else rows


def read_flo(path):
    """(height, width, 2) float32, NaN where Middlebury's file says unknown."""
    data = pathlib.Path(path).read_bytes()
    tag, width, height = struct.unpack_from("<fii", data)
    assert tag == np.float32(202021.25), path
    assert len(data) == 12 + 8 * width * height, path
    flow = np.frombuffer(data, "<f4", offset=12).reshape(height, width, 2).copy()
    flow[np.abs(flow).max(axis=2) > 1e9] = np.nan
    return flow


def _unfilter(kind, row, before, step):
    """One row of a PNG, see its specification, 9.2; `step` is the bytes of a pixel."""
    if kind == 0:
        return row
    if kind == 1:
        return np.cumsum(row.reshape(-1, step).astype(np.int64), axis=0).astype(np.uint8).ravel()
    if kind == 2:
        return row + before
    out = np.zeros_like(row)
    for i in range(len(row)):
        a = int(out[i - step]) if i >= step else 0
        b, c = int(before[i]), int(before[i - step]) if i >= step else 0
        if kind == 3:
            guess = (a + b) // 2
        else:
            p = a + b - c
            guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        out[i] = (int(row[i]) + guess) & 255
    return out


def read_colour_png(path):
    """(height, width, 3), uint8, in the order red, green, blue."""
    return _read_png(path, colour=2)


def read_grey_png(path):
    """(height, width), uint8 or uint16."""
    return _read_png(path, colour=0)


def _read_png(path, colour):
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, packed, header = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + size]
        check, = struct.unpack_from(">I", data, at + 8 + size)
        assert check == zlib.crc32(kind + body), path
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    width, height, depth, kind, _, _, interlaced = header
    assert depth in (8, 16) and kind == colour and interlaced == 0, (path, header)
    assert colour == 0 or depth == 8, (path, header)
    step = 3 if colour == 2 else depth // 8
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + step * width)
    before, rows = np.zeros(step * width, np.uint8), []
    for line in lines:
        before = _unfilter(line[0], line[1:], before, step)
        rows.append(before)
    if colour == 2:
        return np.array(rows).reshape(height, width, 3)
    return np.array(rows).view(">u2" if step == 2 else np.uint8).astype(
        np.uint16 if step == 2 else np.uint8)


def rotation(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def _pose(position, quaternion_xyzw):
    pose = np.eye(4)
    pose[:3, :3] = rotation(*quaternion_xyzw)
    pose[:3, 3] = position
    return pose


def _rows(path, separator=None):
    lines = pathlib.Path(path).read_text().splitlines()
    return [line.split(separator) for line in lines if line and not line.startswith("#")]


def _nanoseconds(seconds):
    whole, part = seconds.split(".")
    assert len(part) == 9, seconds
    return int(whole) * 10**9 + int(part)


class Dataset:
    """Frames in order: names (of images and truth), stamps_ns, left and right image files, and
    poses, 4 x 4, of the left camera in the world. Camera: fx, fy, cx, cy, baseline."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.about = json.loads((self.folder / "aisle.json").read_text())
        self.format = self.about["format"]
        getattr(self, "_read_" + self.format)()
        to_world = np.array(self.about["T_world_poses"]).reshape(4, 4)
        self.poses = [to_world @ pose for pose in self.poses]
        self.scene_frames = [self.about["first_frame"] + i for i in range(len(self.names))]
        self.scene_stamps_ns = [s - self.about["stamp_offset_ns"] for s in self.stamps_ns]

    def _read_euroc(self):
        mav = self.folder / "mav0"
        rows = _rows(mav / "cam0/data.csv", ",")
        assert rows == _rows(mav / "cam1/data.csv", ",")
        self.names = [row[1][:-4] for row in rows]
        self.stamps_ns = [int(row[0]) for row in rows]
        self.left = [mav / "cam0/data" / row[1] for row in rows]
        self.right = [mav / "cam1/data" / row[1] for row in rows]
        truth = _rows(mav / "state_groundtruth_estimate0/data.csv", ",")
        assert [int(row[0]) for row in truth] == self.stamps_ns
        numbers = [list(map(float, row[1:8])) for row in truth]
        self.poses = [_pose(n[:3], n[4:7] + n[3:4]) for n in numbers]
        sensor = (mav / "cam0/sensor.yaml").read_text()
        values = sensor.split("intrinsics: [")[1].split("]")[0].split(",")
        self.fx, self.fy, self.cx, self.cy = map(float, values)
        other = (mav / "cam1/sensor.yaml").read_text().split("data: [")[1].split("]")[0]
        self.baseline = float(other.split(",")[3])

    def _read_kitti(self):
        sequence = self.folder / "sequences/00"
        self.stamps_ns = [_nanoseconds(row[0]) for row in _rows(sequence / "times.txt")]
        poses = [list(map(float, row)) for row in _rows(self.folder / "poses/00.txt")]
        self.poses = [np.vstack([np.reshape(p, (3, 4)), [0, 0, 0, 1]]) for p in poses]
        # As its readers do: image i is named by i, and row i is its pose and its time.
        self.names = ["%06d" % i for i in range(len(list((sequence / "image_0").iterdir())))]
        self.left = [sequence / "image_0" / (name + ".png") for name in self.names]
        self.right = [sequence / "image_1" / (name + ".png") for name in self.names]
        rows = {row[0]: list(map(float, row[1:])) for row in _rows(sequence / "calib.txt")}
        p0 = rows["P0:"]
        self.fx, self.fy, self.cx, self.cy = p0[0], p0[5], p0[2], p0[6]
        self.baseline = -rows["P1:"][3] / p0[0]

    def _read_tum(self):
        rows = _rows(self.folder / "rgb.txt")
        self.stamps_ns = [_nanoseconds(row[0]) for row in rows]
        self.names = [row[1].split("/")[1][:-4] for row in rows]
        self.left = [self.folder / row[1] for row in rows]
        self.right = [self.folder / row[1] for row in _rows(self.folder / "right.txt")]
        self.depth_png = [self.folder / row[1] for row in _rows(self.folder / "depth.txt")]
        truth = _rows(self.folder / "groundtruth.txt")
        assert [_nanoseconds(row[0]) for row in truth] == self.stamps_ns
        self.poses = [_pose(n[:3], n[3:]) for n in [list(map(float, r[1:])) for r in truth]]
        numbers = list(map(float, _rows(self.folder / "calibration.txt")[0]))
        self.fx, self.fy, self.cx, self.cy, self.baseline = numbers[:5]

    def truth(self, kind, i):
        """The truth of a kind of frame i."""
        endings = {".pfm": read_pfm, ".flo": read_flo, ".png": read_grey_png,
                   ".json": lambda path: json.loads(path.read_text())}
        for ending, read in endings.items():
            path = self.folder / "truth" / kind / (self.names[i] + ending)
            if path.exists():
                return read(path)
        raise FileNotFoundError(f"{self.folder}/truth/{kind}/{self.names[i]}.*")
