"""Sheet metal: one smooth surface, given by a function, cut into panels along drawn lines.

The surface is F(x, y, z) = 0, negative inside, the same to the left and the right. Half of it is spread
flat without a pole: a spine along x sends out rays, upright to it along its length and like the ribs
of a hemisphere beyond its ends; seen from the side these rays fill a stadium. Windows, gaps and lamps are
drawn in a view (side, front, rear, top), cast onto the surface and cut into the stadium by a
constrained Delaunay triangulation. Every panel then lies at its own depth below the surface, walls close
the steps, and normals are those of F: no facet shows but at the outline.
"""

import bpy
import numpy as np
from mathutils import Vector
from mathutils.geometry import delaunay_2d_cdt

FAR = 14.0  # m, beyond every surface
STEP = 1.5e-3  # m, of differences of F

# View: the axes its pictures are drawn in, and the axis and sign it is cast along.
VIEWS = {"side": ((0, 2), 1, 1), "front": ((1, 2), 0, 1), "rear": ((1, 2), 0, -1), "top": ((0, 1), 2, 1)}


def smax(*values, k=0.05):
    """Largest value, rounded over k (cubic, so that curvature is continuous)."""
    out = values[0]
    for v in values[1:]:
        h = np.maximum(k - np.abs(out - v), 0) / k
        out = np.maximum(out, v) + h**3 * k / 6
    return out


def smin(*values, k=0.05):
    return -smax(*[-v for v in values], k=k)


def profile(points, soft=0.06, count=6000):
    """A smooth function through a polyline's neighbourhood: averaged twice over `soft`."""
    xs, ys = np.array(points, float).T
    lo, hi = xs[0] - 1, xs[-1] + 1
    grid = np.linspace(lo, hi, count)
    flat = np.interp(grid, xs, ys)
    # Beyond its ends the line goes on.
    flat += np.minimum(grid - xs[0], 0) * (ys[1] - ys[0]) / (xs[1] - xs[0])
    flat += np.maximum(grid - xs[-1], 0) * (ys[-1] - ys[-2]) / (xs[-1] - xs[-2])
    wide = max(3, int(soft / (grid[1] - grid[0])) | 1)
    for _ in range(3):
        padded = np.pad(flat, wide // 2, mode="reflect", reflect_type="odd")
        flat = np.convolve(padded, np.ones(wide) / wide, "valid")
    return lambda x: np.interp(x, grid, flat)


def rounded(points, radius, steps=5):
    """A closed outline with its corners turned to arcs."""
    p = np.array(points, float)
    out = []
    for i in range(len(p)):
        a, b, c = p[i - 1], p[i], p[(i + 1) % len(p)]
        u, v = a - b, c - b
        lu, lv = np.linalg.norm(u), np.linalg.norm(v)
        u, v = u / lu, v / lv
        half = np.arccos(np.clip(u @ v, -1, 1)) / 2
        r = radius[i] if np.ndim(radius) else radius
        t = min(r / np.tan(half) if half > 1e-3 else 0, 0.45 * lu, 0.45 * lv)
        for s in np.linspace(0, 1, steps):
            out.append((1 - s) ** 2 * (b + t * u) + 2 * s * (1 - s) * b + s * s * (b + t * v))
    return np.array(out)


def grown(points, by):
    """A closed outline moved outwards by `by` metres."""
    p = np.array(points, float)
    ahead, back = np.roll(p, -1, 0) - p, p - np.roll(p, 1, 0)
    area = np.sum(p[:, 0] * np.roll(p[:, 1], -1) - np.roll(p[:, 0], -1) * p[:, 1])
    turn = np.array([[0, -1], [1, 0]]) * (1 if area > 0 else -1)
    n = []
    for d in (ahead, back):
        d = d / (np.linalg.norm(d, axis=1, keepdims=True) + 1e-9)
        n.append(d @ turn)
    out = n[0] + n[1]
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
    across = np.maximum((out * n[0]).sum(1, keepdims=True), 0.5)
    return p + by * out / across


def band(points, width):
    """The outline of a line drawn `width` wide."""
    p = np.array(points, float)
    d = np.gradient(p, axis=0)
    n = np.stack([-d[:, 1], d[:, 0]], 1) / np.linalg.norm(d, axis=1, keepdims=True)
    return np.concatenate([p + n * width / 2, (p - n * width / 2)[::-1]])


def along(points, step, closed=False):
    """Points every `step` metres at most along a line."""
    p = np.array(points, float)
    if closed:
        p = np.concatenate([p, p[:1]])
    out = [p[:1]]
    for a, b in zip(p, p[1:]):
        n = max(1, int(np.ceil(np.linalg.norm(b - a) / step)))
        out.append(a + (b - a) * (np.arange(1, n + 1) / n)[:, None])
    out = np.concatenate(out)
    return out[:-1] if closed else out


def within(points, outline):
    """Which points (N, 2) an outline encloses, by crossings."""
    x, y = points[:, :1], points[:, 1:]
    a, b = outline, np.roll(outline, -1, 0)
    crosses = (a[None, :, 1] > y) != (b[None, :, 1] > y)
    rise = b[None, :, 1] - a[None, :, 1]
    at = a[None, :, 0] + (y - a[None, :, 1]) / np.where(rise == 0, 1e-12, rise) * (b - a)[None, :, 0]
    return (np.sum(crosses & (x < at), 1) % 2) == 1


class Panels:
    """A surface F and what is drawn on it; spine = (x of its tail end, of its nose end, height)."""

    def __init__(self, field, spine):
        self.field, self.spine = field, spine
        self.regions = []  # (name, outline in the stadium), later ones lie over earlier
        self.lines = []

    # Casting -----------------------------------------------------------------------------------

    def root(self, origin, direction):
        """Where rays that begin inside leave, (N, 3)."""
        lo, hi = np.zeros(len(origin)), np.full(len(origin), FAR)
        for _ in range(42):
            mid = (lo + hi) / 2
            out = self.field(*(origin + direction * mid[:, None]).T) > 0
            lo, hi = np.where(out, lo, mid), np.where(out, mid, hi)
        return origin + direction * lo[:, None]

    def cast(self, view, points):
        """Points drawn in a view on the surface."""
        points = np.atleast_2d(np.array(points, float))
        axes, axis, sign = VIEWS[view]
        origin = np.zeros((len(points), 3))
        origin[:, axes[0]], origin[:, axes[1]] = points.T
        if axis == 2:
            origin[:, 2] = self.spine[2]
        direction = np.zeros((len(points), 3))
        direction[:, axis] = sign
        return self.root(origin, direction)

    def normal(self, points):
        p = np.atleast_2d(points)
        n = np.empty_like(p)
        for i in range(3):
            d = np.zeros(3)
            d[i] = STEP
            n[:, i] = self.field(*(p + d).T) - self.field(*(p - d).T)
        return n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-12)

    def flat(self, points):
        """Where points of the surface lie in the stadium."""
        x0, x1, z = self.spine
        x = np.clip(points[:, 0], x0, x1)
        d = points - np.stack([x, 0 * x, 0 * x + z], 1)
        d /= np.maximum(np.linalg.norm(d, axis=1, keepdims=True), 1e-12)
        across = np.hypot(d[:, 0], d[:, 2])
        beta = np.arctan2(across, d[:, 1])
        unit = d[:, (0, 2)] / np.maximum(across, 1e-9)[:, None]
        return np.stack([x, 0 * x], 1) + unit * beta[:, None]

    def solid(self, flat):
        """Points of the surface at places of the stadium."""
        x0, x1, z = self.spine
        x = np.clip(flat[:, 0], x0, x1)
        d = flat - np.stack([x, 0 * x], 1)
        beta = np.minimum(np.linalg.norm(d, axis=1), np.pi / 2)
        unit = d / np.maximum(np.linalg.norm(d, axis=1, keepdims=True), 1e-9)
        s = np.sin(beta)
        ray = np.stack([unit[:, 0] * s, np.cos(beta), unit[:, 1] * s], 1)
        out = self.root(np.stack([x, 0 * x, 0 * x + z], 1), ray)
        out[beta > np.pi / 2 - 1e-6, 1] = 0
        return out

    # Drawing -----------------------------------------------------------------------------------

    def region(self, name, view, outline, step=0.03):
        """A panel: its closed outline in a view."""
        space = self.cast(view, along(outline, step, True))
        ring = self.flat(space)
        # What ends on the middle of the body holds the last triangles there as well.
        foot = np.stack([np.clip(ring[:, 0], *self.spine[:2]), 0 * ring[:, 0]], 1)
        reach = np.where(space[:, 1:2] < 2e-3, 1.2, 1.0)
        self.regions.append((name, foot + (ring - foot) * reach))
        self.lines.append((ring, True))

    def gap(self, view, line, width=0.006, step=0.05, name="gap"):
        """A seam along a line."""
        self.region(name, view, band(along(line, step), width), step)

    def belt(self, name, height, below=True):
        """All that is lower than height(x), with an edge there."""
        x0, x1, _ = self.spine
        a = np.linspace(0, np.pi / 2, 24)
        ends = [np.stack([x0 - 0 * a, 0 * a], 1), np.stack([x1 - 0 * a, 0 * a], 1)]
        rays = [np.stack([-np.cos(a), np.sin(a)], 1), np.stack([np.sin(a), np.cos(a)], 1)]
        middle = np.linspace(x0, x1, 60)
        origin = np.concatenate([ends[0], np.stack([middle, 0 * middle], 1), ends[1]])
        ray = np.concatenate([rays[0], np.tile([0.0, 1.0], (60, 1)), rays[1]])
        p = np.column_stack([origin, np.zeros(len(origin))])
        for _ in range(6):  # its height depends on where it ends up
            p = self.root(
                np.column_stack([origin, height(p[:, 0])]), np.column_stack([ray, 0 * ray[:, 0]])
            )
        line = self.flat(p)
        keep = np.concatenate([[True], np.linalg.norm(np.diff(line, axis=0), axis=1) > 1e-4])
        line = line[keep]
        self.lines.append((line, False))
        low = np.array([[line[-1, 0] + 3, line[-1, 1]], [line[-1, 0] + 3, -4], [line[0, 0] - 3, -4], [line[0, 0] - 3, line[0, 1]]])
        self.regions.append((name, np.concatenate([line, low])))

    # Meshing -----------------------------------------------------------------------------------

    def triangulate(self, coarse=0.17, turn_deg=10.0, fine=0.032, rounds=4):
        """(flat points, their places in space, triangles): finer where the surface bends."""
        x0, x1, _ = self.spine
        coarse = min(coarse, 0.5 * (x1 - x0))
        a = np.linspace(-np.pi / 2, np.pi / 2, 33)
        right = np.stack([x1 + np.pi / 2 * np.cos(a), np.pi / 2 * np.sin(a)], 1)
        left = np.stack([x0 - np.pi / 2 * np.cos(a), np.pi / 2 * np.sin(a)], 1)[::-1]
        top = np.linspace(x1, x0, max(2, int((x1 - x0) / 0.06)))[1:-1]
        ring = np.concatenate(
            [right, np.stack([top, 0 * top + np.pi / 2], 1), left, np.stack([top[::-1], 0 * top - np.pi / 2], 1)]
        )
        hx = np.arange(x0 - 1.6, x1 + 1.6, coarse)
        hy = np.arange(-1.6, 1.6, coarse * 0.87)
        gx, gy = np.meshgrid(hx, hy)
        gx[1::2] += coarse / 2
        grid = np.stack([gx.ravel(), gy.ravel()], 1)
        d = grid - np.stack([np.clip(grid[:, 0], x0, x1), 0 * grid[:, 0]], 1)
        extra = grid[np.linalg.norm(d, axis=1) < np.pi / 2 - 0.3 * coarse]
        for _ in range(rounds):
            flat, triangles = self.cdt(ring, extra)
            space = self.solid(flat)
            n = self.normal(space)
            edges = np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1), axis=0)
            p, q = edges.T
            length = np.linalg.norm(space[p] - space[q], axis=1)
            turn = np.degrees(np.arccos(np.clip((n[p] * n[q]).sum(1), -1, 1)))
            split = ((turn > turn_deg) & (length > fine)) | (length > 2.2 * coarse)
            if split.sum() < 20:
                break
            middle = (flat[p] + flat[q])[split] / 2
            # One new point a neighbourhood is enough.
            _, first = np.unique(np.round(middle / 0.004).astype(int), axis=0, return_index=True)
            extra = np.concatenate([extra, middle[np.sort(first)]])
        flat, triangles = self.cdt(ring, extra)
        return flat, self.solid(flat), triangles[:, ::-1]  # the stadium is seen from within

    def cdt(self, ring, extra):
        points, edges, start = [ring], [], 0
        n = len(ring)
        edges += [(i, (i + 1) % n) for i in range(n)]
        start = n
        for line, closed in self.lines:
            k = len(line)
            points.append(line)
            edges += [(start + i, start + (i + 1) % k) for i in range(k if closed else k - 1)]
            start += k
        points.append(extra)
        flat = [Vector(p) for p in np.concatenate(points)]
        out, _, faces, *_ = delaunay_2d_cdt(flat, edges, [], 0, 1e-5)
        return np.array([tuple(v) for v in out]), np.array([f for f in faces if len(f) == 3])

    def mesh(self, depths, drop=(), colours=None, default="body", sides=(1, -1), **options):
        """Positions, normals (three a triangle) and region names of the triangles, of both halves or of
        the left (1) or right (-1) one.

        depths: how far below the surface a region lies; drop: regions that are holes. Walls between
        depths take the name colours gives for the deeper region, else "gap".
        """
        flat, space, triangles = self.triangulate(**options)
        middle = flat[triangles].mean(1)
        names = [default] + [name for name, _ in self.regions]
        which = np.zeros(len(triangles), int)
        for i, (_, outline) in enumerate(self.regions):
            which[within(middle, outline)] = i + 1
        normals = self.normal(space)
        depth = np.array([depths.get(n, 0.0) for n in names])
        gone = np.array([n in drop for n in names])
        out_p, out_n, out_w = [], [], []
        for t in np.unique(which):
            if gone[t]:
                continue
            mine = triangles[which == t]
            out_p.append((space - depth[t] * normals)[mine])
            out_n.append(normals[mine])
            out_w += [names[t]] * len(mine)
        walls = self.walls(triangles, which, depth, gone, space)
        for a, deep, i, j, inside in walls:
            da, db = depth[a], depth[deep]
            p = [space[i] - da * normals[i], space[j] - da * normals[j], space[j] - db * normals[j], space[i] - db * normals[i]]
            n = np.cross(p[2] - p[0], p[3] - p[1])
            size = np.linalg.norm(n)
            if size < 1e-12:
                continue
            if n @ (inside - (space[i] + space[j]) / 2) < 0:  # it looks into the deeper panel
                p, n = p[::-1], -n
            quad = np.array([[p[0], p[1], p[2]], [p[0], p[2], p[3]]])
            out_p.append(quad)
            if names[deep] == "gap":  # dark within: normals that its floor has spare vertices
                out_n.append(np.array([[normals[i if np.linalg.norm(c - space[i]) < np.linalg.norm(c - space[j]) else j] for c in tri] for tri in quad]))
            else:
                out_n.append(np.tile(n / size, (2, 3, 1)))
            out_w += [(colours or {}).get(names[deep], "gap")] * 2
        p, n = np.concatenate(out_p), np.concatenate(out_n)
        flip = np.array([1, -1, 1])
        halves = {1: (p, n), -1: ((p * flip)[:, ::-1], (n * flip)[:, ::-1])}
        p = np.concatenate([halves[s][0] for s in sides])
        n = np.concatenate([halves[s][1] for s in sides])
        return p, n, np.array(out_w * len(sides))

    def walls(self, triangles, which, depth, gone, space):
        """Edges between panels of unlike depth: (shallow region, deep region, its two vertices, a
        place within the deep panel)."""
        owner, out = {}, []
        for t, tri in enumerate(triangles):
            for i, j in ((0, 1), (1, 2), (2, 0)):
                owner.setdefault((min(tri[i], tri[j]), max(tri[i], tri[j])), []).append(t)
        for (i, j), pair in owner.items():
            if len(pair) != 2:
                continue
            s, t = sorted(pair, key=lambda k: depth[which[k]])
            a, b = which[s], which[t]
            if a == b or gone[a] or gone[b] or depth[a] == depth[b]:
                continue
            out.append((a, b, i, j, space[triangles[t]].mean(0)))
        return out


def weld(p, n):
    """Corners that agree in place and normal, once: (positions, normals, triangles)."""
    key = np.concatenate([np.round(p.reshape(-1, 3) / 2e-5), np.round(n.reshape(-1, 3) * 500)], 1).astype(np.int64)
    _, first, back = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return p.reshape(-1, 3)[first], n.reshape(-1, 3)[first], back.reshape(-1, 3)


def hang(machine, node, mesh, material_of, uv_of):
    """Adds panels to a machine's node, with their own normals. material_of: region -> material."""
    p, n, names = mesh
    materials = sorted({material_of(w) for w in set(names)})
    slot = np.array([materials.index(material_of(w)) for w in names])
    data = bpy.data.meshes.new(node + "_panels")
    v, vn, t = weld(p - machine.at[node], n)
    keep = (t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])
    t, slot = t[keep], slot[keep]
    data.from_pydata(v.tolist(), [], t.tolist())
    for name in materials:
        data.materials.append(machine.materials[name])
    data.polygons.foreach_set("material_index", slot)
    data.polygons.foreach_set("use_smooth", np.ones(len(t), bool))
    layer = data.uv_layers.new(name="uv")
    layer.data.foreach_set("uv", uv_of(v[t.ravel()] + machine.at[node]).ravel())
    data.use_auto_smooth = True
    data.normals_split_custom_set_from_vertices(vn.tolist())
    thing = bpy.data.objects.new(node + "_panels", data)
    bpy.context.scene.collection.objects.link(thing)
    thing.parent = machine.nodes[node]
    return len(t)
