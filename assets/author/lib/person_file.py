"""Writes a skinned, animated person as binary glTF 2.0 with y up: (x, y, z) becomes (x, z, -y)."""

import json
import os
import struct

import numpy as np

from . import pose, rig

FLOAT, BYTE, SHORT, INT = 5126, 5121, 5123, 5125
Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


def quaternion(turn):
    """(x, y, z, w) of a rotation matrix in z-up axes, turned into y-up axes."""
    m = turn
    w = np.sqrt(max(0.0, 1 + m[0, 0] + m[1, 1] + m[2, 2])) / 2
    if w > 0.05:
        v = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / (4 * w)
    else:
        values, vectors = np.linalg.eigh((m + m.T) / 2)
        v = vectors[:, values.argmax()] * np.sqrt(max(0.0, 1 - w * w))
        sign = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) @ v
        v = v if sign >= 0 else -v
    q = np.append(Y_UP @ v, w)
    return q / np.linalg.norm(q)


def sampled(poses, frames):
    """A clip's keys: (pelvis positions (K, 3), bone -> quaternions (K, 4)), u = 0..1 in equal steps."""
    turns, places = {b: [] for b in rig.BONES}, []
    for i in range(frames + 1):
        p = poses(i / frames)
        if not all(np.isfinite(t).all() for t in p["turn"].values()):
            raise ValueError(f"frame {i} of a clip is not finite")
        places.append(Y_UP @ p["pelvis"])
        for bone, turn in pose.local_turns(p).items():
            q = quaternion(turn)
            if turns[bone] and q @ turns[bone][-1] < 0:
                q = -q
            turns[bone].append(q)
    return np.array(places), {b: np.array(q) for b, q in turns.items()}


class Buffer:
    """The binary chunk and what describes it."""

    def __init__(self):
        self.views, self.accessors, self.data = [], [], b""

    def view(self, raw, target=None):
        self.data += b"\0" * (-len(self.data) % 4)
        entry = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)}
        if target:
            entry["target"] = target
        self.views.append(entry)
        self.data += raw
        return len(self.views) - 1

    def add(self, array, kind, component, dtype, target=None, bounds=False, normalized=False):
        array = np.ascontiguousarray(array, dtype)
        entry = {
            "bufferView": self.view(array.tobytes(), target),
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if bounds:
            two = array.reshape(len(array), -1)
            entry["min"] = [float(x) for x in two.min(0)]
            entry["max"] = [float(x) for x in two.max(0)]
        if normalized:
            entry["normalized"] = True
        self.accessors.append(entry)
        return len(self.accessors) - 1


def primitive(buffer, v, n, uv, weights, triangles, corners, material):
    """One material's triangles with vertices of their own; corners (T, 3) index uv."""
    key = np.stack([triangles.ravel(), corners.ravel()], -1)
    unique, index = np.unique(key, axis=0, return_inverse=True)
    order = np.argsort(-weights, axis=1, kind="stable")[:, :4]
    share = np.take_along_axis(weights, order, 1)
    share = np.rint(65535 * share / share.sum(1, keepdims=True))
    share[:, 0] += 65535 - share.sum(1)
    at = unique[:, 0]
    return {
        "attributes": {
            "POSITION": buffer.add(v[at] @ Y_UP.T, "VEC3", FLOAT, np.float32, 34962, True),
            "NORMAL": buffer.add(n[at] @ Y_UP.T, "VEC3", FLOAT, np.float32, 34962),
            "TEXCOORD_0": buffer.add(uv[unique[:, 1]] * [1, -1] + [0, 1], "VEC2", FLOAT, np.float32, 34962),
            "JOINTS_0": buffer.add(order[at], "VEC4", BYTE, np.uint8, 34962),
            "WEIGHTS_0": buffer.add(share[at], "VEC4", SHORT, np.uint16, 34962, normalized=True),
        },
        "indices": buffer.add(index.ravel(), "SCALAR", SHORT if len(unique) < 65535 else INT, np.uint16 if len(unique) < 65535 else np.uint32, 34963),
        "material": material,
    }


def animation(buffer, name, places, turns, fps, nodes):
    """One clip; bones that keep still have a single key."""
    out = {"name": name, "channels": [], "samplers": []}
    times = buffer.add(np.arange(len(places)) / fps, "SCALAR", FLOAT, np.float32, bounds=True)
    first = buffer.add(np.zeros(1), "SCALAR", FLOAT, np.float32, bounds=True)

    def channel(bone, path, values, kind):
        still = np.abs(values - values[0]).max() < 1e-6
        rest = [0, 0, 0, 1] if path == "rotation" else values[0] + 1
        if still and np.abs(values[0] - rest).max() < 1e-6:
            return
        data = buffer.add(values[:1] if still else values, kind, FLOAT, np.float32)
        out["samplers"].append({"input": first if still else times, "interpolation": "LINEAR", "output": data})
        out["channels"].append({"sampler": len(out["samplers"]) - 1, "target": {"node": nodes[bone], "path": path}})

    channel("pelvis", "translation", places, "VEC3")
    for bone, values in turns.items():
        channel(bone, "rotation", values, "VEC4")
    return out


def write(path, name, figure, pictures, clips, fps, facts):
    """figure: {"v", "n", "uv" (C, 2), "weights", "t", "corners", "material", "finishes", "joint"};
    pictures: (colour, normal) JPEG bytes; clips: name -> sampled()."""
    buffer, bones = Buffer(), list(rig.BONES)
    nodes = {bone: i for i, bone in enumerate(bones)}
    joint = figure["joint"]
    tree = []
    for bone, (parent, head, _) in rig.BONES.items():
        at = joint[head] - (joint[rig.BONES[parent][1]] if parent else 0)
        entry = {"name": bone, "translation": [float(x) for x in Y_UP @ at]}
        children = [nodes[b] for b, (p, _, _) in rig.BONES.items() if p == bone]
        if children:
            entry["children"] = children
        tree.append(entry)
    tree.append({"name": name, "mesh": 0, "skin": 0})
    tree.append({"name": "skeleton", "children": [nodes["pelvis"], len(bones)], "extras": {"aisle": facts}})
    bind = np.tile(np.eye(4), (len(bones), 1, 1))
    bind[:, :3, 3] = [-(Y_UP @ joint[rig.BONES[b][1]]) for b in bones]
    primitives = []
    for m in range(len(figure["finishes"])):
        mine = figure["material"] == m
        primitives.append(
            primitive(buffer, figure["v"], figure["n"], figure["uv"], figure["weights"], figure["t"][mine], figure["corners"][mine], m)
        )
    inverse = buffer.add(bind.transpose(0, 2, 1).reshape(-1, 16), "MAT4", FLOAT, np.float32)
    images = [{"bufferView": buffer.view(p), "mimeType": "image/jpeg"} for p in pictures]
    document = {
        "asset": {"version": "2.0", "generator": "aisle assets/author", "copyright": "BSD-3-Clause, aisle"},
        "scene": 0,
        "scenes": [{"nodes": [len(tree) - 1]}],
        "nodes": tree,
        "meshes": [{"name": name, "primitives": primitives}],
        "skins": [{"joints": list(range(len(bones))), "inverseBindMatrices": inverse}],
        "materials": [
            {
                "name": f"{name}_{kind}",
                "doubleSided": True,
                "normalTexture": {"index": 1},
                "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": rough},
            }
            for kind, rough in figure["finishes"]
        ],
        "textures": [{"sampler": 0, "source": 0}, {"sampler": 0, "source": 1}],
        "samplers": [{"magFilter": 9729, "minFilter": 9987}],
        "images": images,
        "animations": [animation(buffer, n, *keys, fps, nodes) for n, keys in clips.items()],
    }
    document["bufferViews"], document["accessors"] = buffer.views, buffer.accessors
    binary = buffer.data + b"\0" * (-len(buffer.data) % 4)
    document["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(binary)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path + ".part", "wb") as f:
        f.write(struct.pack("<4sII", b"glTF", 2, total))
        f.write(struct.pack("<I4s", len(text), b"JSON") + text)
        f.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)
    os.replace(path + ".part", path)
