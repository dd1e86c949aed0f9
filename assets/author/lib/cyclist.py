"""A cyclist: bicycle with rolling wheels, turning cranks and a steered fork, and a rider on the saddle
who pedals. Origin on the floor below the rear axle; x ahead."""

import numpy as np

from . import figure, gait, parts, pose as ps, rig
from .solid import Machine

RADIUS, BASE = 0.34, 1.05
SADDLE = np.array([0.18, 0.0, 0.95])
BARS = np.array([0.86, 0.0, 1.06])
CRANK = np.array([0.46, 0.0, 0.29])
CRANK_M = 0.17
DEVELOPMENT_M = 5.2  # one turn of the cranks: 42 and 17 teeth on a 28 inch wheel
CLIP, FRAMES = "pedal", 32


def build(name, folder, path, rider):
    m = Machine(name, folder)
    parts.materials(m, "", "", (0.10, 0.24, 0.45), (0.10, 0.10, 0.11), 41)
    frame(m, name)
    steer = m.node("steer_front", name, (BASE, 0, RADIUS))
    fork(m, steer)
    wheel(m, m.node("wheel_rear", name, (0, 0, RADIUS)), 0.0)
    wheel(m, m.node("wheel_front", steer, (BASE, 0, RADIUS)), BASE)
    cranks(m, name)
    _, bones, shapes = figure.on_bones(rider, m.folder, 512, 0.45)
    figure.clip(bones, shapes.joint, CLIP, lambda u: shape(shapes.joint, u), FRAMES)
    bones.animation_data.action = None
    m.adopt(bones, name)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the rear axle",
        "wheelbase_m": BASE,
        "track_m": 0.0,
        "steered": ["front"],
        "max_steer_deg": 50.0,
        "wheel_radius_m": {"wheel_front": RADIUS, "wheel_rear": RADIUS},
        "steer_nodes": ["steer_front"],
        "max_speed_mps": 8.0,
        "ridden": {
            "clip": CLIP,
            "development_m": DEVELOPMENT_M,
            "crank": "cranks",
            "pedals": ["pedal_left", "pedal_right"],
        },
    }


def wheel(m, node, x):
    c = (x, 0, RADIUS)
    t = np.linspace(0, 2 * np.pi, 9)
    tyre = [(0.019 * np.sin(a), RADIUS - 0.019 + 0.019 * np.cos(a)) for a in t]
    m.lathe(node, "rubber", c, (0, 1, 0), tyre, 36)
    m.lathe(node, "chrome", c, (0, 1, 0), [(-0.011, 0.298), (-0.011, 0.312), (0.011, 0.312), (0.011, 0.298), (-0.011, 0.298)], 36)
    m.lathe(node, "steel", c, (0, 1, 0), [(-0.05, 0.0), (-0.05, 0.02), (0.05, 0.02), (0.05, 0.0)], 12)
    for k in range(18):
        a = 2 * np.pi * k / 18
        rim = (x + 0.30 * np.cos(a), 0, RADIUS + 0.30 * np.sin(a))
        hub = (x + 0.02 * np.cos(a + 1.2), 0.03 * (-1) ** k, RADIUS + 0.02 * np.sin(a + 1.2))
        m.bar(node, "chrome", hub, rim, 0.0018, 4, False)


def frame(m, n):
    seat_top = (0.24, 0, 0.80)
    head_low, head_top = (0.90, 0, 0.62), (0.87, 0, 0.84)
    bracket = tuple(CRANK)
    for a, b, r in (
        (bracket, seat_top, 0.017),
        (bracket, head_low, 0.020),
        (seat_top, head_top, 0.016),
        (head_low, head_top, 0.021),
        (seat_top, tuple(SADDLE - [0, 0, 0.05]), 0.013),
    ):
        m.bar(n, "paint", a, b, r, 12)
    for s in (-1, 1):
        m.bar(n, "paint", (bracket[0], s * 0.03, bracket[2]), (0, s * 0.06, RADIUS), 0.010, 8)
        m.bar(n, "paint", (seat_top[0], s * 0.02, seat_top[2] - 0.03), (0, s * 0.06, RADIUS), 0.008, 8)
    m.box(n, "plastic", tuple(SADDLE - [0.02, 0, 0.03]), (0.25, 0.13, 0.05), 0.022)
    arc = [(0.37 * np.cos(a), 0, RADIUS + 0.37 * np.sin(a)) for a in np.linspace(0.2, 2.6, 14)]
    m.pipe(n, "plastic", arc, 0.020, 8)
    m.box(n, "red", (-0.30, 0, 0.66), (0.03, 0.06, 0.05), 0.01)
    m.box(n, "steel", (-0.10, 0, 0.73), (0.34, 0.13, 0.012), 0.004)
    m.box(n, "vinyl", (-0.08, -0.14, 0.58), (0.30, 0.12, 0.26), 0.03)


def cranks(m, n):
    """Chainring, crank arms and pedals at the start of a turn: level, the right foot ahead."""
    m.node("cranks", n, tuple(CRANK))
    m.lathe("cranks", "steel", tuple(CRANK), (0, 1, 0), [(0.045, 0.0), (0.045, 0.095), (0.05, 0.095), (0.05, 0.0)], 24)
    for side, sign in rig.SIDES:
        x, _, z = pedal_at(sign, 0)
        m.beam("cranks", "steel", (CRANK[0], sign * 0.075, CRANK[2]), (x, sign * 0.085, z), 0.014, 0.03)
        pedal = m.node(f"pedal_{side}", "cranks", (x, sign * 0.135, z))
        m.box(pedal, "plastic", (x, sign * 0.135, z), (0.09, 0.09, 0.025), 0.006)


def pedal_at(sign, turn):
    """Middle of the left (+1) or right (-1) pedal after a share of a turn, forwards."""
    angle = 2 * np.pi * turn + (np.pi if sign > 0 else 0)
    return CRANK + CRANK_M * np.array([np.cos(angle), 0, -np.sin(angle)])


def fork(m, node):
    for s in (-1, 1):
        m.pipe(node, "paint", [(0.905, s * 0.045, 0.60), (0.95, s * 0.055, 0.48), (BASE, s * 0.05, RADIUS)], 0.012, 8)
    m.bar(node, "chrome", (0.905, -0.05, 0.60), (0.905, 0.05, 0.60), 0.014, 8)
    m.bar(node, "chrome", (0.87, 0, 0.84), (0.85, 0, 0.99), 0.013, 8)
    bar = [(0.74, -0.29, 1.01), (0.84, -0.24, 1.03), (0.88, -0.08, 1.00), (0.88, 0.08, 1.00), (0.84, 0.24, 1.03), (0.74, 0.29, 1.01)]
    m.pipe(node, "chrome", bar, 0.011, 8)
    arc = [(BASE + 0.37 * np.cos(a), 0, RADIUS + 0.37 * np.sin(a)) for a in np.linspace(0.9, 2.9, 12)]
    m.pipe(node, "plastic", arc, 0.020, 8)
    parts.lamp(m, node, (0.94, 0, 0.88), (1, 0, 0), 0.03)


def shape(joint, turn):
    """On the saddle, bent forward, hands on the grips, feet on the pedals after a share of a turn."""
    p = {
        "pelvis": SADDLE + [0.02, 0.0, 0.10],
        "turn": {"pelvis": ps.ry(18), "spine": ps.ry(26), "chest": ps.ry(33), "head": ps.ry(6)},
    }
    p["turn"]["neck"] = ps.ry(16)
    for side, sign in rig.SIDES:
        pedal = pedal_at(sign, turn)
        # The heel drops as the pedal comes over the top and lifts below (ankling, about 10 degrees).
        foot = ps.ry(12 - 10 * (pedal[2] - CRANK[2]) / CRANK_M)
        ankle = pedal + [-0.08, sign * 0.125, 0.115]
        ps.two_bones(p, joint, f"thigh_{side}", f"shin_{side}", ankle, np.array([1.0, 0.06 * sign, 0.2]), np.array([1.0, 0.03 * sign, 0]))
        p["turn"][f"foot_{side}"] = p["turn"][f"toes_{side}"] = foot
        wrist = np.array([0.735, sign * 0.27, 1.055])
        gait.reach_arm(p, joint, side, sign, wrist, (-0.3, 0.55, -0.6), curl=70.0, palm=20.0)
    return p
