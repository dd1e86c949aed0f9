# %% [markdown]
# # A SLAM of one's own in some twenty lines: scored, and put at the wheel
#
# Direct stereo odometry at half size: depth by block matching, motion by laying the last picture onto
# the new one (Gauss-Newton on grey values, Cauchy weights). It is no good system. It is yours.
#
#     python3 own_slam.py                              # scored beside one of aisle's
#     python3 own_slam.py --steer drive/aisle_dock     # steers a vehicle (minutes)

# %%
import argparse

import aisle
import numpy as np


def half(image):
    quarters = image.astype(float).reshape(image.shape[0] // 2, 2, image.shape[1] // 2, 2)
    return quarters.mean(axis=(1, 3))


def box(image, r=3):
    for axis in (0, 1):
        sums = np.cumsum(image, axis)
        image = np.roll(sums, -r, axis) - np.roll(sums, r + 1, axis)
    return image


def disparity(left, right, most=36):
    costs = np.stack([box(np.abs(left - np.roll(right, d, 1))) for d in range(most)])
    best = costs[1:-1].argmin(0)[None] + 1
    low, at, high = (np.take_along_axis(costs, best + k, 0)[0] for k in (-1, 0, 1))
    return best[0] + (low - high) / (2 * (low - 2 * at + high) + 1e-9)


def moved(twist):
    x, y, z, a, b, c = twist
    m = np.array([[0, -c, b, x], [c, 0, -a, y], [-b, a, 0, z], [0, 0, 0, 0]])
    return np.eye(4) + m + m @ m / 2 + m @ m @ m / 6


# %% All of it.
class OwnSlam:
    def __init__(self, rig):
        self.f, self.base = rig.fx / 2, rig.baseline_m
        self.centre = np.array([rig.cx - 0.5, rig.cy - 0.5]) / 2
        self.pose, self.step, self.points = np.eye(4), np.eye(4), None

    def track(self, left, right):
        left, right = half(left), half(right)
        for _ in range(12 if self.points is not None else 0):
            p = self.step[:3, :3] @ self.points + self.step[:3, 3:]
            u, v = self.f * p[:2] / p[2] + self.centre[:, None]
            inside = (p[2] > 0.1) & (u > 1) & (v > 1) & (u < left.shape[1] - 2) & (v < left.shape[0] - 2)
            u, v, grey, slope = u[inside], v[inside], self.grey[inside], self.slope[:, inside]
            i, j, a, b = v.astype(int), u.astype(int), v % 1, u % 1
            now = ((1 - a) * ((1 - b) * left[i, j] + b * left[i, j + 1])
                   + a * ((1 - b) * left[i + 1, j] + b * left[i + 1, j + 1]))
            weighted = slope / (1 + ((now - grey) / 8) ** 2)
            self.step = self.step @ moved(-np.linalg.solve(weighted @ slope.T, weighted @ (now - grey)))
        self.pose = self.pose @ np.linalg.inv(self.step)
        dy, dx = np.gradient(left)
        v, u = np.nonzero((np.hypot(dx, dy) > 5)[8:-8, 40:-8])
        u, v = u[::4] + 40, v[::4] + 8
        z = self.f * self.base / np.maximum(disparity(left, right)[v, u], 0.8)
        x, y = (u - self.centre[0]) * z / self.f, (v - self.centre[1]) * z / self.f
        gx, gy = self.f * dx[v, u] / z, self.f * dy[v, u] / z
        gz = -(gx * x + gy * y) / z
        self.points, self.grey = np.stack([x, y, z]), left[v, u]
        self.slope = np.stack([gx, gy, gz, y * gz - z * gy, z * gx - x * gz, x * gy - y * gx])
        return self.pose


# %% Scored, beside one of aisle's.
def score(name, frames):
    scene = aisle.Simulator(name)
    own, plain = OwnSlam(scene.calibration), aisle.Slam(scene.calibration, system="plain")
    poses = []
    for _, frame in zip(range(frames), scene):
        poses.append(own.track(frame.left, frame.right))
        plain.track(frame.left, frame.right, frame.stamp_ns)
    planned = scene.trajectory
    truth = aisle.Trajectory(planned.stamps_ns[: len(poses)], planned.poses[: len(poses)])
    for name, track in [("own", aisle.Trajectory(truth.stamps_ns, poses)), ("plain", plain.finish())]:
        print(f"ATE of {name:6} {float(aisle.score(truth, track)['ate_rmse_m']):.4f} m")


# %% At the wheel: the vehicle goes where this SLAM believes it is going.
def steer(name):
    drive = aisle.Drive(name, system=None)
    own = OwnSlam(drive.calibration)
    frame = drive.reset()
    while frame is not None:
        frame = drive.step(own.track(frame.left, frame.right))
    print(f"{drive.end} after {drive.vehicle.stamp_ns / 1e9:.1f} s,",
          f"{100 * abs(drive.vehicle.cross_track_m):.1f} cm beside its route")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--scene", default="smoke/short")
    parser.add_argument("--frames", type=int, default=1000, help="at most")
    parser.add_argument("--steer", metavar="SCENE", help="a scene with a drive")
    arguments = parser.parse_args()
    steer(arguments.steer) if arguments.steer else score(arguments.scene, arguments.frames)
