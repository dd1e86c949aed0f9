"""Drops from .glb files the texture coordinates that no texture of theirs uses.

Run: python3 assets/author/pack.py FILE.glb ...   (build.sh does, before the manifest is written)

Blender's exporter writes coordinates for every vertex, painted or not; one byte in six of the cars and houses
was such. Pictures do not change. A file with nothing to drop stays as it is.
"""

import json
import os
import struct
import sys


def texture_sets(value):
    """Numbers of the coordinate sets that the textures of a material (a tree of glTF) use."""
    if isinstance(value, list):
        return set().union(*map(texture_sets, value))
    if not isinstance(value, dict):
        return set()
    own = {value.get("texCoord", 0)} if "index" in value else set()
    return own.union(*map(texture_sets, value.values()))


def without_idle_coordinates(tree):
    """How many attributes left the primitives of a file."""
    dropped = 0
    for primitive in (p for mesh in tree.get("meshes", []) for p in mesh["primitives"]):
        material = tree["materials"][primitive["material"]] if "material" in primitive else {}
        used = {f"TEXCOORD_{i}" for i in texture_sets(material)}
        for name in [n for n in primitive["attributes"] if n.startswith("TEXCOORD_") and n not in used]:
            del primitive["attributes"][name]
            dropped += 1
    return dropped


def places(tree, kind):
    """(holder, key) of everything that refers to an accessor or a bufferView of the file."""
    if kind == "accessors":
        for primitive in (p for mesh in tree.get("meshes", []) for p in mesh["primitives"]):
            yield from ((primitive["attributes"], name) for name in primitive["attributes"])
            yield from ((target, name) for target in primitive.get("targets", []) for name in target)
            if "indices" in primitive:
                yield primitive, "indices"
        yield from ((s, k) for a in tree.get("animations", []) for s in a["samplers"] for k in ("input", "output"))
        yield from ((skin, "inverseBindMatrices") for skin in tree.get("skins", []) if "inverseBindMatrices" in skin)
    else:
        holders = tree.get("accessors", []) + tree.get("images", [])
        yield from ((holder, "bufferView") for holder in holders if "bufferView" in holder)


def without_unused(tree, kind):
    """Keeps of a list of the file what something refers to; says which they were."""
    kept = sorted({holder[key] for holder, key in places(tree, kind)})
    new = {old: i for i, old in enumerate(kept)}
    for holder, key in places(tree, kind):
        holder[key] = new[holder[key]]
    tree[kind] = [tree[kind][old] for old in kept]
    return kept


def packed(data):
    """The bytes of a .glb without idle coordinates; None when there are none."""
    (length,) = struct.unpack("<I", data[12:16])
    tree, binary = json.loads(data[20 : 20 + length]), data[28 + length :]
    if not without_idle_coordinates(tree):
        return None
    without_unused(tree, "accessors")
    without_unused(tree, "bufferViews")
    body = b""
    for view in tree["bufferViews"]:
        start = view.get("byteOffset", 0)
        piece = binary[start : start + view["byteLength"]]
        view["byteOffset"] = len(body)
        body += piece + b"\0" * (-len(piece) % 4)
    tree["buffers"][0]["byteLength"] = len(body)
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body))
    return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body


def main(files):
    for name in files:
        with open(name, "rb") as f:
            data = packed(f.read())
        if data is None:
            continue
        before = os.path.getsize(name)
        with open(name + ".part", "wb") as f:
            f.write(data)
        os.replace(name + ".part", name)
        print(f"{name}: {before} -> {len(data)} bytes")


if __name__ == "__main__":
    main(sys.argv[1:])
