"""Writes small glTF 2.0 models, each with something that importers get wrong, for the tests of the
mesh room: gltf_models.py OUT_DIR. The same files every time."""

import base64
import json
import pathlib
import struct
import sys

import numpy as np

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
DTYPES = {BYTE: np.int8, UBYTE: np.uint8, SHORT: np.int16, USHORT: np.uint16, UINT: np.uint32,
          FLOAT: np.float32}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Gltf:
    """A model that is being put together."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.json = {"asset": {"version": "2.0"}, "nodes": [], "meshes": [], "accessors": [],
                     "bufferViews": [], "buffers": []}
        self.bytes = b""

    def view(self, data, stride=None):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        view = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)}
        if stride:
            view["byteStride"] = stride
        self.bytes += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def describe(self, **accessor):
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def accessor(self, rows, component=FLOAT, normalized=False):
        rows = np.atleast_2d(np.asarray(rows, DTYPES[component]).T).T
        extra = {"normalized": True} if normalized else {}
        if rows.shape[1] == 3 and component == FLOAT:
            extra.update(min=rows.min(0).tolist(), max=rows.max(0).tolist())
        return self.describe(bufferView=self.view(rows.tobytes()), componentType=component,
                             count=len(rows), type=TYPES[rows.shape[1]], **extra)

    def node(self, parent=None, **node):
        self.json["nodes"].append(node)
        index = len(self.json["nodes"]) - 1
        if parent is not None:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def mesh(self, *primitives):
        self.json["meshes"].append({"primitives": list(primitives)})
        return len(self.json["meshes"]) - 1

    def skin(self, joints, inverse_bind=None):
        skin = {"joints": joints}
        if inverse_bind is not None:  # stored by columns
            columns = np.array([matrix.T.reshape(16) for matrix in inverse_bind])
            skin["inverseBindMatrices"] = self.accessor(columns)
        self.json.setdefault("skins", []).append(skin)
        return len(self.json["skins"]) - 1

    def animate(self, name, *channels):
        """Channels are (node, path, times, values, interpolation)."""
        animation = {"name": name, "channels": [], "samplers": []}
        for node, path, times, values, interpolation in channels:
            output = values if isinstance(values, int) else self.accessor(values)
            animation["samplers"].append({"input": self.accessor(times), "output": output,
                                          "interpolation": interpolation})
            animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                          "target": {"node": node, "path": path}})
        self.json.setdefault("animations", []).append(animation)

    def show(self, *roots):
        self.json.update(scene=0, scenes=[{"nodes": list(roots)}])

    def turns(self, count):
        q = self.random.normal(size=(count, 4))
        return q / np.linalg.norm(q, axis=1, keepdims=True)

    def triangles(self, rows=6):
        """Loose triangles in a box of about a metre."""
        points = self.random.uniform(-0.5, 0.5, (3 * rows, 3))
        return {"attributes": {"POSITION": self.accessor(points)}}

    def skinned(self, joints, rows=6):
        primitive = self.triangles(rows)
        count = 3 * rows
        weights = self.random.uniform(0.05, 1, (count, 4))
        weights /= weights.sum(1, keepdims=True)
        primitive["attributes"]["JOINTS_0"] = self.accessor(
            self.random.integers(0, joints, (count, 4)), UBYTE)
        primitive["attributes"]["WEIGHTS_0"] = self.accessor(weights)
        return primitive

    def chain(self, length, names=None):
        """Nodes below one another, and matrices from the model into each."""
        nodes, frame, inverse = [], np.eye(4), []
        for i in range(length):
            step = self.random.uniform(0.1, 0.6, 3)
            frame = frame @ translation(step)
            extra = {"name": names[i]} if names else {}
            nodes.append(self.node(nodes[-1] if nodes else None, translation=step.tolist(), **extra))
            inverse.append(np.linalg.inv(frame))
        return nodes, inverse

    def turning(self, node, keys=4, interpolation="LINEAR"):
        return (node, "rotation", np.linspace(0, 1.5, keys), self.turns(keys), interpolation)

    def glb(self):
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        binary = self.bytes + b"\0" * (-len(self.bytes) % 4)
        return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text),
                            0x4E4F534A) + text
                + struct.pack("<II", len(binary), 0x004E4942) + binary)


def translation(step):
    matrix = np.eye(4)
    matrix[:3, 3] = step
    return matrix


def same_names(g):
    """Eight nodes of one name, rigid parts and joints among them."""
    nodes, inverse = g.chain(8, ["arm"] * 8)
    for node in nodes[::2]:
        g.json["nodes"][node]["mesh"] = g.mesh(g.triangles())
    body = g.node(name="arm", mesh=g.mesh(g.skinned(8)), skin=g.skin(nodes, inverse))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], body)


def unnamed(g):
    nodes, inverse = g.chain(4)
    body = g.node(mesh=g.mesh(g.skinned(4)), skin=g.skin(nodes, inverse))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], body)


def shared_joints(g):
    """Two skins over the same joints, in another order and bound elsewhere."""
    nodes, inverse = g.chain(4, ["a", "b", "a", "b"])
    moved = [matrix @ translation([0.3, -0.2, 0.1]) for matrix in reversed(inverse)]
    first = g.node(mesh=g.mesh(g.skinned(4)), skin=g.skin(nodes, inverse))
    second = g.node(mesh=g.mesh(g.skinned(4)), skin=g.skin(nodes[::-1], moved))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], first, second)


def primitives(g):
    """One mesh of several primitives: indexed, strip, fan, points."""
    indexed = g.triangles()
    indexed["indices"] = g.accessor(g.random.permutation(18), UBYTE)
    strip, fan, points = g.triangles(), g.triangles(), g.triangles()
    strip.update(mode=5, indices=g.accessor(np.arange(18), UINT))
    fan.update(mode=6, indices=g.accessor(np.arange(18), USHORT))
    points.update(mode=0)
    top = g.node()
    node = g.node(top, mesh=g.mesh(indexed, points, strip, fan))
    g.animate("move", g.turning(node), g.turning(top))
    g.show(top)


def stretched(g):
    """Scales that differ by axis, one below another, at rest and moving."""
    top = g.node(scale=[2, 0.5, 1], rotation=g.turns(1)[0].tolist())
    below = g.node(top, scale=[0.3, 1, 4], translation=[0.2, 1, 0],
                   rotation=g.turns(1)[0].tolist(), mesh=g.mesh(g.triangles()))
    g.animate("move", (below, "scale", [0, 1, 2], g.random.uniform(0.2, 3, (3, 3)), "LINEAR"),
              g.turning(top))
    g.show(top)


def mirrored(g):
    """One and three mirrored axes, with rotations that a matrix would share out otherwise."""
    nodes, inverse = g.chain(3)
    g.json["nodes"][nodes[0]].update(scale=[-1, 1, 1], rotation=g.turns(1)[0].tolist())
    g.json["nodes"][nodes[1]].update(scale=[-2, -1, -0.5], mesh=g.mesh(g.triangles()))
    body = g.node(mesh=g.mesh(g.skinned(3)), skin=g.skin(nodes, inverse))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], body)


def animations(g):
    """Several clips that move different things; one ends early, one begins late."""
    nodes, inverse = g.chain(4, ["n"] * 4)
    body = g.node(mesh=g.mesh(g.skinned(4)), skin=g.skin(nodes, inverse))
    g.animate("turn", g.turning(nodes[0]), g.turning(nodes[2], 7))
    g.animate("slide", (nodes[1], "translation", [0.4, 0.9], g.random.normal(size=(2, 3)), "LINEAR"))
    g.animate("turn", g.turning(nodes[3]), (nodes[3], "scale", [0, 0.5], [[1, 1, 1], [2, 1, 1]],
                                            "LINEAR"))
    g.show(nodes[0], body)


def stepped(g):
    nodes, inverse = g.chain(3)
    body = g.node(mesh=g.mesh(g.skinned(3)), skin=g.skin(nodes, inverse))
    g.animate("move", *[g.turning(node, 5, "STEP") for node in nodes],
              (nodes[1], "translation", [0, 0.7, 1.5], g.random.normal(size=(3, 3)), "STEP"))
    g.show(nodes[0], body)


def splines(g):
    nodes, inverse = g.chain(3)
    body = g.node(mesh=g.mesh(g.skinned(3)), skin=g.skin(nodes, inverse))
    turns = g.random.normal(0, 0.4, (12, 4))
    turns[1::3] = g.turns(4)
    g.animate("move",
              (nodes[0], "rotation", [0, 0.5, 0.9, 1.5], turns, "CUBICSPLINE"),
              (nodes[1], "translation", [0, 0.6, 1.4], g.random.normal(size=(9, 3)), "CUBICSPLINE"),
              (nodes[2], "scale", [0.2, 1.5], g.random.uniform(0.5, 2, (6, 3)), "CUBICSPLINE"))
    g.show(nodes[0], body)


def sparse(g):
    """Positions that a sparse accessor changes, over a view and over nothing."""
    nodes = []
    for over_nothing in (False, True):
        base = g.triangles()
        accessor = g.json["accessors"][base["attributes"]["POSITION"]]
        if over_nothing:
            del accessor["bufferView"]
        places = np.array([1, 4, 5, 9, 17], np.uint16)
        values = g.random.uniform(-1, 1, (5, 3)).astype(np.float32)
        accessor["sparse"] = {
            "count": 5,
            "indices": {"bufferView": g.view(places.tobytes()), "componentType": USHORT},
            "values": {"bufferView": g.view(values.tobytes())}}
        nodes.append(g.node(mesh=g.mesh(base)))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(*nodes)


def no_inverse_bind(g):
    nodes, _ = g.chain(3)
    body = g.node(mesh=g.mesh(g.skinned(3)), skin=g.skin(nodes))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], body)


def two_roots(g):
    """Two roots of one name; the joints hang below one, the mesh that follows them below the
    other, which moves and must not matter. A third root is not in the scene."""
    nodes, inverse = g.chain(3)
    other = g.node(name="root", translation=[3, 2, 1], mesh=g.mesh(g.triangles()))
    g.json["nodes"][nodes[0]]["name"] = "root"
    g.node(other, name="root", scale=[2, 2, 2], mesh=g.mesh(g.skinned(3)),
           skin=g.skin(nodes, inverse))
    hidden = g.node(name="root", mesh=g.mesh(g.triangles()))
    g.animate("move", g.turning(hidden, 9), g.turning(other), *[g.turning(node) for node in nodes])
    g.show(nodes[0], other)


def matrices(g):
    """Nodes that are written as matrices, one of them mirrored."""
    top = g.node(matrix=[0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1])
    left = g.node(top, matrix=[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0, 1, 0, 1],
                  mesh=g.mesh(g.triangles()))
    turned = g.node(left, rotation=[0, 0, 0, 1], mesh=g.mesh(g.triangles()))
    g.animate("move", g.turning(turned))
    g.show(top)


def quantized(g):
    """Interleaved shorts, weights and rotations as whole numbers."""
    nodes, inverse = g.chain(3)
    count = 18
    rows = np.zeros(count, np.dtype([("p", np.int16, 3), ("pad", np.int16), ("j", np.uint8, 4),
                                     ("w", np.uint8, 4)]))
    rows["p"] = g.random.integers(-32767, 32768, (count, 3))
    rows["j"] = g.random.integers(0, 3, (count, 4))
    rows["w"] = g.random.integers(1, 63, (count, 4))
    rows["w"][:, 0] += (255 - rows["w"].astype(int).sum(1)).astype(np.uint8)
    view = g.view(rows.tobytes(), stride=16)

    def column(offset, component, kind, normalized):
        return g.describe(bufferView=view, byteOffset=offset, componentType=component, count=count,
                          type=kind, normalized=normalized)

    body = g.node(skin=g.skin(nodes, inverse), mesh=g.mesh({"attributes": {
        "POSITION": column(0, SHORT, "VEC3", True), "JOINTS_0": column(8, UBYTE, "VEC4", False),
        "WEIGHTS_0": column(12, UBYTE, "VEC4", True)}}))
    turns = g.accessor(np.round(g.turns(4) * 32767), SHORT, normalized=True)
    g.animate("move", (nodes[1], "rotation", np.linspace(0, 1.5, 4), turns, "LINEAR"),
              g.turning(nodes[0]))
    g.json.update(extensionsUsed=["KHR_mesh_quantization"],
                  extensionsRequired=["KHR_mesh_quantization"])
    g.show(nodes[0], body)


def instances(g):
    """One mesh shown by three nodes: rigid, under another skin, and unscaled."""
    nodes, inverse = g.chain(3)
    mesh = g.mesh(g.skinned(3))
    shown = [g.node(mesh=mesh, translation=[2, 0, 0], scale=[1, 2, 1]),
             g.node(mesh=mesh, skin=g.skin(nodes, inverse), rotation=g.turns(1)[0].tolist()),
             g.node(mesh=mesh, skin=g.skin(nodes[::-1], inverse))]
    g.animate("move", *[g.turning(node) for node in nodes + shown])
    g.show(nodes[0], *shown)


def loose_weights(g):
    """Weights that sum to 0.6 to 1.7; a joint twice at one vertex."""
    nodes, inverse = g.chain(3)
    primitive = g.skinned(3)
    weights = g.random.uniform(0.15, 0.42, (18, 4))
    weights[5] = [0.7, 0, 0, 0]
    primitive["attributes"]["WEIGHTS_0"] = g.accessor(weights)
    body = g.node(mesh=g.mesh(primitive), skin=g.skin(nodes, inverse))
    g.animate("move", *[g.turning(node) for node in nodes])
    g.show(nodes[0], body)


def no_scene(g):
    """No scene is named: all roots are shown."""
    top = g.node(mesh=g.mesh(g.triangles()), translation=[1, 0, 0])
    g.node(mesh=g.mesh(g.triangles()), translation=[-1, 0, 0])
    g.animate("move", g.turning(top))


MODELS = [same_names, unnamed, shared_joints, primitives, stretched, mirrored, animations, stepped,
          splines, sparse, no_inverse_bind, two_roots, matrices, quantized, instances,
          loose_weights, no_scene]


def main(out_dir):
    folder = pathlib.Path(out_dir)
    for seed, make in enumerate(MODELS):
        model = Gltf(seed)
        make(model)
        (folder / (make.__name__ + ".glb")).write_bytes(model.glb())
    for name, make in (("text_inline", same_names), ("text_beside", splines)):  # as .gltf
        model = Gltf(99)
        make(model)
        uri = "data:application/octet-stream;base64," + base64.b64encode(model.bytes).decode()
        if name == "text_beside":
            uri = "text%20beside.bin"
            (folder / "text beside.bin").write_bytes(model.bytes)
        model.json["buffers"] = [{"byteLength": len(model.bytes), "uri": uri}]
        (folder / (name + ".gltf")).write_text(json.dumps(model.json))


if __name__ == "__main__":
    main(*sys.argv[1:])
