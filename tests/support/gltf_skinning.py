"""Where the vertices of a glTF 2.0 model are: a plain evaluator, written from the specification and
independent of the importer it is held against. Reads the file's bytes with struct and json; sums in
double precision; uses no names.

    gltf_skinning.py OUT_DIR FILE...

writes OUT_DIR/STEM.poses for each file: the rest pose (clip -1) and every clip at three times. Each
pose is int32 clip, float64 time, int32 count, then count vertices of three float64, in the order of
the scene's nodes (parents first), their primitives and these primitives' vertices, y up as stored.
"""

import base64
import json
import pathlib
import struct
import sys
import urllib.parse

import numpy as np

SHARES = (0.13, 0.5, 0.77)
DTYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
          5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Document:
    def __init__(self, path):
        data = path.read_bytes()
        binary = None
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            if len(data) > 20 + size:
                length = struct.unpack_from("<I", data, 20 + size)[0]
                binary = data[28 + size:28 + size + length]
        else:
            self.json = json.loads(data)
        self.buffers = []
        for buffer in self.json.get("buffers", []):
            uri = buffer.get("uri")
            if uri is None:
                self.buffers.append(binary)
            elif uri.startswith("data:"):
                self.buffers.append(base64.b64decode(uri.split(",", 1)[1]))
            else:
                self.buffers.append((path.parent / urllib.parse.unquote(uri)).read_bytes())

    def list(self, key):
        return self.json.get(key, [])

    def elements(self, view_index, offset, component, width, count):
        """Rows of a buffer view, stride heeded."""
        view = self.json["bufferViews"][view_index]
        dtype = np.dtype(DTYPES[component])
        stride = view.get("byteStride", dtype.itemsize * width)
        start = view.get("byteOffset", 0) + offset
        rows = np.empty((count, width), dtype)
        data = self.buffers[view["buffer"]]
        for k in range(width):
            rows[:, k] = np.ndarray((count,), dtype, data, start + k * dtype.itemsize, (stride,))
        return rows

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        component, width = accessor["componentType"], WIDTHS[accessor["type"]]
        count = accessor["count"]
        if "bufferView" in accessor:
            rows = self.elements(accessor["bufferView"], accessor.get("byteOffset", 0), component,
                                 width, count).copy()
        else:
            rows = np.zeros((count, width), DTYPES[component])
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            where, what = sparse["indices"], sparse["values"]
            places = self.elements(where["bufferView"], where.get("byteOffset", 0),
                                   where["componentType"], 1, sparse["count"])[:, 0]
            rows[places] = self.elements(what["bufferView"], what.get("byteOffset", 0), component,
                                         width, sparse["count"])
        if accessor.get("normalized"):
            return np.maximum(rows / float(np.iinfo(DTYPES[component]).max), -1.0)
        return rows.astype(np.float64) if component == 5126 else rows


def rotation_matrix(q):
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def slerp(a, b, share):
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    cosine = a @ b
    if cosine < 0:
        b, cosine = -b, -cosine
    angle = np.arccos(min(cosine, 1.0))
    if angle < 1e-9:
        return a + share * (b - a)
    return (np.sin((1 - share) * angle) * a + np.sin(share * angle) * b) / np.sin(angle)


def sampled(document, sampler, path, time):
    times = document.accessor(sampler["input"])[:, 0]
    values = document.accessor(sampler["output"])
    cubic = sampler.get("interpolation") == "CUBICSPLINE"
    knots = values[1::3] if cubic else values
    if time <= times[0]:
        return knots[0]
    if time >= times[-1]:
        return knots[-1]
    k = int(np.searchsorted(times, time, side="right")) - 1
    span = times[k + 1] - times[k]
    t = (time - times[k]) / span
    if cubic:
        out_of, into = values[3 * k + 2], values[3 * (k + 1)]
        return ((2 * t**3 - 3 * t**2 + 1) * knots[k] + span * (t**3 - 2 * t**2 + t) * out_of
                + (3 * t**2 - 2 * t**3) * knots[k + 1] + span * (t**3 - t**2) * into)
    if sampler.get("interpolation") == "STEP":
        return knots[k]
    if path == "rotation":
        return slerp(knots[k], knots[k + 1], t)
    return (1 - t) * knots[k] + t * knots[k + 1]


def scene_nodes(document):
    """Indices of the shown nodes, parents first, and each node's parent."""
    nodes = document.list("nodes")
    parents = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}
    if document.list("scenes"):
        roots = document.list("scenes")[document.json.get("scene", 0)].get("nodes", [])
    else:
        roots = [i for i in range(len(nodes)) if i not in parents]
    order = []

    def visit(index):
        order.append(index)
        for child in nodes[index].get("children", []):
            visit(child)

    for root in roots:
        visit(root)
    return order, parents


def global_matrices(document, order, parents, clip, time):
    moved = {}
    if clip >= 0:
        animation = document.list("animations")[clip]
        for channel in animation["channels"]:
            target = channel["target"]
            sampler = animation["samplers"][channel["sampler"]]
            value = sampled(document, sampler, target["path"], time)
            moved.setdefault(target.get("node"), {})[target["path"]] = value
    frames = {}
    for index in order:
        node = document.list("nodes")[index]
        local = np.eye(4)
        if "matrix" in node:
            local = np.array(node["matrix"], float).reshape(4, 4).T
        else:
            pose = {key: np.array(node[key], float)
                    for key in ("translation", "rotation", "scale") if key in node}
            pose.update(moved.get(index, {}))
            local[:3, :3] = (rotation_matrix(pose.get("rotation", np.array([0, 0, 0, 1.0])))
                             * pose.get("scale", np.ones(3)))
            local[:3, 3] = pose.get("translation", np.zeros(3))
        frames[index] = frames[parents[index]] @ local if index in parents else local
    return frames


def primitive_vertices(document, node, primitive, frame, frames):
    attributes = primitive["attributes"]
    points = document.accessor(attributes["POSITION"]).astype(float)
    points = np.hstack([points, np.ones((len(points), 1))])
    if "skin" not in node or "JOINTS_0" not in attributes:
        return (points @ frame.T)[:, :3]
    skin = document.list("skins")[node["skin"]]
    joints = [frames[joint] for joint in skin["joints"]]
    if "inverseBindMatrices" in skin:
        inverse = document.accessor(skin["inverseBindMatrices"]).reshape(-1, 4, 4)
        joints = [joint @ bind.T for joint, bind in zip(joints, inverse)]
    followed = document.accessor(attributes["JOINTS_0"]).astype(int)
    weights = document.accessor(attributes["WEIGHTS_0"]).astype(float)
    weights = weights / weights.sum(axis=1, keepdims=True)
    blended = np.einsum("vk,vkij->vij", weights, np.array(joints)[followed])
    return np.einsum("vij,vj->vi", blended, points)[:, :3]


def vertices(document, clip, time):
    order, parents = scene_nodes(document)
    frames = global_matrices(document, order, parents, clip, time)
    parts = []
    for index in order:
        node = document.list("nodes")[index]
        if "mesh" not in node:
            continue
        for primitive in document.list("meshes")[node["mesh"]]["primitives"]:
            if primitive.get("mode", 4) >= 4:
                parts.append(primitive_vertices(document, node, primitive, frames[index], frames))
    return np.vstack(parts)


def duration(document, animation):
    shown = set(scene_nodes(document)[0])
    return max(document.accessor(animation["samplers"][channel["sampler"]]["input"])[-1, 0]
               for channel in animation["channels"] if channel["target"].get("node") in shown)


def main(out_dir, *files):
    for file in map(pathlib.Path, files):
        document = Document(file)
        poses = [(-1, 0.0)]
        for clip, animation in enumerate(document.list("animations")):
            poses += [(clip, share * duration(document, animation)) for share in SHARES]
        with open(pathlib.Path(out_dir) / (file.stem + ".poses"), "wb") as out:
            for clip, time in poses:
                points = vertices(document, clip, time)
                out.write(struct.pack("<idi", clip, time, len(points)))
                out.write(points.astype("<f8").tobytes())


if __name__ == "__main__":
    main(*sys.argv[1:])
