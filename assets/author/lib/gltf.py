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

    def node_matrices(self, clip=None, seconds=0.0):
        """World matrix of every node, z up, with a clip applied at a time."""
        moved = {}
        if clip:
            a = self.clips()[clip]
            for channel in a["channels"]:
                s = a["samplers"][channel["sampler"]]
                times, values = self.read(s["input"])[:, 0], self.read(s["output"])
                i = int(
                    np.clip(np.searchsorted(times, seconds, "right") - 1, 0, max(len(times) - 2, 0))
                )
                j = min(i + 1, len(times) - 1)
                t = 0.0 if i == j else np.clip((seconds - times[i]) / (times[j] - times[i]), 0, 1)
                x, y = values[i].astype(float), values[j].astype(float)
                if channel["target"]["path"] == "rotation":
                    y = y if x @ y >= 0 else -y
                    value = x * (1 - t) + y * t
                    value = value / np.linalg.norm(value)
                else:
                    value = x * (1 - t) + y * t
                moved[channel["target"]["node"], channel["target"]["path"]] = value
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
                bones = np.stack([world[j] @ m.T for j, m in zip(skin["joints"], inverse)])
                joints = self.read(attributes["JOINTS_0"])[rows].astype(int)
                w = self.read(attributes["WEIGHTS_0"])[rows].astype(float)
                w = w / w.sum(1, keepdims=True)
                blend = np.einsum("vk,vkij->vij", w, bones[joints])
                out.append(np.einsum("vij,vj->vi", blend, p)[:, :3])
        return np.concatenate(out)

    def bounds(self, clip=None):
        v = self.vertices(clip)
        return v.min(0), v.max(0)
