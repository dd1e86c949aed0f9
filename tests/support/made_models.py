"""Models that a test makes up, written with Python's standard library alone."""

import json
import struct


def box(low, high):
    """A box's corners and its twelve triangles, counter-clockwise from outside."""
    corners = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, [tri for a, b, c, d in quads for tri in ((a, b, c), (a, c, d))]


def inside_out(shape):
    corners, triangles = shape
    return corners, [(a, c, b) for a, b, c in triangles]


def y_up(point):
    """A point of z up as glTF stores it."""
    x, y, z = point
    return [x, z, -y]


class Glb:
    """Grows a binary glTF file; shapes are given in metres with z up."""

    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "accessors": [], "bufferViews": [],
                     "materials": []}

    def accessor(self, values, kind, code, component):
        flat = [number for value in values
                for number in (value if isinstance(value, (list, tuple)) else [value])]
        data = struct.pack(f"<{len(flat)}{code}", *flat)
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                 "count": len(values), "type": kind}
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def floats(self, values, kind="VEC3"):
        return self.accessor(values, kind, "f", 5126)

    def material(self, rgb, **more):
        self.json["materials"].append(
            {"pbrMetallicRoughness": {"baseColorFactor": [*rgb, 1], "metallicFactor": 0}, **more})
        return len(self.json["materials"]) - 1

    def mesh(self, shape, material=None, **more):
        corners, triangles = shape
        primitive = {"attributes": {"POSITION": self.floats([y_up(c) for c in corners])},
                     "indices": self.accessor([i for t in triangles for i in t], "SCALAR", "I",
                                              5125), **more}
        if material is not None:
            primitive["material"] = material
        self.json["meshes"].append({"primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, name, parent=None, **more):
        self.json["nodes"].append({"name": name, **more})
        index = len(self.json["nodes"]) - 1
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def bytes(self):
        data = dict(self.json, buffers=[{"byteLength": len(self.binary)}])
        text = json.dumps({key: value for key, value in data.items() if value != []}).encode()
        text += b" " * (-len(text) % 4)
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def obj(shape):
    corners, triangles = shape
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + \
        "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def collada(shape, asset):
    """`asset`: what its <asset> says, e.g. <unit meter="0.01"/>."""
    corners, triangles = shape
    numbers = " ".join(str(n) for corner in corners for n in corner)
    faces = " ".join(str(i) for triangle in triangles for i in triangle)
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>{asset}</asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="{3 * len(corners)}">{numbers}</float_array>
<technique_common><accessor source="#pa" count="{len(corners)}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(triangles)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{faces}</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="Cupboard">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""
