# %% [markdown]
# # A dataset for a network: what moves, from pictures
#
# Pictures, depth, flow and the mask of what moves *now*, by seeds: each seed is another day with other
# people, goods and ways. Every second sample is taken from a place off the planned route, which is
# what a recorded dataset cannot give.
#
#     python3 dataset_for_a_network.py --scene paper/scene2 --every 10 --seeds 8 --out set

# %%
import argparse
import pathlib

import aisle
import numpy as np


def beside(pose, random):
    """A pose within 20 cm and 5 degrees of another: what a camera on another vehicle sees."""
    angle = np.radians(random.uniform(-5, 5))
    turn = np.eye(4)
    turn[:3, :3] = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    turn[:3, 3] = random.uniform(-0.2, 0.2, 3)
    return pose @ turn


def samples(scene, every, random):
    for k in range(0, len(scene) - 1, every):
        frame, after = scene.render(k), None
        if (k // every) % 2:
            # Where it stands there, it stands in the next picture too: flow is that of the movers.
            place = beside(frame.pose, random)
            frame, after = scene.render(k, pose=place), scene.render(k + 1, pose=place)
        flow = frame.motion_to(after).flow if after else frame.flow
        yield {"image": frame.left, "right": frame.right, "depth": frame.depth, "flow": flow,
               "moving": frame.moving // 255, "pose": frame.pose}


# %% One file a seed. A scene opens in milliseconds once its light is known.
parser = argparse.ArgumentParser()
parser.add_argument("--scene", default="paper/scene2")
parser.add_argument("--every", type=int, default=10, help="frames")
parser.add_argument("--seeds", type=int, default=4)
parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("set"))
arguments = parser.parse_args()
arguments.out.mkdir(parents=True, exist_ok=True)
for seed in range(1, arguments.seeds + 1):
    scene = aisle.Simulator(arguments.scene, seed=seed)
    rows = list(samples(scene, arguments.every, np.random.default_rng(seed)))
    columns = {name: np.stack([row[name] for row in rows]) for name in rows[0]}
    np.savez_compressed(arguments.out / f"seed{seed:03}.npz", **columns)
    share = columns["moving"].mean()
    print(f"seed {seed}: {len(rows)} samples, {100 * share:.1f} % of the pixels move")

# %% [markdown]
# A loader of several processes opens its scenes itself (a Simulator can be pickled: it is opened anew
# on the other side), and starts them by `spawn`: threads of the renderer do not survive a fork.
