# %% [markdown]
# # A metric of one's own: are those found who are near?
#
# IoU counts a worker ten metres away as much as one who could be run over. Truth has the depth of
# every pixel, so one can ask instead: of the pixels that move within `near` metres, how many did the
# system reject, and from which frame on had it found half of each of them?

# %%
import argparse

import aisle
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--scene", default="smoke/short")
parser.add_argument("--near", type=float, default=4, help="metres")
arguments = parser.parse_args()


# %%
def near_recall(scene, system, near_m):
    slam = aisle.Slam(scene.calibration, system=system)
    found = asked = 0
    first_seen, first_found = {}, {}
    for frame in scene:
        mask = slam.track(frame.left, frame.right, frame.stamp_ns).mask
        rejected = mask > 0 if mask is not None else np.zeros(frame.left.shape, bool)
        near = (frame.moving > 0) & (frame.depth < near_m)
        found += (near & rejected).sum()
        asked += near.sum()
        for thing in frame.objects:
            own = near & (frame.labels == thing.label)
            if own.sum() < 500:
                continue
            name = scene.things[thing.label].name
            first_seen.setdefault(name, frame.stamp_ns)
            if (own & rejected).sum() > own.sum() / 2:
                first_found.setdefault(name, frame.stamp_ns)
    delays = [(first_found[n] - first_seen[n]) / 1e9 for n in first_seen if n in first_found]
    return found / max(asked, 1), delays, len(first_seen)


# %%
scene = aisle.Simulator(arguments.scene)
print(f"within {arguments.near:g} m   recall   found   mean delay")
for system in ("paper", "robust"):
    recall, delays, asked = near_recall(scene, system, arguments.near)
    delay = f"{np.mean(delays):.2f} s" if delays else "never"
    print(f"{system:13} {recall:6.2f}   {len(delays)} of {asked}   {delay}")
