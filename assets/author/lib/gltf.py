"""Reads .glb files and evaluates their skins with numpy alone, the way a simulator does."""

import json
import struct

import numpy as np

KINDS = {
    5120: np.int8,
    5121: np.uint8,
    5122: np.int16,
    5123: np.uint16,
    5125: np.uint32,
    5126: np.float32,
}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
# glTF is y up; the simulator's world is z up: (x, y, z) -> (x, -z, y).
TO_Z_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)


class Glb:
    """One file: its json, accessors, node poses and skinned vertices."""

    def __init__(self, path):
        with open(path, "rb") as f:
            data = f.read()
        magic, version, _ = struct.unpack("<4sII", data[:12])
        if magic != b"glTF" or version != 2:
            raise ValueError(f"{path}: not a binary glTF 2.0 file")
        (length,) = struct.unpack("<I", data[12:16])
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[20 + length + 8 :]
        nodes = self.json["nodes"]
        self.known = {}  # channels of clips, read once
        self.parent = [-1] * len(nodes)
        for i, node in enumerate(nodes):
            for child in node.get("children", []):
                self.parent[child] = i

    def read(self, accessor):
        """Array (count, width) of an accessor."""
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        kind, width = KINDS[a["componentType"]], WIDTH[a["type"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        flat = np.frombuffer(self.binary, kind, a["count"] * width, start)
        return flat.reshape(-1, width)

    def clips(self):
        return {a["name"]: a for a in self.json.get("animations", [])}

    def duration(self, clip):
        a = self.clips()[clip]
        return max(float(self.read(s["input"])[-1, 0]) for s in a["samplers"])

    def channels(self, clip):
        """(node, path, times, values) of everything the clip moves."""
        if clip not in self.known:
            a = self.clips()[clip]
            self.known[clip] = [
                (
                    c["target"]["node"],
                    c["target"]["path"],
                    self.read(a["samplers"][c["sampler"]]["input"])[:, 0],
                    self.read(a["samplers"][c["sampler"]]["output"]).astype(float),
                )
                for c in a["channels"]
            ]
        return self.known[clip]

    def node_matrices(self, clip=None, seconds=0.0):
        """World matrix of every node, z up, with a clip applied at a time."""
        moved = {}
        if clip:
            for node, path, times, values in self.channels(clip):
                i = int(np.searchsorted(times, seconds, "right")) - 1
                i = min(max(i, 0), max(len(times) - 2, 0))
                j = min(i + 1, len(times) - 1)
                t = 0.0
                if i != j:
                    t = min(max((seconds - times[i]) / (times[j] - times[i]), 0.0), 1.0)
                x, y = values[i], values[j]
                if path == "rotation":
                    y = y if x @ y >= 0 else -y
                    value = x * (1 - t) + y * t
                    value = value / np.sqrt(value @ value)
                else:
                    value = x * (1 - t) + y * t
                moved[node, path] = value
        local = [self._local(i, moved) for i in range(len(self.parent))]
        world = {}

        def solve(i):
            if i not in world:
                up = TO_Z_UP if self.parent[i] < 0 else solve(self.parent[i])
                world[i] = up @ local[i]
            return world[i]

        return [solve(i) for i in range(len(local))]

    def _local(self, i, moved):
        node = self.json["nodes"][i]
        if "matrix" in node:
            return np.array(node["matrix"], float).reshape(4, 4).T
        t = moved.get((i, "translation"), np.array(node.get("translation", [0, 0, 0]), float))
        q = moved.get((i, "rotation"), np.array(node.get("rotation", [0, 0, 0, 1]), float))
        s = moved.get((i, "scale"), np.array(node.get("scale", [1, 1, 1]), float))
        x, y, z, w = q
        r = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
        m = np.eye(4)
        m[:3, :3], m[:3, 3] = r * s, t
        return m

    def facts(self):
        """What the author wrote about the asset: the extras "aisle" of its nodes, together."""
        facts = {}
        for node in self.json["nodes"]:
            facts.update(node.get("extras", {}).get("aisle", {}))
        return facts

    def triangles(self):
        return sum(
            self.json["accessors"][p["indices"]]["count"] // 3
            for node in self.json["nodes"]
            if "mesh" in node
            for p in self.json["meshes"][node["mesh"]]["primitives"]
        )

    def vertices(self, clip=None, seconds=0.0, only=None):
        """Vertices in the object's frame (z up), skinned where the node has a skin.

        only picks rows, counted through all primitives in turn, to save time.
        """
        world, out, start = self.node_matrices(clip, seconds), [], 0
        for i, node in enumerate(self.json["nodes"]):
            if "mesh" not in node:
                continue
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                count = self.json["accessors"][attributes["POSITION"]]["count"]
                rows = slice(None)
                if only is not None:
                    rows = only[(only >= start) & (only < start + count)] - start
                    start += count
                    if not len(rows):
                        continue
                p = self.read(attributes["POSITION"])[rows].astype(float)
                p = np.hstack([p, np.ones((len(p), 1))])
                if "skin" not in node:
                    out.append((p @ world[i].T)[:, :3])
                    continue
                skin = self.json["skins"][node["skin"]]
                inverse = self.read(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4)
                bones = np.stack([world[j] for j in skin["joints"]]) @ inverse.transpose(0, 2, 1)
                joints = self.read(attributes["JOINTS_0"])[rows].astype(int)
                w = self.read(attributes["WEIGHTS_0"])[rows].astype(float)
                w = w / w.sum(1, keepdims=True)
                blend = np.einsum("vk,vkij->vij", w, bones[joints])
                out.append(np.einsum("vij,vj->vi", blend, p)[:, :3])
        return np.concatenate(out)

    def track(self, clip, times, only):
        """Vertices `only` (rows through all primitives in turn) at all times: (T, N, 3), z up."""
        moved = {(n, path): interpolated(at, v, times, path) for n, path, at, v in self.channels(clip)}
        world, out, start = {}, [], 0

        def solve(i):
            if i not in world:
                up = TO_Z_UP[None] if self.parent[i] < 0 else solve(self.parent[i])
                world[i] = up @ self._locals(i, moved)
            return world[i]

        for node in (n for n in self.json["nodes"] if "mesh" in n):
            skin = self.json["skins"][node["skin"]]
            inverse = self.read(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4)
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                p = self.read(attributes["POSITION"])
                rows = only[(only >= start) & (only < start + len(p))] - start
                start += len(p)
                if not len(rows):
                    continue
                p = np.hstack([p[rows].astype(float), np.ones((len(rows), 1))])
                joints = self.read(attributes["JOINTS_0"])[rows].astype(int)
                w = self.read(attributes["WEIGHTS_0"])[rows].astype(float)
                w = w / w.sum(1, keepdims=True)
                total = np.zeros((len(times), len(rows), 3))
                for j in np.unique(joints[w > 0]):
                    share = np.where(joints == j, w, 0.0).sum(1)
                    mine = share > 0
                    bone = solve(skin["joints"][j]) @ inverse[j].T
                    placed = np.einsum("tij,vj->tvi", bone[:, :3], p[mine])
                    total[:, mine] += share[mine][:, None] * placed
                out.append(total)
        return np.concatenate(out, 1)

    def _locals(self, i, moved):
        """Local matrices (T or 1, 4, 4) of a node."""
        node = self.json["nodes"][i]
        part = lambda path, rest: moved.get((i, path), np.array([node.get(path, rest)], float))
        t, q, s = part("translation", [0, 0, 0]), part("rotation", [0, 0, 0, 1]), part("scale", [1, 1, 1])
        x, y, z, w = q.T
        r = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ).transpose(2, 0, 1)
        m = np.tile(np.eye(4), (max(len(t), len(q), len(s)), 1, 1))
        m[:, :3, :3], m[:, :3, 3] = r * s[:, None], t
        return m

    def bounds(self, clip=None):
        v = self.vertices(clip)
        return v.min(0), v.max(0)


def interpolated(at, values, times, path):
    """A channel's values at times, linear; rotations are normalised."""
    if len(at) == 1:
        return values[:1]
    i = np.clip(np.searchsorted(at, times, "right") - 1, 0, len(at) - 2)
    t = np.clip((times - at[i]) / (at[i + 1] - at[i]), 0, 1)[:, None]
    x, y = values[i], values[i + 1]
    if path == "rotation":
        y = np.where((x * y).sum(1, keepdims=True) >= 0, y, -y)
    out = x * (1 - t) + y * t
    return out / np.linalg.norm(out, axis=1, keepdims=True) if path == "rotation" else out
