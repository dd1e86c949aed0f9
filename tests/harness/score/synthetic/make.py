"""Makes the synthetic trajectories beside this file and scores them independently of the C++ code.

Usage: python3 tests/harness/score/synthetic/make.py   (numpy 1.24)
Every number is recomputed from the printed files, with dense matrices and exhaustive search, so
that no shortcut of the tested code is shared. Writes truth.txt, estimate.txt (TUM) and values.txt.
"""

import pathlib

import numpy as np

HERE = pathlib.Path(__file__).parent


def rotation(axis, angle):
    axis = axis / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def quaternion(r):  # x, y, z, w by the eigenvector of Bar-Itzhack's matrix
    k = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
        [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
        [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], 0],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r.trace()]]) / 3
    _, vectors = np.linalg.eigh(k)
    q = vectors[:, -1]
    return q if q[3] >= 0 else -q


def matrix(q):
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def pose(r, t):
    m = np.eye(4)
    m[:3, :3], m[:3, 3] = r, t
    return m


def make():
    rng = np.random.default_rng(20240229)
    away = pose(rotation(np.array([0.3, -0.5, 0.8]), 1.1), np.array([4.0, -7.0, 2.0]))
    truth, estimate = [], []
    for k in range(240):
        s = k / 20
        t = np.array([6 * np.cos(0.4 * s), 9 * np.sin(0.3 * s), 0.3 * np.sin(s)])
        r = rotation(np.array([0.1, 0.2, 1.0]), 0.4 * s) @ rotation(np.array([1.0, 0, 0]), 0.1)
        truth.append((k * 50_000_000, pose(r, t)))
        if k % 37 == 5:
            continue  # lost frames
        drift = pose(rotation(np.array([0.2, 1.0, 0.4]), 0.001 * k),
                     np.array([0.002 * k, -0.001 * k, 0.0]) + rng.normal(0, 0.01, 3))
        estimate.append((k * 50_000_000 + int(rng.integers(-9, 10)) * 1_000_000,
                         away @ truth[-1][1] @ drift))
    return truth, estimate


def write(name, poses):
    with open(HERE / name, "w") as file:
        file.write("# synthetic, made by make.py\n")
        for stamp, m in poses:
            sign, magnitude = ("-", -stamp) if stamp < 0 else ("", stamp)
            numbers = " ".join(f"{v:.12f}" for v in [*m[:3, 3], *quaternion(m[:3, :3])])
            file.write(f"{sign}{magnitude // 10**9}.{magnitude % 10**9:09d} {numbers}\n")


def read(name):
    poses = []
    for line in open(HERE / name):
        if line.startswith("#"):
            continue
        f = line.split()
        whole, part = f[0].split(".")
        stamp = int(whole + part)
        v = np.array([float(x) for x in f[1:]])
        poses.append((stamp, pose(matrix(v[3:]), v[:3])))
    return poses


def angle_deg(r):
    return np.degrees(np.arctan2(np.linalg.norm([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0],
                                                 r[1, 0] - r[0, 1]]), r.trace() - 1))


def umeyama(x, y, with_scale):
    mx, my = x.mean(0), y.mean(0)
    u, d, vt = np.linalg.svd((y - my).T @ (x - mx) / len(x))
    s = np.eye(3)
    if np.linalg.det(u) * np.linalg.det(vt) < 0:
        s[2, 2] = -1
    r = u @ s @ vt
    c = np.trace(np.diag(d) @ s) / ((x - mx) ** 2).sum(1).mean() if with_scale else 1.0
    return c, r, my - c * r @ mx


def rmse(v):
    return float(np.sqrt(np.mean(np.square(v))))


def main():
    truth, estimate = make()
    write("truth.txt", truth)
    write("estimate.txt", estimate)
    truth, estimate = read("truth.txt"), read("estimate.txt")
    # Nearest within half a frame; frames are 50 ms apart and stamps off by 9 ms at most, so the
    # nearest is also one to one.
    pairs = []
    for j, (stamp, _) in enumerate(estimate):
        i = min(range(len(truth)), key=lambda k: abs(truth[k][0] - stamp))
        assert abs(truth[i][0] - stamp) <= 25_000_000
        pairs.append((i, j))
    q = [truth[i][1] for i, _ in pairs]
    p = [estimate[j][1] for _, j in pairs]
    x, y = np.array([m[:3, 3] for m in p]), np.array([m[:3, 3] for m in q])
    values = {"pairs": len(pairs)}
    for name, with_scale in (("se3", False), ("sim3", True)):
        c, r, t = umeyama(x, y, with_scale)
        errors = np.linalg.norm(c * x @ r.T + t - y, axis=1)
        values[f"ate_{name}_rmse"] = rmse(errors)
        values[f"scale_{name}"] = c
        if name == "se3":
            for stat in ("mean", "median", "std", "min", "max"):
                values[f"ate_se3_{stat}"] = float(getattr(np, stat)(errors))
            values["ate_se3_rot_rmse"] = rmse([angle_deg((r @ m[:3, :3]).T @ n[:3, :3])
                                               for m, n in zip(p, q)])
    values["ate_none_rmse"] = rmse(np.linalg.norm(x - y, axis=1))
    # The turn about z by search alone: a grid, then ever finer ones around its best.
    def yaw_rmse(angle):
        turned = (x - x.mean(0)) @ rotation(np.array([0, 0, 1.0]), angle).T
        return rmse(np.linalg.norm(turned - (y - y.mean(0)), axis=1))
    best, width = 0.0, np.pi
    for _ in range(40):
        best = min(np.linspace(best - width, best + width, 41), key=yaw_rmse)
        width /= 4
    values["ate_posyaw_rmse"] = yaw_rmse(best)
    origin = q[0] @ np.linalg.inv(p[0])
    values["ate_origin_rmse"] = rmse([np.linalg.norm((origin @ m)[:3, 3] - n[:3, 3])
                                      for m, n in zip(p, q)])

    def relative(spans):
        e = [np.linalg.inv(np.linalg.inv(q[i]) @ q[j]) @ np.linalg.inv(p[i]) @ p[j]
             for i, j in spans]
        return (len(e), rmse([np.linalg.norm(m[:3, 3]) for m in e]),
                rmse([angle_deg(m[:3, :3]) for m in e]))

    n = len(pairs)
    path = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(y, axis=0), axis=1))])
    seconds = np.array([truth[i][0] * 1e-9 for i, _ in pairs])
    cuts, last = [], 0.0
    step = np.diff(path)
    for i in range(1, n):
        last += step[i - 1]
        if last >= 1.0:
            cuts.append(i)
            last = 0.0
    spans = {"1f": [(i, i + 1) for i in range(n - 1)],
             "10f": [(i, i + 10) for i in range(0, n - 10, 10)],
             "10f_all": [(i, i + 10) for i in range(n - 10)],
             "1m": list(zip(cuts, cuts[1:])),
             "2m_all": [], "1s_all": []}
    for i in range(n - 1):
        j = i + 1 + int(np.argmin(np.abs(path[i + 1:] - path[i] - 2.0)))
        if abs(path[j] - path[i] - 2.0) <= 0.2:
            spans["2m_all"].append((i, j))
        j = i + 1 + int(np.argmin(np.abs(seconds[i + 1:] - seconds[i] - 1.0)))
        if abs(seconds[j] - seconds[i] - 1.0) <= 0.025:
            spans["1s_all"].append((i, j))
    for name, list_of_spans in spans.items():
        count, trans, rot = relative(list_of_spans)
        values[f"rpe_{name}_n"] = count
        values[f"rpe_{name}_trans_rmse"] = trans
        values[f"rpe_{name}_rot_rmse"] = rot
    t_err, r_err, lengths = [], [], {}
    for first in range(0, n, 10):
        for length in range(5, 41, 5):
            later = [i for i in range(first, n) if path[i] > path[first] + length]
            if later:
                e = (np.linalg.inv(np.linalg.inv(p[first]) @ p[later[0]])
                     @ np.linalg.inv(q[first]) @ q[later[0]])
                t_err.append(100 * np.linalg.norm(e[:3, 3]) / length)
                r_err.append(100 * np.degrees(np.arccos(np.clip((e[:3, :3].trace() - 1) / 2, -1, 1)))
                             / length)
                lengths.setdefault(length, []).append(t_err[-1])
    values["segments_n"] = len(t_err)
    values["t_rel_percent"] = float(np.mean(t_err))
    values["r_rel_deg_per_100m"] = float(np.mean(r_err))
    values["t_rel_mean_of_means_percent"] = float(np.mean([np.mean(v) for v in lengths.values()]))
    with open(HERE / "values.txt", "w") as file:
        for name, value in values.items():
            file.write(f"{name} {value!r}\n")


main()
