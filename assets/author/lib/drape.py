"""Cloth hung on a body: position-based dynamics with edge and bend constraints, solved by Jacobi steps.

Mueller et al., Position Based Dynamics, 2007. The cloth is cut longer than the body (`grow`), so that
it buckles into folds where a sewn garment would; everything is in metres and a pure function of its
arguments.
"""

from dataclasses import dataclass

import numpy as np

from . import sdf


@dataclass
class Cloth:
    """How a garment hangs."""

    steps: int = 28  # time steps
    passes: int = 8  # constraint passes a step
    gravity_m: float = 0.00025  # fall per step, as a displacement
    bend: float = 0.25  # 0: silk, 1: board
    inside_m: float = 0.004  # least distance to the body
    damping: float = 0.85  # share of velocity kept per step


class Incidence:
    """Sums of values on tuples of vertices, collected at the vertices in a fixed order."""

    def __init__(self, ends, count):
        flat = np.concatenate([ends[:, 0], ends[:, 1]])
        self.order = np.argsort(flat, kind="stable")
        self.sign = np.where(self.order < len(ends), 1.0, -1.0)[:, None]
        self.row = self.order % len(ends)
        present, self.start = np.unique(flat[self.order], return_index=True)
        self.present = present
        self.share = 1.0 / np.diff(np.append(self.start, len(flat)))[:, None]
        self.ends, self.count = ends, count

    def mean(self, values):
        """Mean over a vertex's tuples of +value (first end) or -value (second end)."""
        out = np.zeros((self.count, 3))
        out[self.present] = np.add.reduceat(values[self.row] * self.sign, self.start) * self.share
        return out


def edges_of(triangles):
    """Unique edges (E, 2) and, for inner ones, the two vertices opposite (B, 2)."""
    e = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    across = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    key = np.sort(e, 1)
    order = np.lexsort((key[:, 1], key[:, 0]))
    key, across = key[order], across[order]
    same = np.all(key[1:] == key[:-1], 1)
    first = np.concatenate([[True], ~same])
    return key[first], np.stack([across[:-1][same], across[1:][same]], -1)


def hang(rest, triangles, grow, axis, held, body, most, cloth, seed):
    """The cloth's vertices after hanging.

    grow (V, 2): how much longer the cloth is along the unit vectors axis (V, 3) and across them;
    held (V): 1 where it is sewn fast, 0 where free; body: sampled distance (sdf.grid); most (V): the
    largest distance to the body, where something is worn above.
    """
    edges, opposite = edges_of(triangles)
    run = rest[edges[:, 1]] - rest[edges[:, 0]]
    length = np.linalg.norm(run, axis=1)
    mean = lambda a: (a[edges[:, 0]] + a[edges[:, 1]]) / 2
    along = np.clip(np.abs((run * mean(axis)).sum(1)) / (length + 1e-9), 0, 1) ** 2
    g = mean(grow)
    length = length * (1 + g[:, 0] * along + g[:, 1] * (1 - along))
    across = np.linalg.norm(rest[opposite[:, 1]] - rest[opposite[:, 0]], axis=1)
    edge_sums, bend_sums = Incidence(edges, len(rest)), Incidence(opposite, len(rest))
    free = (1.0 - held)[:, None]
    rng = np.random.default_rng(seed)
    x = rest + 0.0008 * rng.standard_normal(rest.shape) * free
    velocity = np.zeros_like(x)
    for _ in range(cloth.steps):
        before = x
        x = x + (cloth.damping * velocity - [0, 0, cloth.gravity_m]) * free
        for _ in range(cloth.passes):
            d = x[edges[:, 1]] - x[edges[:, 0]]
            n = np.sqrt((d * d).sum(1)) + 1e-9
            move = 1.5 * edge_sums.mean(d * (0.5 * (n - length) / n)[:, None])
            d = x[opposite[:, 1]] - x[opposite[:, 0]]
            n = np.sqrt((d * d).sum(1)) + 1e-9
            pull = np.minimum(n - across, 0.0)  # folding shortens, which bending resists
            move += cloth.bend * bend_sums.mean(d * (0.5 * pull / n)[:, None])
            x = x + move * free
        x = rest + (keep_out(x, body, cloth.inside_m, most, before) - rest) * free
        velocity = x - before
    return x


def keep_out(x, body, least, most, before):
    """Pushes points out of the body, and under what is worn above; what touches rubs."""
    values, origin, step = body
    d = sdf.sample(body, x)
    h = 0.5 * step
    n = np.stack(
        [sdf.sample(body, x + h * e) - sdf.sample(body, x - h * e) for e in np.eye(3)], -1
    )
    n = n / (np.linalg.norm(n, axis=1, keepdims=True) + 1e-9)
    push = np.maximum(least - d, 0.0) - np.maximum(d - most, 0.0)
    touching = (push > 0)[:, None]
    moved = x + push[:, None] * n
    slide = moved - before
    slide = slide - (slide * n).sum(1, keepdims=True) * n
    return moved - 0.5 * touching * slide
