"""Rigid machines from simple solids: bevelled boxes, bars, lathed and extruded shapes, decals.

A Machine is a tree of named nodes; every node collects pieces in its own frame (its origin is
where it turns or slides). Tileable materials are laid on by box projection in metres.
"""

import math

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

from . import figure, picture


class Machine:
    """Nodes and materials of one vehicle or piece of kit."""

    def __init__(self, name, folder):
        figure.reset()
        self.name, self.folder = name, folder
        self.materials, self.tiles = {}, {}
        self.nodes, self.at = {}, {}
        self.node(name, None, (0, 0, 0))

    def material(self, name, image, tile_m=0.6, roughness=0.7, metallic=0.0):
        """A material from a picture that covers tile_m metres (None: a decal sheet; a function: where a
        point of the machine lies in it)."""
        loaded = picture.jpeg_image(image, name, self.folder, 86)
        self.materials[name] = figure.material(loaded, name, roughness)
        shader(self.materials[name]).inputs["Metallic"].default_value = metallic
        self.tiles[name] = tile_m

    def plain(self, name, colour, roughness=0.7, metallic=0.0):
        """A material of one colour (sRGB): no picture to carry."""
        made = bpy.data.materials.new(name)
        made.use_nodes = True
        inputs = shader(made).inputs
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour]
        inputs["Base Color"].default_value = (*linear, 1.0)
        inputs["Roughness"].default_value = roughness
        inputs["Metallic"].default_value = metallic
        self.materials[name], self.tiles[name] = made, 1.0

    def node(self, name, parent, place):
        """A node at `place` (machine frame) below parent."""
        mesh = bpy.data.meshes.new(name)
        thing = bpy.data.objects.new(name, mesh)
        bpy.context.scene.collection.objects.link(thing)
        place = np.asarray(place, float)
        if parent:
            thing.parent = self.nodes[parent]
            thing.location = Vector(place - self.at[parent])
        self.nodes[name], self.at[name] = thing, place
        thing["pieces"] = 0
        mesh.uv_layers.new(name="uv")
        return name

    def add(self, node, piece, material, uv=None):
        """Adds a bmesh piece, given in the machine's frame, to a node; frees the piece."""
        thing = self.nodes[node]
        slot = thing.data.materials.find(material)
        if slot < 0:
            thing.data.materials.append(self.materials[material])
            slot = len(thing.data.materials) - 1
        layer = piece.loops.layers.uv.verify() if uv is None else piece.loops.layers.uv.active
        if uv is None:
            project(piece, layer, self.tiles[material])
        bmesh.ops.translate(piece, verts=piece.verts, vec=Vector(-self.at[node]))
        for face in piece.faces:
            face.material_index, face.smooth = slot, True
        mesh = bpy.data.meshes.new("piece")
        piece.to_mesh(mesh)
        piece.free()
        whole = bmesh.new()
        whole.from_mesh(thing.data)
        whole.loops.layers.uv.verify()
        whole.from_mesh(mesh)
        whole.to_mesh(thing.data)
        whole.free()
        bpy.data.meshes.remove(mesh)

    def box(self, node, material, centre, size, bevel=0.008, turn=None, segments=2):
        b = bmesh.new()
        bmesh.ops.create_cube(b, size=1.0)
        bmesh.ops.scale(b, verts=b.verts, vec=Vector(size))
        small = min(size) < 0.05  # a rounder edge would be smaller than a pixel
        chamfer(b, min(bevel, 0.45 * min(size)), 1 if small else segments)
        place(b, turn, centre)
        self.add(node, b, material)

    def prism(self, node, material, outline, lo, hi, axis="y", bevel=0.01, segments=2):
        """Extrudes an outline between lo and hi: (x, z) along y, (y, z) along x or (x, y) along z."""
        b = bmesh.new()
        put = {
            "y": lambda p, t: (p[0], t, p[1]),
            "x": lambda p, t: (t, p[0], p[1]),
            "z": lambda p, t: (p[0], p[1], t),
        }[axis]
        ends = [[b.verts.new(put(p, t)) for p in outline] for t in (lo, hi)]
        b.faces.new(ends[0])
        b.faces.new(list(reversed(ends[1])))
        n = len(outline)
        for i in range(n):
            b.faces.new([ends[0][i], ends[1][i], ends[1][(i + 1) % n], ends[0][(i + 1) % n]])
        bmesh.ops.recalc_face_normals(b, faces=b.faces)
        chamfer(b, bevel, segments)
        self.add(node, b, material)

    def bar(self, node, material, a, b, radius, sides=12, caps=True):
        """Round bar from a to b."""
        self.pipe(node, material, [a, b], radius, sides, caps)

    def beam(self, node, material, a, b, width, depth, bevel=0.004, up=(0, 0, 1)):
        """Rectangular bar from a to b; depth lies along `up` as far as it can."""
        a, b = Vector(a), Vector(b)
        along = (b - a).normalized()
        side = along.cross(Vector(up))
        side = side.normalized() if side.length > 1e-4 else along.orthogonal().normalized()
        turn = Matrix((along, side, along.cross(side))).transposed()
        self.box(node, material, (a + b) / 2, ((b - a).length, width, depth), bevel, turn)

    def pipe(self, node, material, points, radius, sides=10, caps=True):
        """Round pipe through points."""
        points = [Vector(p) for p in points]
        b = bmesh.new()
        rings = []
        side = None
        for i, p in enumerate(points):
            ahead = (points[min(i + 1, len(points) - 1)] - points[max(i - 1, 0)]).normalized()
            side = (
                ahead.orthogonal().normalized()
                if side is None
                else (side - side.dot(ahead) * ahead).normalized()
            )
            other = ahead.cross(side)
            rings.append(
                [
                    b.verts.new(p + float(radius) * (math.cos(t) * side + math.sin(t) * other))
                    for t in np.linspace(0, 2 * np.pi, sides, endpoint=False)
                ]
            )
        for r, s in zip(rings, rings[1:]):
            for i in range(sides):
                b.faces.new([r[i], r[(i + 1) % sides], s[(i + 1) % sides], s[i]])
        if caps:
            b.faces.new(list(reversed(rings[0])))
            b.faces.new(rings[-1])
        self.add(node, b, material)

    def lathe(self, node, material, centre, axis, profile, sides=32):
        """Turns a profile of (distance along axis, radius) about axis through centre."""
        axis = Vector(axis).normalized()
        side = axis.orthogonal().normalized()
        other = axis.cross(side)
        b = bmesh.new()
        rings = []
        for along, radius in profile:
            rings.append(
                [
                    b.verts.new(
                        Vector(centre)
                        + float(along) * axis
                        + float(max(radius, 1e-4)) * (math.cos(t) * side + math.sin(t) * other)
                    )
                    for t in np.linspace(0, 2 * np.pi, sides, endpoint=False)
                ]
            )
        for r, s in zip(rings, rings[1:]):
            for i in range(sides):
                b.faces.new([r[i], r[(i + 1) % sides], s[(i + 1) % sides], s[i]])
        self.add(node, b, material)

    def decal(self, node, material, centre, right, up, rect, sheet, corners=((-1, -1), (1, -1), (1, 1), (-1, 1))):
        """A picture rect (x, y, w, h in sheet pixels) on a quad spanned by right and up (metres), or on
        another convex outline in it."""
        centre, right, up = Vector(centre), Vector(right), Vector(up)
        b = bmesh.new()
        verts = [b.verts.new(centre + 0.5 * i * right + 0.5 * j * up) for i, j in corners]
        face = b.faces.new(verts)
        layer = b.loops.layers.uv.verify()
        x, y, w, h = rect
        height, width = sheet
        for loop, (i, j) in zip(face.loops, corners):
            loop[layer].uv = ((x + w * (i + 1) / 2) / width, 1.0 - (y + h * (1 - j) / 2) / height)
        self.add(node, b, material, uv=True)

    def stem(self, node, material, points, radii, sides):
        """A tapering pipe without ends; the texture runs along it."""
        points = [Vector(p) for p in points]
        b = bmesh.new()
        layer = b.loops.layers.uv.verify()
        rings, side, far = [], None, 0.0
        for i, (p, radius) in enumerate(zip(points, radii)):
            ahead = (points[min(i + 1, len(points) - 1)] - points[max(i - 1, 0)]).normalized()
            side = ahead.orthogonal().normalized() if side is None else (side - side.dot(ahead) * ahead).normalized()
            other = ahead.cross(side)
            far += (p - points[i - 1]).length if i else 0.0
            ring = [b.verts.new(p + float(radius) * (math.cos(t) * side + math.sin(t) * other)) for t in np.arange(sides) * 2 * np.pi / sides]
            rings.append((ring, far))
        for (r, u), (s, v) in zip(rings, rings[1:]):
            for i in range(sides):
                face = b.faces.new([r[i], r[(i + 1) % sides], s[(i + 1) % sides], s[i]])
                turn = (i / sides, (i + 1) / sides, (i + 1) / sides, i / sides)
                for loop, t, w in zip(face.loops, turn, (u, u, v, v)):
                    loop[layer].uv = (t, w / self.tiles[material])
        self.add(node, b, material, uv=True)

    def mesh(self, node, material, vertices, faces, uvs, normals):
        """Triangles with normals of their own, given in the machine's frame; one uv a vertex."""
        data = bpy.data.meshes.new(f"{node}_{material}")
        data.from_pydata((np.asarray(vertices) - self.at[node]).tolist(), [], np.asarray(faces).tolist())
        data.materials.append(self.materials[material])
        data.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
        data.uv_layers.new(name="uv").data.foreach_set("uv", np.asarray(uvs)[np.asarray(faces).ravel()].ravel())
        data.use_auto_smooth = True
        data.normals_split_custom_set_from_vertices(np.asarray(normals).tolist())
        thing = bpy.data.objects.new(data.name, data)
        bpy.context.scene.collection.objects.link(thing)
        thing.parent = self.nodes[node]

    def same(self, node, as_node):
        """Gives a node what another one carries, once for both."""
        self.nodes[node].data = self.nodes[as_node].data

    def adopt(self, thing, parent):
        """Hangs a finished object, given in the machine's frame, below a node."""
        thing.parent = self.nodes[parent]
        thing.location = Vector(-self.at[parent])

    def finish(self, path, facts):
        """Shades by angle, stores the facts on the root and exports."""
        for thing in self.nodes.values():
            thing.data.use_auto_smooth = True
            thing.data.auto_smooth_angle = np.radians(35)
            del thing["pieces"]
        self.nodes[self.name]["aisle"] = facts
        figure.export(path)


def shader(material):
    return material.node_tree.nodes["Principled BSDF"]


def chamfer(b, width, segments):
    if width > 0:
        sharp = [e for e in b.edges if len(e.link_faces) == 2 and e.calc_face_angle() > 0.4]
        bmesh.ops.bevel(
            b,
            geom=sharp,
            offset=width,
            segments=segments,
            profile=0.5,
            affect="EDGES",
            clamp_overlap=True,
        )


def place(b, turn, centre):
    if turn is not None:
        bmesh.ops.rotate(b, verts=b.verts, matrix=turn)
    bmesh.ops.translate(b, verts=b.verts, vec=Vector(centre))


def project(b, layer, tile):
    """Box projection: the texture runs upright on walls."""
    for face in b.faces:
        if callable(tile):
            for loop in face.loops:
                loop[layer].uv = tile(loop.vert.co)
            continue
        n = face.normal
        big = max(range(3), key=lambda i: abs(n[i]))
        for loop in face.loops:
            p = loop.vert.co
            u, v = ((p.y, p.z), (p.x, p.z), (p.x, p.y))[big]
            loop[layer].uv = (u / tile, v / tile)


def around(axis, degrees):
    return Matrix.Rotation(np.radians(degrees), 3, axis)
