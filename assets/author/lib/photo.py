"""Photographs assets with aisle's own camera: a scene whose rig stands where each picture is taken.

Needs a built program (`./aisle`); standard library only.
"""

import math
import os
import subprocess

SIZE, FOCAL = (640, 400), 430


def pose(eye, target):
    """TUM pose of a camera (x right, y down, z ahead) at eye that looks at target, upright."""
    z = [b - a for a, b in zip(eye, target)]
    n = math.sqrt(sum(c * c for c in z))
    z = [c / n for c in z]
    n = math.hypot(z[0], z[1])
    x = [z[1] / n, -z[0] / n, 0.0]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    m = [[x[i], y[i], z[i]] for i in range(3)]
    # Shepperd's method: the largest of the four components first.
    four = [m[0][0] + m[1][1] + m[2][2], m[0][0] - m[1][1] - m[2][2], m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1]]
    k = four.index(max(four))
    q = [0.0] * 4
    q[k] = 0.5 * math.sqrt(1 + four[k])
    s = 0.25 / q[k]
    a, b, c = m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]
    d, e, f = m[1][0] + m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2]
    if k == 0:
        q[1:] = [a * s, b * s, c * s]
    else:
        q[0] = (a, b, c)[k - 1] * s
        pairs = {1: (None, d, e), 2: (d, None, f), 3: (e, f, None)}[k]
        for i, p in enumerate(pairs):
            if p is not None:
                q[i + 1] = p * s
    return (*eye, q[1], q[2], q[3], q[0])


def shoot(aisle, folder, scene, views, size=SIZE, focal=FOCAL):
    """Pictures of a scene's text from views (eye, target), metres: the files, in order."""
    with open(os.path.join(folder, "way.txt"), "w", encoding="utf-8") as f:
        for i, (eye, target) in enumerate(views):
            f.write(" ".join(f"{v:.7f}" for v in (i, *pose(eye, target))) + "\n")
    head = (
        "about: Assets, looked at from near.\n"
        f"frames: {len(views)}\nrate_hz: 1\n"
        f"camera: {{size_px: [{size[0]}, {size[1]}], focal_px: [{focal}, {focal}], "
        f"center_px: [{size[0] / 2}, {size[1] / 2}], baseline_m: 0.12}}\n"
        "rig: {trajectory: way.txt}\n"
    )
    path = os.path.join(folder, "photo.yaml")
    with open(path, "w", encoding="utf-8") as f:
        f.write(head + scene)
    out = os.path.join(folder, "photos")
    subprocess.run([aisle, "render", path, "--out", out, "--format", "kitti"], check=True)
    pictures = next(d for d, _, f in sorted(os.walk(out)) if d.endswith("image_0") and f)
    return [os.path.join(pictures, name) for name in sorted(os.listdir(pictures))]
